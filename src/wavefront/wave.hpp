// One thread's wave: the storage, the plan it runs, and what it counted.
#pragma once

#include <array>
#include <chrono>

#include "film/film.hpp"
#include "kernels/stages.hpp"
#include "wavefront/render.hpp"
#include "wavefront/wave_storage.hpp"

namespace orrery {

/// What one thread adds to RenderStats.
struct WaveCounters {
    std::array<double, 5> stage_seconds{};
    std::uint64_t closest_rays = 0;
    std::uint64_t shadow_rays = 0;
    std::uint64_t dropped_samples = 0;
};

/// Owned by one thread; the plan, the stages and the film are shared, the film's pixels by tile.
struct Wave {
    Wave(const Plan& the_plan, const kernels::Stages<float>& the_stages, Film& the_film, std::uint32_t slots)
        : plan(the_plan),
          stages(the_stages),
          film(the_film),
          storage(the_plan.needs(), the_plan.settings().depth, slots) {}

    const Plan& plan;
    const kernels::Stages<float>& stages;
    Film& film;
    WaveStorage storage;
    WaveCounters counters;
    std::uint32_t count = 0;  ///< slots in use
};

/// Charges the time from construction to destruction to a stage.
class StageTimer {
public:
    StageTimer(Wave& wave, Stage stage)
        : to_(wave.counters.stage_seconds[static_cast<std::size_t>(stage)]), start_(Clock::now()) {}
    ~StageTimer() { to_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    double& to_;
    Clock::time_point start_;
};

/// The pages: each takes a wave whose slots are filled to its end and leaves the radiance in the slots
/// (trace_distances: the distance in all three channels).
void trace_paths(Wave& wave);
void trace_whitted(Wave& wave);
void trace_distances(Wave& wave);

}  // namespace orrery
