// Stage `shade`, last step: the vertices of a run towards one light -> shadow queue.
//
// Runs after `scatter`: a ray's origin is the vertex, `left` its sphere and side, and its throughput already holds the
// surface's weight, so that what is missing is density of scattering over density of light sampling.
#pragma once

#include "kernels/compress.hpp"
#include "kernels/glossy.hpp"
#include "kernels/light.hpp"
#include "kernels/vertex.hpp"

namespace orrery::kernels {

template <class Real>
struct ConnectContext {
    SphereTable<Real> spheres;
    MaterialTable<Real> materials;
    SlotTable<Real> slots;
    std::uint32_t seed = 0;
    std::uint32_t bounce = 0;
    std::uint32_t light = 0;  ///< number of the light, for its random numbers
    /// Whether the light sample competes with scattering that may find the light as well (mis).
    bool competing = false;
};

/// Which density a vertex scatters with.
enum class Response { diffuse, glossy };

/// Scattering density per solid angle towards `direction`; the cosine is part of it. 0 below the horizon.
template <class V, Response response>
ORRERY_INLINE typename V::F response_pdf(const ConnectContext<typename V::Real>& context,
                                         const LobeQueue<typename V::Real>& lobes, std::uint32_t i,
                                         const typename V::U& sphere, const Vec3<typename V::F>& normal,
                                         const Vec3<typename V::F>& direction) {
    using F = typename V::F;
    using U = typename V::U;
    const F cosine = dot(normal, direction);
    if constexpr (response == Response::diffuse) {
        return max(cosine, F(0)) * F(static_cast<typename V::Real>(std::numbers::inv_pi));
    } else {
        const U material = lookup<U>(context.spheres.surface, sphere, context.spheres.count) & U(surface_material_mask);
        const F beta = lookup<F>(context.materials.roughness, material, context.materials.count);
        const auto lobe = load3<V>(lobes.x + i, lobes.y + i, lobes.z + i);
        return glossy_pdf<V>(lobe, max(dot(lobe, normal), F(0)), beta, direction, cosine);
    }
}

/// Appends the shadow rays of one vector of vertices whose lanes `chosen` are set.
template <class V>
ORRERY_INLINE std::uint32_t append_shadow(const ShadowQueue<typename V::Real>& queue, std::uint32_t size,
                                          const Vec3<typename V::F>& origin, const Vec3<typename V::F>& direction,
                                          const typename V::F& inverse_t_max, const Vec3<typename V::F>& radiance,
                                          const typename V::U& left, const typename V::U& slot, std::uint32_t chosen) {
    compress_store<V>(queue.ox + size, origin.x, chosen);
    compress_store<V>(queue.oy + size, origin.y, chosen);
    compress_store<V>(queue.oz + size, origin.z, chosen);
    compress_store<V>(queue.dx + size, direction.x, chosen);
    compress_store<V>(queue.dy + size, direction.y, chosen);
    compress_store<V>(queue.dz + size, direction.z, chosen);
    compress_store<V>(queue.inverse_t_max + size, inverse_t_max, chosen);
    compress_store<V>(queue.r + size, radiance.x, chosen);
    compress_store<V>(queue.g + size, radiance.y, chosen);
    compress_store<V>(queue.b + size, radiance.z, chosen);
    compress_store<V>(queue.left + size, left, chosen);
    compress_store<V>(queue.slot + size, slot, chosen);
    return size + static_cast<std::uint32_t>(std::popcount(chosen));
}

/// A vector of vertices, as the samplers of lights see it.
template <class V>
struct LitVertex {
    std::uint32_t i;  ///< place in the ray queue
    Vec3<typename V::F> position;
    Vec3<typename V::F> normal;  ///< unit length, on the side the vertex scatters into
    typename V::U sphere;        ///< id without side
    typename V::M inward;        ///< it scatters into the sphere
    typename V::U slot;
};

/// What a light sample brings to a vertex.
template <class V>
struct Arrival {
    Vec3<typename V::F> direction;  ///< unit length, towards the light
    typename V::F inverse_distance;
    typename V::F factor;   ///< of the light's colour, surface weight excluded
    typename V::M arrives;  ///< also where the factor is no number: the film counts it
};

/// Light samples from a point light.
template <class V, Response response>
struct PointSampler {
    static constexpr bool has_targets = false;  ///< all segments end on the same sphere, or on none
    const ConnectContext<typename V::Real>& context;
    const PointLight<typename V::Real>& light;
    const LobeQueue<typename V::Real>& lobes;

