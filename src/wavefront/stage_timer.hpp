// Charges time and traffic to a stage of the profile.
#pragma once

#include <algorithm>
#include <chrono>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

#include "wavefront/wave.hpp"

namespace orrery {

/// A stage call takes microseconds, and reading the system's clock twice took 2 % of a render: this one is the
/// processor's counter, in ticks of a constant length. TickClock::seconds_per_tick says which.
struct TickClock {
    static std::uint64_t now() {
#if defined(__x86_64__)
        return __rdtsc();
#else
        return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
    }
};

/// What a stage is about to work on.
struct StageLoad {
    std::uint32_t rays = 0;
    std::uint32_t bytes_per_ray = 0;  ///< read and written
    std::uint32_t lanes = 0;          ///< per step of the kernel; 0: its vectors hold no rays
    bool again = false;               ///< a part of the stage that sees rays another part has counted
};

/// From construction to destruction.
class StageTimer {
public:
    StageTimer(WaveCounters& counters, Stage stage, std::uint32_t bounce, const StageLoad& load)
        : to_(counters.bounces[std::min<std::size_t>(bounce, profile_bounces - 1)][static_cast<std::size_t>(stage)]),
          start_(TickClock::now()) {
        to_.rays += load.again ? 0 : load.rays;
        to_.bytes += std::uint64_t{load.rays} * load.bytes_per_ray;
        if (load.lanes == 0) return;
        to_.lanes += std::uint64_t{(load.rays + load.lanes - 1) / load.lanes} * load.lanes;
        to_.filled += load.rays;
    }
    ~StageTimer() { to_.ticks += TickClock::now() - start_; }
    /// What only the stage itself could tell.
    void add_bytes(std::uint32_t rays, std::uint32_t bytes_per_ray) {
        to_.bytes += std::uint64_t{rays} * bytes_per_ray;
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

private:
    StageTicks& to_;
    std::uint64_t start_;
};

}  // namespace orrery
