// Stage `shade`, last step: direct lighting. The vertices of a run, all towards one light or each towards the one its
// random number chooses -> shadow queue.
//
// Runs after `scatter`: a ray's origin is the vertex, `departed` its sphere and side, and its throughput already holds
// the surface's weight, so that what is missing is density of scattering over density of light sampling.
#pragma once

#include "kernels/lanes/compress.hpp"
#include "kernels/lobe_cap.hpp"
#include "kernels/stages.hpp"
#include "kernels/vertex.hpp"

namespace orrery::kernels {

/// A vector of vertices, as the lights' samplers see it.
template <class V>
struct LitVertex {
    std::uint32_t i;  ///< place in the ray queue
    Vec3Of<V> position;
    Vec3Of<V> normal;  ///< unit length, on the side the vertex scatters into
    Words<V> sphere;   ///< id without side
    Mask<V> inward;    ///< it scatters into the sphere
};

template <class F>
struct Lobe {
    Vec3<F> direction;  ///< unit length
    F dot_n, beta;      ///< cosine with the normal, >= 0, and roughness
};
/// Of the vertices' `sphere` and `normal`, about `direction`.
template <class V, class Context>
ORRERY_INLINE Lobe<Floats<V>> lobe_about(const Context& context, const Words<V>& sphere, const Vec3Of<V>& normal,
                                         const Vec3Of<V>& direction) {
    using F = Floats<V>;
    using U = Words<V>;
    const U material = lookup<U>(context.spheres.surface, sphere, context.spheres.count) & U(surface_material_mask);
    const F beta = lookup<F>(context.materials.roughness, material, context.materials.count);
    return {direction, max(dot(direction, normal), F(0)), beta};
}
template <class V>
ORRERY_INLINE Lobe<Floats<V>> lobe_of(const ConnectContext<RealOf<V>>& context, const Lobes<V>& lobes,
                                      const LitVertex<V>& vertex) {
    const std::uint32_t i = vertex.i;
    return lobe_about<V>(context, vertex.sphere, vertex.normal, load3<V>(lobes.x + i, lobes.y + i, lobes.z + i));
}

/// Scattering density per solid angle towards `direction`; the cosine is part of it. 0 below the horizon. `lobe()` is
/// asked at rough vertices only.
template <class V, Response response, class GetLobe>
ORRERY_INLINE Floats<V> response_pdf(const Vec3Of<V>& normal, const Vec3Of<V>& direction, const GetLobe& lobe) {
    using F = Floats<V>;
    const F cosine = dot(normal, direction);
    if constexpr (response == Response::diffuse) {
        return max(cosine, F(0)) * F(static_cast<RealOf<V>>(std::numbers::inv_pi));
    } else {
        const auto [axis, dot_n, beta] = lobe();
        return glossy_pdf<V>(axis, dot_n, beta, direction, cosine);
    }
}

/// Appends the shadow rays of one vector of vertices whose lanes `chosen` are set.
template <class V>
ORRERY_INLINE std::uint32_t append_shadow(const Shadows<V>& queue, std::uint32_t size, const Vec3Of<V>& origin,
                                          const Vec3Of<V>& direction, const Floats<V>& inverse_t_max,
                                          const Vec3Of<V>& radiance, const Words<V>& departed, const Words<V>& slot,
                                          std::uint32_t chosen) {
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
    compress_store<V>(queue.departed + size, departed, chosen);
    compress_store<V>(queue.slot + size, slot, chosen);
    return size + static_cast<std::uint32_t>(std::popcount(chosen));
}

/// The light that the numbers z and w in [0, 1) choose. Exact: the cell is the top bits of z, and w is compared with a
/// multiple of its last place.
template <class V>
ORRERY_INLINE Words<V> choose_light(const Lights<V>& lights, const Floats<V>& z, const Floats<V>& w) {
    using F = Floats<V>;
    using U = Words<V>;
    const U cell = truncate_to_word(z * F(static_cast<RealOf<V>>(lights.cells)));
    const auto own = w < lookup<F>(lights.share, cell, lights.cells);
    return choose(own, cell, lookup<U>(lights.other, cell, lights.cells));
}

/// Lanes whose vertex lies within the sphere `id`, or on its inner side. On the light itself the side is known;
/// elsewhere the power of the point tells, as it tells `first_root` where a ray meets the light: from a point on its
/// surface (0) only from within.
template <class V>
ORRERY_INLINE Mask<V> is_inside(const LitVertex<V>& vertex, const Sphere<Floats<V>>& sphere, const Words<V>& id) {
    const auto own = words_equal(vertex.sphere, id);
    const auto within = power_of_point(vertex.position - sphere.centre, sphere.radius2) <= Floats<V>(0);
    return (own && vertex.inward) || (!own && within);
}

/// A point of the sphere `id`, sampled from the vertex: from outside or from within, or from its own inner side. From
/// its own outer side nothing of it is seen. (By reference: what is returned g++ 12 moves through memory, a sixth of
/// all instructions of `connect` towards an area light on AVX2.)
template <class V, LightStrategy strategy>
ORRERY_INLINE void sample_sphere(const LitVertex<V>& vertex, const Sphere<Floats<V>>& sphere, const Words<V>& id,
                                 const RandomNumbers<Floats<V>>& random, LightSample<V>& sample) {
    const auto own = words_equal(vertex.sphere, id);
    const auto inside = is_inside<V>(vertex, sphere, id);
    if constexpr (strategy != LightStrategy::area) {
        sample = sample_light_cone<V>(vertex.position, sphere, random.x, random.y);
        if (any(inside)) {
            const auto by_area = sample_light_area<V>(vertex.position, sphere, inside, random.x, random.y);
            replace(sample, inside, by_area);
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

/// What the vertices of a run aim at: a point or a sphere that is the same for all, or each at a light of its choice.
enum class Aim { point, sphere, chosen };
/// How many random numbers that takes.
constexpr int dimensions_of(Aim aim) { return aim == Aim::point ? 0 : aim == Aim::sphere ? 2 : 4; }

/// What a light sample brings to a vertex.
template <class V>
struct Arrival {
    Vec3Of<V> direction;  ///< unit length, towards the light
    Floats<V> inverse_distance;
    Floats<V> factor;  ///< of the light's colour, surface weight excluded
    Mask<V> arrives;   ///< also where the factor is no number: the film counts it
    Words<V> chosen;   ///< light, where each vertex chooses
};

/// What a column says of the light: that of all vertices, or the one that each chose.
template <class V, Aim aim, class Element>
ORRERY_INLINE auto entry(const Element* column, std::uint32_t light, const Words<V>& chosen, std::uint32_t count) {
    using T = std::conditional_t<std::is_floating_point_v<Element>, Floats<V>, Words<V>>;
    if constexpr (aim == Aim::chosen) return lookup<T>(column, chosen, count);
    if constexpr (aim != Aim::chosen) return T(column[light]);
}

/// As sample_sphere from a rough vertex whose own directions are sampled, and the ratio of densities that
/// `sample_light` wants. `inside`: the vertex lies within the light, where a point of it is sampled.
template <class V>
ORRERY_INLINE void sample_by_lobe(const ConnectContext<RealOf<V>>& context, const Lobes<V>& lobes,
                                  const LitVertex<V>& vertex, const Sphere<Floats<V>>& sphere, const Words<V>& id,
                                  const RandomNumbers<Floats<V>>& random, LightSample<V>& sample, Floats<V>& ratio,
                                  Mask<V>& inside) {
    const auto [lobe, dot_n, beta] = lobe_of<V>(context, lobes, vertex);
    const auto on =
        sample_lobe_in_cap<V>(vertex.position, sphere, lobe, vertex.normal, dot_n, beta, random.x, random.y);
    sample = on.sample;
    sample.valid = sample.valid && !words_equal(vertex.sphere, id);
    ratio = on.factor;
    inside = is_inside<V>(vertex, sphere, id);
    if (any(inside)) {
        const auto by_area = sample_light_area<V>(vertex.position, sphere, inside, random.x, random.y);
        replace(sample, inside, by_area);
        const auto pdf = glossy_pdf<V>(lobe, dot_n, beta, by_area.direction, dot(by_area.direction, vertex.normal));
        ratio = choose(inside, pdf * by_area.inverse_pdf, ratio);
    }
}

/// Samples the light from a vector of vertices. The factor is the density of scattering over that of light sampling,
/// weighed against scattering by the balance heuristic where the two compete; for a point the inverse square takes the
/// place of the latter. (A function of its own: in the loop g++ 12 would keep a twelfth more of it in memory on AVX2.)
template <class V, Response response, Aim aim, LightStrategy strategy>
ORRERY_INLINE Arrival<V> sample_light(const ConnectContext<RealOf<V>>& context, std::uint32_t light,
                                      const Rays<V>& rays, const Lobes<V>& lobes, const LitVertex<V>& vertex,
                                      const RandomKey& key) {
    using F = Floats<V>;
    const auto& lights = context.lights;
    Words<V> chosen(0u);
    RandomNumbers<F> random{};
    if constexpr (dimensions_of(aim) > 0)
        random = random_for<V, dimensions_of(aim)>(context.slots, rays, vertex.i, key, context.bounce);
    if constexpr (aim == Aim::chosen) chosen = choose_light<V>(lights, random.z, random.w);
    const auto of = [&](const auto* column)
                        ORRERY_INLINE_LAMBDA { return entry<V, aim>(column, light, chosen, lights.count); };
    const F radius = of(lights.radius);
    const Sphere<F> source{{of(lights.px), of(lights.py), of(lights.pz)}, radius, radius * radius};
    const auto is_sphere = radius > F(0);
    constexpr bool by_lobe = response == Response::glossy && strategy == LightStrategy::exact && aim != Aim::point;
    LightSample<V> sample;
    F ratio(0);
    auto competing = is_sphere;  // where scattering may find the light as well
    if constexpr (aim != Aim::sphere) {
        sample = sample_point<V>(vertex.position, source.centre);
    } else if constexpr (!by_lobe) {
        sample_sphere<V, strategy>(vertex, source, of(lights.sphere), random, sample);
    }
    if constexpr (aim == Aim::chosen && !by_lobe) {
        if (any(is_sphere)) {
            LightSample<V> on;
            sample_sphere<V, strategy>(vertex, source, of(lights.sphere), random, on);
            replace(sample, is_sphere, on);
        }
    }
    if constexpr (aim != Aim::sphere || !by_lobe) {
        const F pdf = response_pdf<V, response>(
            vertex.normal, sample.direction, [&]() ORRERY_INLINE_LAMBDA { return lobe_of<V>(context, lobes, vertex); });
        ratio = pdf * sample.inverse_pdf;
        if constexpr (aim == Aim::point) ratio = pdf * sample.inverse_distance * sample.inverse_distance;
    }
    if constexpr (by_lobe) {
        LightSample<V> on;
        F factor(0);
        sample_by_lobe<V>(context, lobes, vertex, source, of(lights.sphere), random, on, factor, competing);
        competing = competing && is_sphere;
        if constexpr (aim == Aim::sphere) sample = on, ratio = factor;
        if constexpr (aim == Aim::chosen) replace(sample, is_sphere, on), ratio = choose(is_sphere, factor, ratio);
    } else if constexpr (aim != Aim::point && strategy == LightStrategy::exact) {
        competing = is_sphere && is_inside<V>(vertex, source, of(lights.sphere));
    }
    if constexpr (aim == Aim::chosen) ratio = ratio * of(lights.inverse_probability);
    if (aim != Aim::point && context.competing) {
        const F shared = shared_ratio(ratio);
        const bool all_compete = aim == Aim::sphere && strategy != LightStrategy::exact;
        ratio = all_compete ? shared : choose(competing, shared, ratio);
    }
    return {sample.direction, sample.inverse_distance, ratio, sample.valid && !(ratio <= F(0)), chosen};
}

/// The vertices of a run towards `light`, a vector at a time.
template <class V, Response response, Aim aim, LightStrategy strategy>
ORRERY_INLINE std::uint32_t connect_run(const ConnectContext<RealOf<V>>& context, std::uint32_t light, Range run,
                                        const Rays<V>& rays, const Lobes<V>& lobes, const Shadows<V>& queue) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& spheres = context.spheres;
    const auto& lights = context.lights;
    const RandomKey key{context.seed, Dimension::light, aim == Aim::sphere ? light - lights.points : 0};
    if constexpr (dimensions_of(aim) > 0) draw<V, dimensions_of(aim)>(context.slots, rays, run, key, context.bounce);
    std::uint32_t size = 0;
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto in_run = first_lanes<V>(run.count - n);
        const U departed = choose(in_run, load<U>(rays.departed + i), U(0u));
        const U id = departed & U(no_sphere);
        const auto inward = !words_equal(departed, id);
        const auto p = load3<V>(rays.ox + i, rays.oy + i, rays.oz + i);
        const auto normal = departed_normal<V>(spheres, p, departed);
        const auto sample = sample_light<V, response, aim, strategy>(context, light, rays, lobes,
                                                                     LitVertex<V>{i, p, normal, id, inward}, key);
        const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i);
        const std::uint32_t arriving = bits(sample.arrives && in_run && !carries_nothing(throughput));
        if (arriving == 0) continue;
        const auto of = [&](const auto* column)
                            ORRERY_INLINE_LAMBDA { return entry<V, aim>(column, light, sample.chosen, lights.count); };
        if constexpr (aim == Aim::chosen) {
            if (queue.target != nullptr) compress_store<V>(queue.target + size, of(lights.sphere), arriving);
        }
        const Vec3<F> colour{of(lights.r), of(lights.g), of(lights.b)};
        size = append_shadow<V>(queue, size, p, sample.direction, sample.inverse_distance,
                                throughput * (colour * sample.factor), departed, load<U>(rays.slot + i), arriving);
    }
    return size;
}

template <class V, Response response, LightStrategy strategy>
ORRERY_INLINE std::uint32_t connect_by(const ConnectContext<RealOf<V>>& context, std::uint32_t light, Range run,
                                       const Rays<V>& rays, const Lobes<V>& lobes, const Shadows<V>& queue) {
    if (light == chosen_light)
        return connect_run<V, response, Aim::chosen, strategy>(context, light, run, rays, lobes, queue);
    return connect_run<V, response, Aim::sphere, strategy>(context, light, run, rays, lobes, queue);
}

/// Returns the number of shadow rays. `light` is a light's number, or chosen_light where the table has cells.
template <class V, Response response>
std::uint32_t connect(const ConnectContext<RealOf<V>>& context, std::uint32_t light, Range run, const Rays<V>& rays,
                      const Lobes<V>& lobes, const Shadows<V>& queue) {
    using enum LightStrategy;
    if (light < context.lights.points)
        return connect_run<V, response, Aim::point, area>(context, light, run, rays, lobes, queue);
    if (context.strategy == cone) return connect_by<V, response, cone>(context, light, run, rays, lobes, queue);
    if (context.strategy == exact) return connect_by<V, response, exact>(context, light, run, rays, lobes, queue);
    return connect_by<V, response, area>(context, light, run, rays, lobes, queue);
}

}  // namespace orrery::kernels
