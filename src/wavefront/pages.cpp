// The pages: each integrator as a page of stage calls. Start reading here.
#include <utility>

#include "kernels/queues.hpp"
#include "wavefront/stage_timer.hpp"

namespace orrery {

namespace {

using kernels::LightStrategy;
using kernels::Runs;
using kernels::Scattering;

/// Bytes of a record of the queue, absent fields left out.
template <class Queue>
std::uint32_t record_bytes(const Queue& queue) {
    std::size_t sum = 0;
    Queue::each_field([&](const char*, auto field) { sum += queue.*field != nullptr ? sizeof(*(queue.*field)) : 0; });
    return static_cast<std::uint32_t>(sum);
}

constexpr std::uint32_t fewest_candidates = 4;

/// Bytes of a word or number, of three and of four.
template <class Real>
constexpr std::uint32_t word = sizeof(Real);
template <class Real>
constexpr std::uint32_t vector3 = 3 * word<Real>;
template <class Real>
constexpr std::uint32_t row = 4 * word<Real>;

// ---- the five stages, as the pages call them ----------------------------------------------------------------------

/// Camera -> ray queue. Returns the number of rays, one per slot.
template <class Real>
std::uint32_t generate(Wave<Real>& w) {
    const StageTimer timer(w.counters, Stage::generate, 0,
                           {w.count, 4 * word<Real> + record_bytes(w.storage.rays) + row<Real>, w.stages.step});
    const auto stage = w.plan.needs().lens ? w.stages.generate_lens : w.stages.generate_pinhole;
    stage(w.camera, w.storage.slots, w.count, w.plan.settings().seed, w.storage.rays);
    return w.count;
}

/// Whether it may pay to bound neighbouring rays together: a few spheres are sooner tested.
template <class Real>
bool bunched(const Wave<Real>& w) {
    const std::uint32_t spheres = w.tables.spheres.count;
    return spheres >= fewest_candidates && spheres <= kernels::SomeSpheres::capacity;
}

/// Rays -> hits.
template <class Real>
void intersect(Wave<Real>& w, std::uint32_t rays, std::uint32_t bounce) {
    const bool tree = w.plan.needs().tree;
    const std::uint32_t bytes = 2 * vector3<Real> + word<Real> + record_bytes(w.storage.hits);
    const StageTimer timer(w.counters, Stage::intersect, bounce, {rays, bytes, tree ? 0 : w.stages.sphere_step});
    const auto stage = tree ? w.stages.intersect_tree : bunched(w) ? w.stages.intersect_coherent : w.stages.intersect;
    stage(w.tables.spheres, w.storage.rays, rays, w.storage.hits);
    w.counters.closest_rays += rays;
}

template <class Real>
LightStrategy light_strategy(const Wave<Real>& w) {
    return w.plan.settings().light_sampling == LightSampling::cone ? LightStrategy::cone : LightStrategy::area;
}

/// Hits -> the radiance rays run into.
template <class Real>
void gather_emission(Wave<Real>& w, std::uint32_t rays, std::uint32_t bounce) {
    const Needs& needs = w.plan.needs();
    if (!needs.emitters && !needs.background) return;
    // The hits' ids; what few rays run into light load more.
    const StageTimer timer(w.counters, Stage::shade, bounce, {rays, word<Real>, w.stages.step, true});
    w.stages.emission(w.tables.spheres, w.tables.lights(true), w.tables.background, light_strategy(w), w.storage.rays,
                      w.storage.hits, rays, w.storage.slots);
}

/// Hits -> one run per way of scattering. Where the scene has one way, the queue is the run, misses included.
template <class Real>
Runs sort_hits(Wave<Real>& w, std::uint32_t rays, std::uint32_t bounce) {
    const Needs& needs = w.plan.needs();
    Runs runs;
    if (!needs.sort) {
        for (std::uint32_t k = 0; k < kernels::scattering_count; ++k)
            if (needs.scatters(static_cast<Scattering>(k))) runs.run[k] = {0, rays};
        return runs;
    }
    WaveStorage<Real>& s = w.storage;
    StageTimer timer(w.counters, Stage::shade, bounce, {rays, vector3<Real> + word<Real>, w.stages.lanes, true});
    if (w.stages.sort_by_scattering(w.tables.spheres, needs.scattering, s.rays, s.hits, rays, s.sorted_rays,
                                    s.sorted_hits, runs)) {
        std::swap(s.rays, s.sorted_rays);
        std::swap(s.hits, s.sorted_hits);
        timer.add_bytes(rays, 2 * (record_bytes(s.rays) + record_bytes(s.hits)));
    }
    return runs;
}

template <class Real>
kernels::ScatterContext<Real> scatter_context(const Wave<Real>& w, std::uint32_t bounce) {
    return {w.tables.spheres, w.tables.materials,      w.storage.slots, w.plan.settings().seed,
            bounce,           w.plan.needs().competing};
}

/// A run's hits -> the rays that leave them.
template <class Real>
void scatter(Wave<Real>& w, Scattering kind, const Runs& runs, std::uint32_t bounce) {
    const auto k = static_cast<std::size_t>(kind);
    if (runs.run[k].count == 0) return;
    // Read and written in place but for the slot, pixel and sample, which are only read.
    const std::uint32_t bytes = 2 * record_bytes(w.storage.rays) - 3 * word<Real> + record_bytes(w.storage.hits);
    const StageTimer timer(w.counters, Stage::shade, bounce, {runs.run[k].count, bytes, w.stages.step});
    w.stages.scatter[k](scatter_context(w, bounce), runs.run[k], w.storage.rays, w.storage.hits, w.storage.lobes);
}

/// Shadow queue -> radiance. `target` is the light's sphere where the queue does not know it.
template <class Real>
void shadow(Wave<Real>& w, std::uint32_t rays, std::uint32_t target, std::uint32_t bounce) {
    if (rays == 0) return;
    const bool tree = w.plan.needs().tree;
    const std::uint32_t bytes = record_bytes(w.storage.shadows) + 2 * row<Real>;
    const StageTimer timer(w.counters, Stage::shadow, bounce, {rays, bytes, tree ? 0 : w.stages.sphere_step});
    const auto stage = tree ? w.stages.shadow_tree : bunched(w) ? w.stages.shadow_coherent : w.stages.shadow;
    stage(w.tables.spheres, w.storage.shadows, rays, target, w.storage.slots);
    w.counters.shadow_rays += rays;
}

/// Vertices -> shadow queue -> radiance, for every run that samples lights: towards each of them, or each vertex
/// towards the one it chooses.
template <class Real>
void connect(Wave<Real>& w, const Runs& runs, std::uint32_t bounce) {
    const Plan& plan = w.plan;
    const WaveStorage<Real>& s = w.storage;
    const std::uint32_t bytes = 2 * vector3<Real> + 4 * word<Real> + record_bytes(s.shadows);
    for (std::uint32_t k = 0; k < kernels::scattering_count; ++k) {
        const auto run = runs.run[k];
        const bool points = (plan.needs().connect_point >> k & 1u) != 0;
        const bool areas = (plan.needs().connect_area >> k & 1u) != 0;
        if (run.count == 0 || !(points || areas)) continue;
        const kernels::LightTable<Real>& lights = w.tables.lights(areas);
        const kernels::ConnectContext<Real> context{w.tables.spheres,  w.tables.materials,    lights,
                                                    s.slots,           plan.settings().seed,  bounce,
                                                    light_strategy(w), plan.needs().competing};
        const auto stage = w.stages.connect[static_cast<std::size_t>(kernels::scattering_traits[k].response)];
        const auto aim = [&](std::uint32_t light, std::uint32_t target) {
            std::uint32_t rays = 0;
            w.proceed(run.count);
            {
                const StageTimer timer(w.counters, Stage::shade, bounce, {run.count, bytes, w.stages.step, true});
                rays = stage(context, light, run, s.rays, s.lobes, s.shadows);
            }
            shadow(w, rays, target, bounce);
        };
        if (lights.cells != 0) {
            aim(kernels::chosen_light, kernels::no_sphere);
        } else {
            for (std::uint32_t l = 0; l < lights.count; ++l) aim(l, static_cast<std::uint32_t>(lights.sphere[l]));
        }
    }
}

/// Kill, weigh, compact. Returns the number of survivors.
template <class Real>
std::uint32_t roulette(Wave<Real>& w, const Runs& runs, std::uint32_t bounce) {
    std::uint32_t rays = 0;
    for (const auto& run : runs.run) rays += run.count;
    const StageTimer timer(w.counters, Stage::roulette, bounce,
                           {rays, 2 * record_bytes(w.storage.rays), w.stages.step});
    const RenderSettings& settings = w.plan.settings();
    const bool play = w.plan.needs().roulette && bounce >= settings.roulette_from;
    return w.stages.roulette(w.storage.slots, settings.seed, bounce, play, runs, w.storage.rays);
}

/// Rays that leave a diffuse surface end here: nothing they could run into counts.
void end_diffuse(Runs& runs) { runs.run[static_cast<std::size_t>(Scattering::diffuse)].count = 0; }

}  // namespace

// ---- the pages ----------------------------------------------------------------------------------------------------

/// Path tracing. After the k-th pass of the loop a path has scattered k times; the last pass only looks at what its
/// rays run into, and is left out where nothing there could count.
template <class Real>
void trace_paths(Wave<Real>& w) {
    const Needs& needs = w.plan.needs();
    const std::uint32_t depth = w.plan.settings().depth;
    const bool anything_shines = needs.emitters || needs.background;
    const bool only_lights_sampled = needs.scattering_pdf && !needs.competing && !needs.background;

    std::uint32_t rays = generate(w);
    for (std::uint32_t bounce = 0; rays > 0; ++bounce) {
        w.proceed(rays);
        intersect(w, rays, bounce);
        gather_emission(w, rays, bounce);
        if (bounce == depth) break;
        Runs runs = sort_hits(w, rays, bounce);
        for (std::uint32_t k = 0; k < kernels::scattering_count; ++k)
            scatter(w, static_cast<Scattering>(k), runs, bounce);
        connect(w, runs, bounce);
        if (bounce + 1 == depth) {
            if (!anything_shines) break;
            if (only_lights_sampled) end_diffuse(runs);
        }
        rays = roulette(w, runs, bounce);
    }
}

/// Whitted ray tracing, L D S* E: diffuse surfaces end a ray, mirrors turn it, dielectrics branch it.
template <class Real>
void trace_whitted(Wave<Real>& w) {
    WaveStorage<Real>& s = w.storage;
    const auto k = [](Scattering kind) { return static_cast<std::size_t>(kind); };

    std::uint32_t rays = generate(w);
    for (std::uint32_t pass = 0; rays > 0; ++pass) {
        w.proceed(rays);
        intersect(w, rays, pass);
        gather_emission(w, rays, pass);
        w.stages.expire(w.plan.settings().depth, rays, s.rays);
        Runs runs = sort_hits(w, rays, pass);
        scatter(w, Scattering::diffuse, runs, pass);
        connect(w, runs, pass);
        end_diffuse(runs);
        scatter(w, Scattering::specular, runs, pass);
        const auto dielectric = runs.run[k(Scattering::dielectric)];
        if (dielectric.count > 0) {
            const StageTimer timer(w.counters, Stage::shade, pass,
                                   {dielectric.count, 2 * record_bytes(s.rays), w.stages.lanes});
            w.stages.branch(scatter_context(w, 0), dielectric, s.rays, s.hits, s.branches);
        }
        rays = roulette(w, runs, pass);
        if (w.plan.needs().branches) {
            const StageTimer timer(w.counters, Stage::roulette, pass, {0, 0, 0});
            rays = w.stages.resume(s.slots, s.branches, rays, s.rays, s.live);
        }
    }
}

/// Distance along the ray, the enclosing volume's where nothing is hit.
template <class Real>
void trace_distances(Wave<Real>& w) {
    WaveStorage<Real>& s = w.storage;
    intersect(w, generate(w), 0);
    for (std::uint32_t slot = 0; slot < w.count; ++slot) {
        const bool missed = s.hits.id[slot] == kernels::no_sphere;
        const Real distance = missed ? w.tables.enclosing_distance : s.hits.t[slot] * w.tables.unit;
        for (std::size_t c = 0; c < 3; ++c) s.slots.radiance[4 * slot + c] = distance;
    }
}

template void trace_paths(Wave<float>&);
template void trace_paths(Wave<double>&);
template void trace_whitted(Wave<float>&);
template void trace_whitted(Wave<double>&);
template void trace_distances(Wave<float>&);
template void trace_distances(Wave<double>&);

}  // namespace orrery
