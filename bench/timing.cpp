#include "bench/timing.hpp"

#include <algorithm>
#include <ctime>
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

/// The process's time on processors, in ticks.
std::uint64_t processor_ticks() {
    return static_cast<std::uint64_t>(static_cast<double>(std::clock()) / CLOCKS_PER_SEC * ticks_per_second());
}

int failed = 0;

}  // namespace

double ticks_per_second() {
    static const double rate = measure_ticks_per_second();
    return rate;
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

void time_passes(benchmark::State& state, const std::vector<Piece>& pieces, double rays, TimedBy clock) {
    const auto now = clock == TimedBy::wall ? ticks : processor_ticks;
    std::vector<std::vector<std::uint64_t>> samples(pieces.size());
    for (auto _ : state) {
        std::uint64_t pass = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            pieces[i].prepare();
            const std::uint64_t start = now();
            pieces[i].run();
            samples[i].push_back(now() - start);
            pass += samples[i].back();
        }
        state.SetIterationTime(static_cast<double>(pass) / ticks_per_second());
    }
    double pass = 0;
    for (auto& sample : samples) {
        const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
        std::nth_element(sample.begin(), middle, sample.end());
        pass += static_cast<double>(*middle);
    }
    state.counters["Rays/s"] = rays * ticks_per_second() / pass;
    state.counters["cycles/ray"] = pass / rays;
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
