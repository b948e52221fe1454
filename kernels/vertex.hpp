// Where a ray met a surface: position, normal, material, the numbers every way of scattering starts from.
#pragma once

#include "kernels/queues.hpp"
#include "kernels/random.hpp"
#include "kernels/sphere.hpp"

namespace orrery::kernels {

template <class V>
struct Vertex {
    Vec3Of<V> position;  ///< on the sphere to the last bit the radius allows
    Vec3Of<V> normal;    ///< unit length, on the side the ray arrived at
    Floats<V> cosine;    ///< of the arriving ray with the normal, in [0, 1]
    Words<V> sphere;     ///< id without side
    Words<V> side;       ///< inside_bit where the ray arrived from within, else 0
    Words<V> material;
};

/// `t` and `hit` as in HitQueue; dead lanes must carry the id of some sphere.
template <class V>
ORRERY_INLINE Vertex<V> vertex_at(const Spheres<V>& spheres, const Vec3Of<V>& origin, const Vec3Of<V>& direction,
                                  const Floats<V>& t, const Words<V>& hit) {
    using F = Floats<V>;
    using U = Words<V>;
    const U id = hit & U(no_sphere);
    const auto sphere = gather_sphere<V>(spheres, id);
    // origin + t d is good to an ulp of t, which may be large against the radius: the normal is normalised for itself
    // and the position put back onto the sphere.
    const Vec3<F> outward = unit(along(origin - sphere.centre, t, direction));
    const auto inside = !words_equal(hit, id);
    const Vec3<F> position = along(sphere.centre, sphere.radius, outward);
    const Vec3<F> normal = choose(inside, outward * F(-1), outward);
    const F cosine = min(max(F(0) - dot(normal, direction), F(0)), F(1));
    return {position,
            normal,
            cosine,
            id,
            hit & U(inside_bit),
            lookup<U>(spheres.surface, id, spheres.count) & U(surface_material_mask)};
}

/// Where rays leave from: unit normal at `position`, on the side they leave to; `departed` as in RayQueue.
template <class V>
ORRERY_INLINE Vec3Of<V> departed_normal(const Spheres<V>& spheres, const Vec3Of<V>& position,
                                        const Words<V>& departed) {
    using F = Floats<V>;
    using U = Words<V>;
    const U id = departed & U(no_sphere);
    const auto centre = lookup3<V>(spheres.cx, spheres.cy, spheres.cz, id, spheres.count);
    const Vec3<F> outward = (position - centre) * lookup<F>(spheres.inverse_radius, id, spheres.count);
    return choose(words_equal(departed, id), outward, outward * F(-1));
}

/// A vector of a run's rays where they arrive.
template <class V>
struct Arriving {
    Mask<V> live;  ///< in the run, and met something: an unsorted run holds its misses too
    Vec3Of<V> direction;
    Vertex<V> vertex;
};

/// Rays i.. of a queue, of which the first `count` lanes belong to the run.
template <class V>
ORRERY_INLINE Arriving<V> arriving(const Spheres<V>& spheres, const Rays<V>& rays, const Hits<V>& hits, std::uint32_t i,
                                   std::uint32_t count) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto in_run = first_lanes<V>(count);
    const U met = load<U>(hits.id + i);
    const auto live = in_run && !words_equal(met, U(no_sphere));
    const auto direction = load3<V>(rays.dx + i, rays.dy + i, rays.dz + i);
    return {live, direction,
            vertex_at<V>(spheres, load3<V>(rays.ox + i, rays.oy + i, rays.oz + i), direction, load<F>(hits.t + i),
                         choose(live, met, U(0u)))};
}

/// What a stage's rays are known by to randomness: those of a queue, or of a wave that has no rays yet.
template <class Real>
struct RayKeys {
    const WordOf<Real>* pixel;
    const WordOf<Real>* sample;
    const WordOf<Real>* vertex;  ///< null where all rays have the number of the bounce
};

template <class V>
ORRERY_INLINE Words<V> vertex_number(const WordOf<RealOf<V>>* vertex, std::uint32_t i, std::uint32_t bounce) {
    using U = Words<V>;
    return vertex != nullptr ? load<U>(vertex + i) : U(bounce);
}

/// Draws the first `dimensions` numbers of a block for the rays of a run, before the stage's own loop, where samples
/// are those of Sobol's sequences. In that loop the drawing would cost every stage registers, needed or not: 2 % of
/// a render of independent samples.
template <class V, int dimensions>
[[gnu::noinline]] void draw_sobol(const Slots<V>& slots, const RayKeys<RealOf<V>>& rays, Range run,
                                  const RandomKey& key, std::uint32_t bounce) {
    using U = Words<V>;
    const auto& to = slots.sobol;
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto point = sobol_block<V>(key, load<U>(rays.pixel + i), load<U>(rays.sample + i),
                                          vertex_number<V>(rays.vertex, i, bounce));
        save(to.x + i, point.x);
        if constexpr (dimensions > 1) save(to.y + i, point.y);
        if constexpr (dimensions > 2) save(to.z + i, point.z);
        if constexpr (dimensions > 3) save(to.w + i, point.w);
    }
}

template <class V, int dimensions>
ORRERY_INLINE void draw(const Slots<V>& slots, const Rays<V>& rays, Range run, const RandomKey& key,
                        std::uint32_t bounce) {
    if (slots.sobol.x != nullptr)
        draw_sobol<V, dimensions>(slots, {rays.pixel, rays.sample, rays.vertex}, run, key, bounce);
}

/// The numbers drawn for rays i.. of a queue.
template <class V, int dimensions>
ORRERY_INLINE RandomNumbers<Floats<V>> drawn(const SobolQueue<RealOf<V>>& sobol, std::uint32_t i) {
    using F = Floats<V>;
    const F none(0);
    return {load<F>(sobol.x + i), dimensions > 1 ? load<F>(sobol.y + i) : none,
            dimensions > 2 ? load<F>(sobol.z + i) : none, dimensions > 3 ? load<F>(sobol.w + i) : none};
}

/// The first `dimensions` random numbers of a block, others 0 or not, for rays i.. of a queue: those drawn if any were.
template <class V, int dimensions>
ORRERY_INLINE RandomNumbers<Floats<V>> random_for(const Slots<V>& slots, const Rays<V>& rays, std::uint32_t i,
                                                  const RandomKey& key, std::uint32_t bounce) {
    using U = Words<V>;
    if (slots.sobol.x != nullptr) [[unlikely]]
        return drawn<V, dimensions>(slots.sobol, i);
    return random_block<V>(key, load<U>(rays.pixel + i), load<U>(rays.sample + i),
                           vertex_number<V>(rays.vertex, i, bounce));
}

}  // namespace orrery::kernels