    ORRERY_INLINE Arrival<V> operator()(const RayQueue<typename V::Real>&, const LitVertex<V>& vertex) const {
        using F = typename V::F;
        const Vec3<F> to = Vec3<F>{F(light.px), F(light.py), F(light.pz)} - vertex.position;
        const F distance2 = dot(to, to);
        const F inverse_distance = F(1) / root(distance2);
        const Vec3<F> direction = to * inverse_distance;
        const F pdf = response_pdf<V, response>(context, lobes, vertex.i, vertex.sphere, vertex.normal, direction);
        return {direction, inverse_distance, pdf * inverse_distance * inverse_distance,
                !(pdf <= F(0)) && distance2 > F(0)};
    }
    ORRERY_INLINE Vec3<typename V::F> colour(const Arrival<V>&) const {
        using F = typename V::F;
        return {F(light.r), F(light.g), F(light.b)};
    }
};

/// A point of the sphere `id`, sampled from the vertex: from outside or from within, or from its own inner side. From
/// its own outer side nothing of it is seen. (By reference: what is returned g++ 12 moves through memory, a sixth of
/// all instructions of connect_area on AVX2.)
template <class V, LightStrategy strategy>
ORRERY_INLINE void sample_sphere(const LitVertex<V>& vertex, const Sphere<typename V::F>& sphere,
                                 const typename V::U& id, const RandomNumbers<typename V::F>& random,
                                 LightSample<V>& sample) {
    using F = typename V::F;
    // On the light itself its side is known; elsewhere the power of the point tells, as it tells `first_root` where a
    // ray meets the light: from a point on its surface (0) only from within.
    const auto own = words_equal(vertex.sphere, id);
    const auto within = power_of_point(vertex.position - sphere.centre, sphere.radius2) <= F(0);
    const auto inside = (own && vertex.inward) || (!own && within);
    if constexpr (strategy == LightStrategy::cone) {
        sample = sample_light_cone<V>(vertex.position, sphere, random.x, random.y);
        if (any(inside)) {
            const auto by_area = sample_light_area<V>(vertex.position, sphere, inside, random.x, random.y);
            sample.direction = choose(inside, by_area.direction, sample.direction);
            sample.inverse_distance = choose(inside, by_area.inverse_distance, sample.inverse_distance);
            sample.inverse_pdf = choose(inside, by_area.inverse_pdf, sample.inverse_pdf);
            sample.valid = (inside && by_area.valid) || (!inside && sample.valid);
        }
    } else {
        sample = sample_light_area<V>(vertex.position, sphere, inside, random.x, random.y);
    }
    sample.valid = sample.valid && (inside || !own);
}

/// Of a light sample whose density scattering exceeds `ratio` times, what the balance heuristic leaves it where the two
/// compete.
template <class F>
ORRERY_INLINE F shared_ratio(const F& ratio) {
    // Beyond 2^100 the weight 1 / (1 + ratio) would make inf / inf. What is no number stays none.
    const F bounded = min(F(0x1p100f), ratio);
    return bounded / (F(1) + bounded);
}

/// Light samples from a sphere, density of scattering over density of light sampling; weighed against scattering by the
/// balance heuristic where the two compete.
template <class V, Response response, LightStrategy strategy>
struct AreaSampler {
    static constexpr bool has_targets = false;
    const ConnectContext<typename V::Real>& context;
    const AreaLight<typename V::Real>& light;
    const LobeQueue<typename V::Real>& lobes;

