#include "bench/timing.hpp"

#include <algorithm>
#include <ctime>
#include <numeric>
#include <string>
#include <thread>

#if defined(__linux__)
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace orrery::bench {

namespace {

using Clock = std::chrono::steady_clock;

double measure_ticks_per_second() {
    const auto start = Clock::now();
    const std::uint64_t first = ticks();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::uint64_t last = ticks();
    return static_cast<double>(last - first) / std::chrono::duration<double>(Clock::now() - start).count();
}

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int failed = 0;

}  // namespace

double ticks_per_second() {
    static const double rate = measure_ticks_per_second();
    return rate;
}

Stopwatch::Stopwatch(TimedBy clock)
    : clock_(clock), processor_(clock == TimedBy::processor ? processor_seconds() : 0), wall_(ticks()) {}

double Stopwatch::seconds() const {
    const double wall = static_cast<double>(ticks() - wall_) / ticks_per_second();
    // The wall's is the finer one; it is the longer one only where another process had its turn.
    return clock_ == TimedBy::wall ? wall : std::min(wall, processor_seconds() - processor_);
}

#if defined(__linux__)

HardwareCounters::HardwareCounters() {
    constexpr std::uint64_t events[2] = {PERF_COUNT_HW_CPU_CYCLES, PERF_COUNT_HW_INSTRUCTIONS};
    available_ = true;
    for (std::size_t i = 0; i < 2; ++i) {
        perf_event_attr attributes{};
        attributes.size = sizeof attributes;
        attributes.type = PERF_TYPE_HARDWARE;
        attributes.config = events[i];
        attributes.disabled = 1;
        attributes.exclude_kernel = 1;
        attributes.exclude_hv = 1;
        files_[i] = static_cast<int>(syscall(SYS_perf_event_open, &attributes, 0, -1, -1, 0));
        available_ = available_ && files_[i] >= 0;
    }
}

HardwareCounters::~HardwareCounters() {
    for (const int file : files_)
        if (file >= 0) close(file);
}

void HardwareCounters::start() {
    if (!available_) return;
    for (const int file : files_) ioctl(file, PERF_EVENT_IOC_RESET, 0);
    for (const int file : files_) ioctl(file, PERF_EVENT_IOC_ENABLE, 0);
}

void HardwareCounters::stop() {
    if (!available_) return;
    for (const int file : files_) ioctl(file, PERF_EVENT_IOC_DISABLE, 0);
    for (std::size_t i = 0; i < 2; ++i) {
        std::uint64_t value = 0;
        if (read(files_[i], &value, sizeof value) == sizeof value) sums_[i] += value;
    }
}

#else

HardwareCounters::HardwareCounters() = default;
HardwareCounters::~HardwareCounters() = default;
void HardwareCounters::start() {}
void HardwareCounters::stop() {}

#endif

std::vector<double> time_pieces(benchmark::State& state, const std::vector<Piece>& pieces, TimedBy clock) {
    std::vector<std::vector<double>> samples(pieces.size());
    for (auto _ : state) {
        double pass = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            pieces[i].prepare();
            const Stopwatch watch(clock);
            pieces[i].run();
            samples[i].push_back(watch.seconds());
            pass += samples[i].back();
        }
        state.SetIterationTime(pass);
    }
    std::vector<double> seconds;
    for (auto& sample : samples) {
        const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
        std::nth_element(sample.begin(), middle, sample.end());
        seconds.push_back(*middle);
    }
    return seconds;
}

void set_rates(benchmark::State& state, double seconds, double rays) {
    state.counters["Rays/s"] = rays / seconds;
    state.counters["cycles/ray"] = seconds * ticks_per_second() / rays;
}

void time_passes(benchmark::State& state, const std::vector<Piece>& pieces, double rays) {
    const auto seconds = time_pieces(state, pieces, TimedBy::processor);
    set_rates(state, std::accumulate(seconds.begin(), seconds.end(), 0.0), rays);
    HardwareCounters counters;
    if (!counters.available()) return;
    for (const Piece& piece : pieces) {
        piece.prepare();
        counters.start();
        piece.run();
        counters.stop();
    }
    state.counters["core_cycles/ray"] = static_cast<double>(counters.cycles()) / rays;
    state.counters["instructions/ray"] = static_cast<double>(counters.instructions()) / rays;
}

void fail(benchmark::State& state, const std::string& reason) {
    ++failed;
    state.SkipWithError(reason.c_str());
}

int failures() { return failed; }

}  // namespace orrery::bench
