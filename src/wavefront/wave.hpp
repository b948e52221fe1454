// One thread's wave: the storage, the plan it runs, and what it counted.
#pragma once

#include "film/contrasts.hpp"
#include "wavefront/cancellation.hpp"
#include "wavefront/pattern.hpp"
#include "wavefront/pipeline.hpp"
#include "wavefront/render.hpp"

namespace orrery {

/// What one thread adds to RenderStats.
struct WaveCounters {
    TicksByBounce ticks{};
    std::uint64_t closest_rays = 0;
    std::uint64_t shadow_rays = 0;
    std::uint64_t dropped_samples = 0;
};

/// Owned by one thread; the plan and the stages are shared.
template <class Real>
struct Wave {
    Wave(const Plan& the_plan, const kernels::Stages<Real>& the_stages, const Cancellation& cancels,
         std::uint32_t slots)
        : plan(the_plan),
          tables(the_plan.tables<Real>()),
          stages(the_stages),
          pipeline(the_plan, the_stages),
          film(0, 0, contrasting_of(the_plan.settings())),
          cancellation(cancels),
          camera(tables.camera),
          storage(the_plan.needs(), the_plan.settings().depth, slots) {}

    const Plan& plan;
    const Tables<Real>& tables;
    const kernels::Stages<Real>& stages;
    const Pipeline<Real> pipeline;
    StageObserver<Real> observer{};  ///< mostly none
    Film film;                       ///< of a tile
    const Cancellation& cancellation;
    kernels::CameraTable<Real> camera;  ///< with the cells of the task being rendered
    Contrasts<Real> contrasts;          ///< of that task
    WaveStorage<Real> storage;
    WaveCounters counters;
    std::uint32_t count = 0;    ///< slots in use
    std::uint32_t unasked = 0;  ///< rays since the last question

    // The steps of an integrator. `rays` is how many there are, `bounce` how often they have scattered.

    /// Camera -> ray queue. Returns the number of rays, one per slot.
    std::uint32_t generate();
    /// Rays -> hits.
    void intersect(std::uint32_t rays, std::uint32_t bounce);
    /// Hits -> the radiance rays run into.
    void gather_emission(std::uint32_t rays, std::uint32_t bounce);
    /// Hits -> one run per way of scattering. Where the scene has one way, the queue is the run, misses included.
    kernels::Runs sort(std::uint32_t rays, std::uint32_t bounce);
    /// A run's hits -> the rays that leave them.
    void scatter(kernels::Scattering kind, const kernels::Runs& runs, std::uint32_t bounce);
    /// Vertices -> shadow queue -> radiance, for every run that samples lights.
    void direct_lighting(const kernels::Runs& runs, std::uint32_t bounce);
    /// Vertices -> shadow queue -> over smooth spheres -> radiance, for every run that samples area lights.
    void caustics(const kernels::Runs& runs, std::uint32_t bounce);
    /// The same towards point lights, for every run that samples those.
    void point_caustics(const kernels::Runs& runs, std::uint32_t bounce);
    /// Diffuse vertices' rays -> some of them to bright spots.
    void guide(const kernels::Runs& runs, std::uint32_t bounce);
    /// Kill, weigh, compact. Returns the number of survivors.
    std::uint32_t roulette(const kernels::Runs& runs, std::uint32_t bounce);

    // Whitted ray tracing's own: kill the rays that have scattered often enough; dielectrics' hits -> transmitted rays,
    // reflected ones put off; take up what was put off, to so many rays.
    void expire(std::uint32_t rays);
    void branch(const kernels::Runs& runs, std::uint32_t bounce);
    std::uint32_t resume(std::uint32_t rays, std::uint32_t bounce);

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

private:
    /// Makes a call, and charges time and traffic to its place in the profile.
    template <class Make>
    kernels::Runs call(const StageCall& what, const Make& make);
    void caustic(kernels::Response response, std::uint32_t which, std::uint32_t picked, std::uint32_t bounce);
    void point_caustic(std::size_t response, const kernels::LightTable<Real>& lights, kernels::Range picked,
                       std::uint32_t light, std::uint32_t bounce);
    /// Shadow rays -> radiance.
    void shadow(std::uint32_t rays, std::uint32_t target, std::uint32_t bounce);
    /// `lights`: a member of the plan's tables, which recorded calls refer to.
    void light(kernels::Scattering kind, const kernels::LightTable<Real>& lights, kernels::Range vertices,
               std::uint32_t which, std::uint32_t bounce);
};

/// The integrators: each takes a wave whose slots are filled to its end and leaves the radiance in the slots
/// (trace_distances: the distance in all three channels). They throw what Cancellation throws.
template <class Real>
void trace_paths(Wave<Real>& wave);
template <class Real>
void trace_whitted(Wave<Real>& wave);
template <class Real>
void trace_distances(Wave<Real>& wave);

}  // namespace orrery
