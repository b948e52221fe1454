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
    Floats<V> num, den;
    Words<V> id;  ///< with inside_bit
};

/// Fractions are compared by cross-multiplication: no division per sphere.
template <class V>
ORRERY_INLINE void keep_closer(Closest<V>& best, const Floats<V>& num, const Floats<V>& den, const Mask<V>& exists,
                               const Words<V>& id) {
    const auto closer = exists && (num * best.den < best.num * den);
    best.num = choose(closer, num, best.num);
    best.den = choose(closer, den, best.den);
    best.id = choose(closer, id, best.id);
}

/// What a ray leaves inward it meets again, at the far root and nowhere else: there, if that is before t.
template <class V>
ORRERY_INLINE void put_inner_roots(const Spheres<V>& spheres, const Vec3Of<V>& o, const Vec3Of<V>& d,
                                   const Words<V>& departed, Floats<V>& t, Words<V>& id) {
    using U = Words<V>;
    const U departed_id = departed & U(no_sphere);
    const auto inward = !words_equal(departed, departed_id);
    if (!any(inward)) return;
    const auto inner = inner_far_root(o, d, gather_sphere<V>(spheres, choose(inward, departed_id, U(0u))));
    const auto closer = inward && inner < t;
    t = choose(closer, inner, t);
    id = choose(closer, departed, id);
}
/// Lanes that meet what they leave before 1 / inverse_t_max, unless it is `target`.
template <class V, class Target>
ORRERY_INLINE Mask<V> inner_root_before(const Spheres<V>& spheres, const Vec3Of<V>& o, const Vec3Of<V>& d,
                                        const Words<V>& departed, const Target& target,
                                        const Floats<V>& inverse_t_max) {
    using F = Floats<V>;
    using U = Words<V>;
    const U departed_id = departed & U(no_sphere);
    const auto inward = !words_equal(departed, departed_id) && !words_equal(departed_id, U(target));
    if (!any(inward)) return inward;
    const F t = inner_far_root(o, d, gather_sphere<V>(spheres, choose(inward, departed_id, U(0u))));
    return inward && t * inverse_t_max < F(1);
}

