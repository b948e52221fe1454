// Each integrator as a page of steps. Start reading here.
#include "wavefront/wave.hpp"

namespace orrery {

using kernels::Runs;
using kernels::Scattering;

namespace {

/// Rays that leave surfaces of these kinds end here: nothing they could run into counts.
void end(Runs& runs, std::uint32_t kinds) {
    for (std::uint32_t k = 0; k < kernels::scattering_count; ++k)
        if ((kinds >> k & 1u) != 0) runs.run[k].count = 0;
}

}  // namespace

/// Path tracing. After the k-th pass of the loop a path has scattered k times; the last pass only looks at what its
/// rays run into, and is left out where nothing there could count.
template <class Real>
void trace_paths(Wave<Real>& w) {
    const Needs& needs = w.plan.needs();
    const std::uint32_t depth = w.plan.settings().depth;

    std::uint32_t rays = w.generate();
    for (std::uint32_t bounce = 0; rays > 0; ++bounce) {
        w.proceed(rays);
        w.intersect(rays, bounce);
        w.gather_emission(rays, bounce);
        if (bounce == depth) break;
        Runs runs = w.sort(rays, bounce);
        for (const Scattering kind : w.pipeline.kinds) w.scatter(kind, runs, bounce);
        w.direct_lighting(runs, bounce);
        w.caustics(runs, bounce);
        w.point_caustics(runs, bounce);
        w.guide(runs, bounce);
        if (bounce + 1 == depth) {
            if (!w.pipeline.emission) break;
            if (needs.lights_only) end(runs, needs.connect_area);
        }
        rays = w.roulette(runs, bounce);
    }
}

/// Whitted ray tracing, L D S* E: diffuse surfaces end a ray, mirrors turn it, dielectrics branch it.
template <class Real>
void trace_whitted(Wave<Real>& w) {
    std::uint32_t rays = w.generate();
    for (std::uint32_t pass = 0; rays > 0; ++pass) {
        w.proceed(rays);
        w.intersect(rays, pass);
        w.gather_emission(rays, pass);
        w.expire(rays);
        Runs runs = w.sort(rays, pass);
        w.scatter(Scattering::diffuse, runs, pass);
        w.direct_lighting(runs, pass);
        end(runs, kernels::bit_of(Scattering::diffuse));
        w.scatter(Scattering::specular, runs, pass);
        w.branch(runs, pass);
        rays = w.resume(w.roulette(runs, pass), pass);
    }
}

/// Distance along the ray, the enclosing volume's where nothing is hit.
template <class Real>
void trace_distances(Wave<Real>& w) {
    const WaveStorage<Real>& s = w.storage;
    w.intersect(w.generate(), 0);
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
