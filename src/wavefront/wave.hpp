// One thread's wave: the storage, the plan it runs, and what it counted.
#pragma once

#include <array>

#include "film/contrasts.hpp"
#include "kernels/stages.hpp"
#include "wavefront/cancellation.hpp"
#include "wavefront/render.hpp"
#include "wavefront/wave_storage.hpp"

namespace orrery {

/// A StageCost before ticks are known as seconds.
struct StageTicks {
    std::uint64_t ticks = 0, rays = 0, lanes = 0, filled = 0, bytes = 0;
};

/// What one thread adds to RenderStats.
struct WaveCounters {
    std::array<std::array<StageTicks, stage_names.size()>, profile_bounces> bounces{};
    std::uint64_t closest_rays = 0;
    std::uint64_t shadow_rays = 0;
    std::uint64_t dropped_samples = 0;
};

/// Owned by one thread; the plan, the stages and the film are shared, the film's pixels by tile.
template <class Real>
struct Wave {
    Wave(const Plan& the_plan, const kernels::Stages<Real>& the_stages, Film& the_film, const Cancellation& cancels,
         std::uint32_t slots)
        : plan(the_plan),
          tables(the_plan.tables<Real>()),
          stages(the_stages),
          film(the_film),
          cancellation(cancels),
          camera(tables.camera),
          storage(the_plan.needs(), the_plan.settings().depth, slots) {}

    const Plan& plan;
    const Tables<Real>& tables;
    const kernels::Stages<Real>& stages;
    Film& film;
    const Cancellation& cancellation;
    kernels::CameraTable<Real> camera;  ///< with the cells of the task being rendered
    Contrasts<Real> contrasts;          ///< of that task
    WaveStorage<Real> storage;
    WaveCounters counters;
    std::uint32_t count = 0;    ///< slots in use
    std::uint32_t unasked = 0;  ///< rays since the last question

    /// To be called before a stage takes so many rays: asks now and then whether the work is still wanted. A ray takes
    /// a stage microseconds at most, so that milliseconds pass between two questions, and a question costs less than a
    /// ray in hundreds.
    void proceed(std::uint32_t rays) {
        constexpr std::uint32_t between_questions = 2048;
        unasked += rays;
        if (unasked < between_questions) return;
        unasked = 0;
        cancellation.check();
    }
};

/// What a thread's counters say, at so many seconds a tick; `others` is left to the caller.
Profile profile_of(const WaveCounters& counters, double seconds_per_tick);

/// The pages: each takes a wave whose slots are filled to its end and leaves the radiance in the slots
/// (trace_distances: the distance in all three channels). They throw what Cancellation throws.
template <class Real>
void trace_paths(Wave<Real>& wave);
template <class Real>
void trace_whitted(Wave<Real>& wave);
template <class Real>
void trace_distances(Wave<Real>& wave);

}  // namespace orrery
