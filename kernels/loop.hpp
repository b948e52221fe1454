// Stages `intersect` and `shadow` by a loop over spheres: rays -> closest hits, and what the shadow queue carries
// arrives where nothing blocks it. Lanes are rays; the spheres pass by one at a time.
#pragma once

#include <limits>

#include "kernels/packets.hpp"
#include "kernels/radiance.hpp"
#include "kernels/sphere.hpp"

namespace orrery::kernels {

/// The closest hit so far, t = num / den.
template <class V>
struct Closest {
    typename V::F num, den;
    typename V::U id;  ///< with inside_bit
};

/// Fractions are compared by cross-multiplication: no division per sphere.
template <class V>
ORRERY_INLINE void keep_closer(Closest<V>& best, const typename V::F& num, const typename V::F& den,
                               const typename V::M& exists, const typename V::U& id) {
    const auto closer = exists && (num * best.den < best.num * den);
    best.num = choose(closer, num, best.num);
    best.den = choose(closer, den, best.den);
    best.id = choose(closer, id, best.id);
}

/// What a ray leaves inward it meets again, at the far root and nowhere else: there, if that is before t.
template <class V>
ORRERY_INLINE void put_inner_roots(const SphereTable<typename V::Real>& spheres, const Vec3<typename V::F>& o,
                                   const Vec3<typename V::F>& d, const typename V::U& left, typename V::F& t,
                                   typename V::U& id) {
    using U = typename V::U;
    const U left_id = left & U(no_sphere);
    const auto inward = !words_equal(left, left_id);
    if (!any(inward)) return;
    const auto inner = inner_far_root(o, d, gather_sphere<V>(spheres, choose(inward, left_id, U(0u))));
    const auto closer = inward && inner < t;
    t = choose(closer, inner, t);
    id = choose(closer, left, id);
}
/// Lanes that meet what they leave before 1 / inverse_t_max, unless it is `target`.
template <class V, class Target>
ORRERY_INLINE typename V::M inner_root_before(const SphereTable<typename V::Real>& spheres,
                                              const Vec3<typename V::F>& o, const Vec3<typename V::F>& d,
                                              const typename V::U& left, const Target& target,
                                              const typename V::F& inverse_t_max) {
    using F = typename V::F;
    using U = typename V::U;
    const U left_id = left & U(no_sphere);
    const auto inward = !words_equal(left, left_id) && !words_equal(left_id, U(target));
    if (!any(inward)) return no_lane<V>();
    const F t = inner_far_root(o, d, gather_sphere<V>(spheres, choose(inward, left_id, U(0u))));
    return inward && t * inverse_t_max < F(1);
}

/// Closest hit with t_min < t < t_max, t_max >= 0. `left` is the sphere each ray leaves (inside_bit: inward), no_sphere
/// for none; it is meaningful only for segments that begin on it, so Start is FromOrigin wherever left names a sphere.
template <class V, class Among, class Start>
ORRERY_INLINE Closest<V> closest_hit(const SphereTable<typename V::Real>& spheres, const Among& among,
                                     const Vec3<typename V::F>& o, const Vec3<typename V::F>& d,
                                     const typename V::U& left, const Start& t_min, const typename V::F& t_max) {
    using F = typename V::F;
    using U = typename V::U;
    const F zero(0);
    Closest<V> best{t_max, F(1), U(no_sphere)};

    put_inner_roots<V>(spheres, o, d, left, best.num, best.id);
    const U left_id = left & U(no_sphere);
    among.each([&](std::uint32_t k) ORRERY_INLINE_LAMBDA {
        const auto line = chord(o, d, broadcast_sphere<V>(spheres, k));
        const F s = root(line.disc);
        const auto not_left = !words_equal(left_id, U(k));
        // Not for the sphere just left, whose c is zero give or take a rounding: a branch nobody could predict.
        const auto within = not_left && line.c <= zero;
        // From outside the near root c / (b + s) or none. Every sphere pays its square root: a branch around it was
        // taken for nearly every vector of bounced rays and cost more.
        if (std::is_same_v<Start, FromOrigin> && !any(within)) {
            keep_closer<V>(best, line.c, line.b + s, not_left && min(line.b, line.disc) > zero, U(k));
        } else {
            const auto first = first_root<V>(line, s, t_min, not_left && line.disc > zero);
            keep_closer<V>(best, first.num, first.den, first.exists, choose(first.inside, U(k | inside_bit), U(k)));
        }
        return false;
    });
    return best;
}

// What segments end on, which cannot block them, is one sphere for all of a queue or a column of spheres; no_sphere
// stands for none.

/// The part of it behind the first n segments.
ORRERY_INLINE std::uint32_t targets_behind(std::uint32_t target, std::uint32_t) { return target; }
template <class Word>
ORRERY_INLINE const Word* targets_behind(const Word* target, std::uint32_t n) {
    return target + n;
}
/// What segments i.. end on, as any_hit wants it.
template <class V>
ORRERY_INLINE std::uint32_t targets_at(std::uint32_t target, std::uint32_t) {
    return target;
}
template <class V>
ORRERY_INLINE typename V::U targets_at(const typename V::Word* target, std::uint32_t i) {
    return load<typename V::U>(target + i);
}

/// Whether any sphere but `target` (one for all segments, or a vector) is met with t_min < t < t_max, given 1 / t_max
/// (0 for no end).
///
/// From the origin the near root c / (b + s) lies before t_max exactly when g = c / t_max - b is negative or g^2 <
/// disc: no square root and no division per sphere. The far root counts from within a sphere only, which is rare.
template <class V, class Among, class Start, class Target>
ORRERY_INLINE typename V::M any_hit(const SphereTable<typename V::Real>& spheres, const Among& among,
                                    const Vec3<typename V::F>& o, const Vec3<typename V::F>& d,
                                    const typename V::U& left, const Start& t_min, const typename V::F& inverse_t_max,
                                    const Target& target, const typename V::M& live) {
    using F = typename V::F;
    using U = typename V::U;
    constexpr bool one_target = std::is_same_v<Target, std::uint32_t>;
    constexpr bool from_origin = std::is_same_v<Start, FromOrigin>;
    const F zero(0);
    const U left_id = left & U(no_sphere);
    auto blocked = !live || inner_root_before<V>(spheres, o, d, left, target, inverse_t_max);
    among.each([&](std::uint32_t k) ORRERY_INLINE_LAMBDA {
        if constexpr (one_target) {
            if (k == target) return false;
        }
        const auto line = chord(o, d, broadcast_sphere<V>(spheres, k));
        auto not_left = !words_equal(left_id, U(k));
        if constexpr (!one_target) not_left = not_left && !words_equal(target, U(k));
        auto rest = not_left && line.disc > zero;
        if constexpr (from_origin) {
            blocked = blocked || (not_left && near_root_before<V>(line, inverse_t_max));
            rest = rest && line.c <= zero;
        }
        if (any(rest)) {
            const auto first = first_root<V>(line, root(line.disc), t_min, rest);
            blocked = blocked || (first.exists && first.num * inverse_t_max < first.den);
        }
        return all(blocked);
    });
    return blocked && live;
}

template <class V, class Among>
ORRERY_INLINE void intersect_among(const SphereTable<typename V::Real>& spheres, const Among& among,
                                   const RayQueue<typename V::Real>& rays, std::uint32_t begin, std::uint32_t end,
                                   const HitQueue<typename V::Real>& hits) {
    using F = typename V::F;
    using U = typename V::U;
    const F infinity(std::numeric_limits<typename V::Real>::infinity());
    for (std::uint32_t i = begin; i < end; i += V::count) {
        const auto o = load3<V>(rays.ox + i, rays.oy + i, rays.oz + i);
        const auto d = load3<V>(rays.dx + i, rays.dy + i, rays.dz + i);
        // Lanes behind the last ray hold old rays: their result is never read, but their ids must be valid ones.
        const auto live = first_lanes<V>(end - i);
        const U left = choose(live, load<U>(rays.left + i), U(no_sphere));
        const auto best = closest_hit<V>(spheres, among, o, d, left, FromOrigin{}, infinity);
        save(hits.t + i, best.num / best.den);
        save(hits.id + i, choose(live, best.id, U(no_sphere)));
    }
}

template <class V>
void intersect(const SphereTable<typename V::Real>& spheres, const RayQueue<typename V::Real>& rays,
               std::uint32_t count, const HitQueue<typename V::Real>& hits) {
    intersect_among<V>(spheres, AllSpheres{spheres.count}, rays, 0, count, hits);
}

/// The same, faster where neighbours in the queue run alike and hardly slower where they do not. The table has
/// SomeSpheres::capacity spheres at most.
template <class V>
void intersect_coherent(const SphereTable<typename V::Real>& spheres, const RayQueue<typename V::Real>& rays,
                        std::uint32_t count, const HitQueue<typename V::Real>& hits) {
    for (std::uint32_t begin = 0; begin < count; begin += bunch_size) {
        const std::uint32_t end = count - begin < bunch_size ? count : begin + bunch_size;
        intersect_among<V>(spheres, candidates<V>(spheres, span_of(rays, begin, end - begin)), rays, begin, end, hits);
    }
}

template <class V, class Among, class Target>
ORRERY_INLINE void shadow_among(const SphereTable<typename V::Real>& spheres, const Among& among,
                                const ShadowQueue<typename V::Real>& queue, std::uint32_t begin, std::uint32_t end,
                                const Target& target, const SlotTable<typename V::Real>& slots) {
    using F = typename V::F;
    using U = typename V::U;
    for (std::uint32_t i = begin; i < end; i += V::count) {
        const auto live = first_lanes<V>(end - i);
        const auto o = load3<V>(queue.ox + i, queue.oy + i, queue.oz + i);
        const auto d = load3<V>(queue.dx + i, queue.dy + i, queue.dz + i);
        const U left = choose(live, load<U>(queue.left + i), U(no_sphere));
        const auto blocked = any_hit<V>(spheres, among, o, d, left, FromOrigin{}, load<F>(queue.inverse_t_max + i),
                                        targets_at<V>(target, i), live);
        const auto lit = live && !blocked;
        if (!any(lit)) continue;
        add_radiance<V>(slots, load<U>(queue.slot + i), load3<V>(queue.r + i, queue.g + i, queue.b + i), lit);
    }
}

/// Calls run(target) with what the queue's segments end on: its column, or `target` for all of them.
template <class Real, class Run>
ORRERY_INLINE void with_target(const ShadowQueue<Real>& queue, std::uint32_t target, const Run& run) {
    if (queue.target != nullptr) return run(static_cast<const WordOf<Real>*>(queue.target));
    run(target);
}

/// Where the queue has no column for it, `target` is the light's own sphere, which bounds the segments and cannot block
/// them; no_sphere for a point light.
template <class V>
void shadow(const SphereTable<typename V::Real>& spheres, const ShadowQueue<typename V::Real>& queue,
            std::uint32_t count, std::uint32_t target, const SlotTable<typename V::Real>& slots) {
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        shadow_among<V>(spheres, AllSpheres{spheres.count}, queue, 0, count, ends, slots);
    });
}

/// The same, as intersect_coherent.
template <class V>
void shadow_coherent(const SphereTable<typename V::Real>& spheres, const ShadowQueue<typename V::Real>& queue,
                     std::uint32_t count, std::uint32_t target, const SlotTable<typename V::Real>& slots) {
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        for (std::uint32_t begin = 0; begin < count; begin += bunch_size) {
            const std::uint32_t end = count - begin < bunch_size ? count : begin + bunch_size;
            const SomeSpheres among = candidates<V>(spheres, span_of(queue, begin, end - begin));
            shadow_among<V>(spheres, among, queue, begin, end, ends, slots);
        }
    });
}

}  // namespace orrery::kernels
