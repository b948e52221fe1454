// Time and cycles around a few microseconds of work.
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace orrery::bench {

/// Ticks of a constant-rate counter: the time-stamp counter where there is one, else nanoseconds.
inline std::uint64_t ticks() {
#if defined(__x86_64__)
    _mm_lfence();  // what came before has finished, what comes after has not begun
    const std::uint64_t now = __rdtsc();
    _mm_lfence();
    return now;
#else
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
            .count());
#endif
}

/// Measured once, over 50 ms.
double ticks_per_second();

enum class TimedBy : std::uint8_t {
    wall,       ///< what passes, others' turns on the processor included: the only measure of several threads
    processor,  ///< what this process gets of it, for one thread
};

/// Seconds since it was made.
class Stopwatch {
public:
    explicit Stopwatch(TimedBy clock);
    double seconds() const;

private:
    TimedBy clock_;
    double processor_;  ///< this process's time, in seconds
    std::uint64_t wall_;
};

/// Core cycles and instructions of this thread in user mode, where the machine lets us count them.
class HardwareCounters {
public:
    HardwareCounters();
    ~HardwareCounters();
    HardwareCounters(const HardwareCounters&) = delete;
    HardwareCounters& operator=(const HardwareCounters&) = delete;

    bool available() const { return available_; }
    void start();
    void stop();
    /// Sums over all intervals from start to stop.
    std::uint64_t cycles() const { return sums_[0]; }
    std::uint64_t instructions() const { return sums_[1]; }

private:
    int files_[2] = {-1, -1};
    bool available_ = false;
    std::uint64_t sums_[2] = {0, 0};
};

/// One of the pieces a pass of a benchmark is made of. Only `run` is timed.
struct Piece {
    std::function<void()> prepare, run;
};

/// Runs passes over all pieces until the benchmark has had enough. Returns each piece's *median* time in seconds:
/// neighbours on a shared machine interrupt a few pieces for milliseconds, which a mean would not survive.
std::vector<double> time_pieces(benchmark::State& state, const std::vector<Piece>& pieces, TimedBy clock);

/// Sets the counters Rays/s and cycles/ray (of the time-stamp counter) of a pass over `rays` that took `seconds`.
void set_rates(benchmark::State& state, double seconds, double rays);

/// time_pieces and set_rates of the sum; core_cycles/ray and instructions/ray as well where the machine counts them.
void time_passes(benchmark::State& state, const std::vector<Piece>& pieces, double rays);

/// Notes that a benchmark's result is wrong: the program will fail.
void fail(benchmark::State& state, const std::string& reason);
/// How many have.
int failures();

}  // namespace orrery::bench