/// Closest hit with t_min < t < t_max, t_max >= 0. `departed` is the sphere each ray leaves (inside_bit: inward),
/// no_sphere for none; it is meaningful only for segments that begin on it, so Start is FromOrigin wherever departed
/// names a sphere.
template <class V, class Among, class Start>
ORRERY_INLINE Closest<V> closest_hit(const Spheres<V>& spheres, const Among& among, const Vec3Of<V>& o,
                                     const Vec3Of<V>& d, const Words<V>& departed, const Start& t_min,
                                     const Floats<V>& t_max) {
    using F = Floats<V>;
    using U = Words<V>;
    const F zero(0);
    Closest<V> best{t_max, F(1), U(no_sphere)};

    put_inner_roots<V>(spheres, o, d, departed, best.num, best.id);
    const U departed_id = departed & U(no_sphere);
    among.each([&](std::uint32_t k) ORRERY_INLINE_LAMBDA {
        const auto line = chord(o, d, broadcast_sphere<V>(spheres, k));
        const F s = root(line.disc);
        const auto not_departed = !words_equal(departed_id, U(k));
        // Not for the sphere it has just departed from, whose c is zero give or take a rounding: a branch nobody could
        // predict.
        const auto within = not_departed && line.c <= zero;
        // From outside the near root c / (b + s) or none. Every sphere pays its square root: a branch around it was
        // taken for nearly every vector of bounced rays and cost more.
        if (std::is_same_v<Start, FromOrigin> && !any(within)) {
            keep_closer<V>(best, line.c, line.b + s, not_departed && min(line.b, line.disc) > zero, U(k));
        } else {
            const auto first = first_root<V>(line, s, t_min, not_departed && line.disc > zero);
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
ORRERY_INLINE Words<V> targets_at(const WordOf<RealOf<V>>* target, std::uint32_t i) {
    return load<Words<V>>(target + i);
}

/// Whether any sphere but `target` (one for all segments, or a vector) is met with t_min < t < t_max, given 1 / t_max
/// (0 for no end).
///
/// From the origin `near_root_before` tells of the near root; the far one counts from within a sphere only, which is
/// rare.
template <class V, class Among, class Start, class Target>
ORRERY_INLINE Mask<V> any_hit(const Spheres<V>& spheres, const Among& among, const Vec3Of<V>& o, const Vec3Of<V>& d,
                              const Words<V>& departed, const Start& t_min, const Floats<V>& inverse_t_max,
                              const Target& target, const Mask<V>& live) {
    using F = Floats<V>;
    using U = Words<V>;
    constexpr bool one_target = std::is_same_v<Target, std::uint32_t>;
    constexpr bool from_origin = std::is_same_v<Start, FromOrigin>;
    const F zero(0);
    const U departed_id = departed & U(no_sphere);
    auto blocked = !live || inner_root_before<V>(spheres, o, d, departed, target, inverse_t_max);
    among.each([&](std::uint32_t k) ORRERY_INLINE_LAMBDA {
        if constexpr (one_target) {
            if (k == target) return false;
        }
        const auto line = chord(o, d, broadcast_sphere<V>(spheres, k));
        auto not_departed = !words_equal(departed_id, U(k));
        if constexpr (!one_target) not_departed = not_departed && !words_equal(target, U(k));
        auto rest = not_departed && line.disc > zero;
        if constexpr (from_origin) {
            blocked = blocked || (not_departed && near_root_before<V>(line, inverse_t_max));
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
ORRERY_INLINE void intersect_among(const Spheres<V>& spheres, const Among& among, const Rays<V>& rays,
                                   std::uint32_t begin, std::uint32_t end, const Hits<V>& hits) {
    using F = Floats<V>;
    using U = Words<V>;
    const F infinity(std::numeric_limits<RealOf<V>>::infinity());
    for (std::uint32_t i = begin; i < end; i += V::count) {
        const auto o = load3<V>(rays.ox + i, rays.oy + i, rays.oz + i);
        const auto d = load3<V>(rays.dx + i, rays.dy + i, rays.dz + i);
        // Lanes behind the last ray hold old rays: their result is never read, but their ids must be valid ones.
        const auto live = first_lanes<V>(end - i);
        const U departed = choose(live, load<U>(rays.departed + i), U(no_sphere));
        const auto best = closest_hit<V>(spheres, among, o, d, departed, FromOrigin{}, infinity);
        save(hits.t + i, best.num / best.den);
        save(hits.id + i, choose(live, best.id, U(no_sphere)));
    }
}

template <class V>
void intersect(const Spheres<V>& spheres, const Rays<V>& rays, std::uint32_t count, const Hits<V>& hits) {
    intersect_among<V>(spheres, AllSpheres{spheres.count}, rays, 0, count, hits);
}

/// The same, faster where neighbours in the queue run alike and hardly slower where they do not. The table has
/// SomeSpheres::capacity spheres at most.
template <class V>
void intersect_coherent(const Spheres<V>& spheres, const Rays<V>& rays, std::uint32_t count, const Hits<V>& hits) {
    for (std::uint32_t begin = 0; begin < count; begin += packet_size) {
        const std::uint32_t end = count - begin < packet_size ? count : begin + packet_size;
        intersect_among<V>(spheres, candidates<V>(spheres, span_of(rays, begin, end - begin)), rays, begin, end, hits);
    }
}

/// What is lit: radiance to its slot.
template <class V>
struct AddRadiance {
    const Shadows<V>& queue;
    const Slots<V>& slots;

    ORRERY_INLINE void operator()(std::uint32_t i, const Mask<V>& lit) const {
        using U = Words<V>;
        if (!any(lit)) return;
        add_radiance<V>(slots, load<U>(queue.slot + i), load3<V>(queue.r + i, queue.g + i, queue.b + i), lit);
    }
};

/// What is lit: to the front of the queue, in order.
template <class V>
struct KeepUnblocked {
    const Shadows<V>& queue;
    std::uint32_t size = 0;

    ORRERY_INLINE void operator()(std::uint32_t i, const Mask<V>& lit) {
        const std::uint32_t chosen = bits(lit);
        if (chosen == 0) return;
        move_record<V>(queue, i, queue, size, chosen);
        size += static_cast<std::uint32_t>(std::popcount(chosen));
    }
};

/// Calls deliver(i, lanes that nothing blocks) for every vector of segments.
template <class V, class Among, class Target, class Deliver>
ORRERY_INLINE void shadow_among(const Spheres<V>& spheres, const Among& among, const Shadows<V>& queue,
                                std::uint32_t begin, std::uint32_t end, const Target& target, Deliver& deliver) {
    using F = Floats<V>;
    using U = Words<V>;
    for (std::uint32_t i = begin; i < end; i += V::count) {
        const auto live = first_lanes<V>(end - i);
        const auto o = load3<V>(queue.ox + i, queue.oy + i, queue.oz + i);
        const auto d = load3<V>(queue.dx + i, queue.dy + i, queue.dz + i);
        const U departed = choose(live, load<U>(queue.departed + i), U(no_sphere));
        const auto blocked = any_hit<V>(spheres, among, o, d, departed, FromOrigin{}, load<F>(queue.inverse_t_max + i),
                                        targets_at<V>(target, i), live);
        deliver(i, live && !blocked);
    }
}

/// The same for a packet at a time, as intersect_coherent.
template <class V, class Target, class Deliver>
ORRERY_INLINE void shadow_in_packets(const Spheres<V>& spheres, const Shadows<V>& queue, std::uint32_t count,
                                     const Target& target, Deliver& deliver) {
    for (std::uint32_t begin = 0; begin < count; begin += packet_size) {
        const std::uint32_t end = count - begin < packet_size ? count : begin + packet_size;
        const SomeSpheres among = candidates<V>(spheres, span_of(queue, begin, end - begin));
        shadow_among<V>(spheres, among, queue, begin, end, target, deliver);
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
void shadow(const Spheres<V>& spheres, const Shadows<V>& queue, std::uint32_t count, std::uint32_t target,
            const Slots<V>& slots) {
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        AddRadiance<V> deliver{queue, slots};
        shadow_among<V>(spheres, AllSpheres{spheres.count}, queue, 0, count, ends, deliver);
    });
}

/// The same, as intersect_coherent.
template <class V>
void shadow_coherent(const Spheres<V>& spheres, const Shadows<V>& queue, std::uint32_t count, std::uint32_t target,
                     const Slots<V>& slots) {
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        AddRadiance<V> deliver{queue, slots};
        shadow_in_packets<V>(spheres, queue, count, ends, deliver);
    });
}

/// Compacts the queue to the segments that nothing but their target meets, as `shadow` has it; returns how many.
template <class V>
std::uint32_t unblocked(const Spheres<V>& spheres, const Shadows<V>& queue, std::uint32_t count, std::uint32_t target) {
    KeepUnblocked<V> deliver{queue};
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        shadow_among<V>(spheres, AllSpheres{spheres.count}, queue, 0, count, ends, deliver);
    });
    return deliver.size;
}

/// The same, as intersect_coherent.
template <class V>
std::uint32_t unblocked_coherent(const Spheres<V>& spheres, const Shadows<V>& queue, std::uint32_t count,
                                 std::uint32_t target) {
    KeepUnblocked<V> deliver{queue};
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        shadow_in_packets<V>(spheres, queue, count, ends, deliver);
    });
    return deliver.size;
}

}  // namespace orrery::kernels