    ORRERY_INLINE Arrival<V> operator()(const RayQueue<typename V::Real>& rays, const LitVertex<V>& vertex) const {
        using F = typename V::F;
        using U = typename V::U;
        const Sphere<F> sphere{
            {F(light.cx), F(light.cy), F(light.cz)}, F(light.radius), F(light.radius * light.radius)};
        const RandomKey key{context.seed, Dimension::light, context.light};
        const auto random = random_for<V, 2>(context.slots, rays, vertex.i, key, context.bounce, vertex.slot);
        LightSample<V> sample;
        sample_sphere<V, strategy>(vertex, sphere, U(light.sphere), random, sample);
        const F pdf =
            response_pdf<V, response>(context, lobes, vertex.i, vertex.sphere, vertex.normal, sample.direction);
        F ratio = pdf * sample.inverse_pdf;
        if (context.competing) ratio = shared_ratio(ratio);
        return {sample.direction, sample.inverse_distance, ratio, sample.valid && !(ratio <= F(0))};
    }
    ORRERY_INLINE Vec3<typename V::F> colour(const Arrival<V>&) const {
        using F = typename V::F;
        return {F(light.r), F(light.g), F(light.b)};
    }
};

/// The vertices of a run towards their light, a vector at a time. Returns the number of shadow rays.
template <class V, class Sampler>
ORRERY_INLINE std::uint32_t connect_run(const ConnectContext<typename V::Real>& context, Range run,
                                        const RayQueue<typename V::Real>& rays, const Sampler& sampler,
                                        const ShadowQueue<typename V::Real>& queue) {
    using F = typename V::F;
    using U = typename V::U;
    std::uint32_t size = 0;
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto in_run = first_lanes<V>(run.count - n);
        const U left = choose(in_run, load<U>(rays.left + i), U(0u));
        const U slot = choose(in_run, load<U>(rays.slot + i), U(0u));
        const U id = left & U(no_sphere);
        const auto inward = !words_equal(left, id);
        const auto p = load3<V>(rays.ox + i, rays.oy + i, rays.oz + i);
        const auto& spheres = context.spheres;
        const auto centre = lookup3<V>(spheres.cx, spheres.cy, spheres.cz, id, spheres.count);
        const Vec3<F> outward = (p - centre) * lookup<F>(spheres.inverse_radius, id, spheres.count);
        const Vec3<F> normal = choose(inward, outward * F(-1), outward);
        const auto light = sampler(rays, LitVertex<V>{i, p, normal, id, inward, slot});
        const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i);
        const std::uint32_t chosen = bits(light.arrives && in_run && !carries_nothing(throughput));
        if (chosen == 0) continue;
        if constexpr (Sampler::has_targets) {
            if (queue.target != nullptr) compress_store<V>(queue.target + size, sampler.target(light), chosen);
        }
        size = append_shadow<V>(queue, size, p, light.direction, light.inverse_distance,
                                throughput * (sampler.colour(light) * light.factor), left, slot, chosen);
    }
    return size;
}

template <class V, Response response>
std::uint32_t connect_point(const ConnectContext<typename V::Real>& context, const PointLight<typename V::Real>& light,
                            Range run, const RayQueue<typename V::Real>& rays, const LobeQueue<typename V::Real>& lobes,
                            const ShadowQueue<typename V::Real>& queue) {
    return connect_run<V>(context, run, rays, PointSampler<V, response>{context, light, lobes}, queue);
}

template <class V, Response response, LightStrategy strategy>
std::uint32_t connect_area(const ConnectContext<typename V::Real>& context, const AreaLight<typename V::Real>& light,
                           Range run, const RayQueue<typename V::Real>& rays, const LobeQueue<typename V::Real>& lobes,
                           const ShadowQueue<typename V::Real>& queue) {
    draw<V, 2>(context.slots, rays, run, {context.seed, Dimension::light, context.light}, context.bounce);
    return connect_run<V>(context, run, rays, AreaSampler<V, response, strategy>{context, light, lobes}, queue);
}

}  // namespace orrery::kernels
