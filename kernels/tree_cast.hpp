// Stages `intersect` and `shadow` through the tree, a packet of rays at a time: the maths of sphere.hpp, one root at a
// time. The closest hit is the least (t, id) over all spheres the ray meets, which no order of visits can change.
#pragma once

#include <limits>

#include "kernels/tree_packets.hpp"

namespace orrery::kernels {

/// What a packet of rays has found so far.
template <class Real, std::uint32_t capacity = packet_size>
struct TreeHits {
    using Word = WordOf<Real>;
    alignas(64) Real t[capacity];   ///< t_max where nothing was met
    alignas(64) Word id[capacity];  ///< with inside_bit; no_sphere where nothing was met
};

/// Rays of a queue or columns. They begin at their origins and leave `departed`, or they begin at t_min and leave
/// nothing: one of the two is null.
template <class Real>
struct TreeSource {
    using Word = WordOf<Real>;
    const Real *ox, *oy, *oz, *dx, *dy, *dz;
    const Word* departed;
    const Real* t_min;
};

/// Those of a queue from its entry `first` on.
template <class Queue>
ORRERY_INLINE auto source_of(const Queue& q, std::uint32_t first) {
    return TreeSource<std::remove_pointer_t<decltype(q.ox)>>{q.ox + first,       q.oy + first, q.oz + first,
                                                             q.dx + first,       q.dy + first, q.dz + first,
                                                             q.departed + first, nullptr};
}

/// The first root of a chord that a ray of the source may take.
template <class Real>
ORRERY_INLINE Root<ScalarLanes<Real>> first_root(const TreeSource<Real>& source, std::uint32_t ray,
                                                 const Chord<Real>& line) {
    using One = ScalarLanes<Real>;
    const Real s = root(line.disc);
    return source.t_min == nullptr ? first_root<One>(line, s, FromOrigin{}, true)
                                   : first_root<One>(line, s, source.t_min[ray], true);
}
/// A ray is cut a hair behind its closest hit, so that rounding hides no equal one.
template <class F>
ORRERY_INLINE F tree_limit(const F& t) {
    return t * F(static_cast<float>(limit_margin));
}

/// Closest hits of `count` <= capacity rays with t_min < t < t_max, as loop.hpp's closest_hit has them.
/// hits.t holds t_max for every ray.
template <class V, std::uint32_t capacity>
ORRERY_INLINE void closest_in_tree(const Spheres<V>& spheres, const TreeSource<RealOf<V>>& source, std::uint32_t count,
                                   TreeHits<RealOf<V>, capacity>& hits) {
    using Real = typename V::Real;
    using Word = WordOf<RealOf<V>>;
    using F = Floats<V>;
    using U = Words<V>;
    TreeRays<Real, capacity> rays;
    TreeStack<V, capacity> stack;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto o = load3<V>(source.ox + i, source.oy + i, source.oz + i);
        const auto d = load3<V>(source.dx + i, source.dy + i, source.dz + i);
        F t = load<F>(hits.t + i);
        U id(no_sphere), departed(no_sphere);
        if (source.departed != nullptr) {
            departed = choose(first_lanes<V>(count - i), load<U>(source.departed + i), U(no_sphere));
            put_inner_roots<V>(spheres, o, d, departed, t, id);
        }
        put_tree_rays<V>(rays, i, o, d, departed & U(no_sphere), spheres.tree.extent, tree_limit(t));
        save(hits.t + i, t);
        save(hits.id + i, id);
    }
    traverse<V>(spheres, rays, count, stack,
                [&](std::uint32_t ray, const Chord<Real>& line, std::uint32_t k) ORRERY_INLINE_LAMBDA {
                    const auto found = first_root(source, ray, line);
                    if (!found.exists) return;
                    const Real t = found.num / found.den;
                    const Word id = found.inside ? Word{k} | inside_bit : Word{k};
                    const Word other = hits.id[ray] & no_sphere;
                    if (t < hits.t[ray] || (t == hits.t[ray] && other != no_sphere && k < other)) {
                        hits.t[ray] = t;
                        hits.id[ray] = id;
                        rays.limit[ray] = tree_limit(t);
                    }
                });
}

/// Which of `count` <= capacity rays meet a sphere but `target` with t_min < t < 1 / inverse_t_max, as
/// loop.hpp's any_hit has it: 1 or 0.
template <class V, std::uint32_t capacity = packet_size, class Target>
ORRERY_INLINE void occluded_in_tree(const Spheres<V>& spheres, const TreeSource<RealOf<V>>& source,
                                    const RealOf<V>* inverse_t_max, std::uint32_t count, const Target& target,
                                    WordOf<RealOf<V>>* occluded) {
    using Real = typename V::Real;
    using F = Floats<V>;
    using U = Words<V>;
    using One = ScalarLanes<Real>;
    TreeRays<Real, capacity> rays;
    TreeStack<V, capacity> stack;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto o = load3<V>(source.ox + i, source.oy + i, source.oz + i);
        const auto d = load3<V>(source.dx + i, source.dy + i, source.dz + i);
        const F inverse = load<F>(inverse_t_max + i);
        U blocked(0u), departed_id(no_sphere);
        if (source.departed != nullptr) {
            const U departed = choose(first_lanes<V>(count - i), load<U>(source.departed + i), U(no_sphere));
            departed_id = departed & U(no_sphere);
            const auto met = inner_root_before<V>(spheres, o, d, departed, targets_at<V>(target, i), inverse);
            blocked = choose(met, U(1u), blocked);
        }
        put_tree_rays<V>(rays, i, o, d, departed_id, spheres.tree.extent,
                         choose(words_equal(blocked, U(1u)), F(-1), tree_limit(F(1) / inverse)));
        save(occluded + i, blocked);
    }
    traverse<V>(spheres, rays, count, stack,
                [&](std::uint32_t ray, const Chord<Real>& line, std::uint32_t k) ORRERY_INLINE_LAMBDA {
                    if (k == targets_at<One>(target, ray) || occluded[ray] != 0) return;
                    const Real inverse = inverse_t_max[ray];
                    bool hit = source.t_min == nullptr && near_root_before<One>(line, inverse);
                    if (!hit && (source.t_min != nullptr || line.c <= 0)) {
                        const auto first = first_root(source, ray, line);
                        hit = first.exists && first.num * inverse < first.den;
                    }
                    if (!hit) return;
                    occluded[ray] = 1;
                    rays.limit[ray] = -1;
                });
}

template <class V>
void intersect_tree(const Spheres<V>& spheres, const Rays<V>& rays, std::uint32_t count, const Hits<V>& hits) {
    using Real = typename V::Real;
    using F = Floats<V>;
    using U = Words<V>;
    TreeHits<Real> found;
    for (std::uint32_t first = 0; first < count; first += packet_size) {
        const std::uint32_t packet = count - first < packet_size ? count - first : packet_size;
        SphereList<Real> list;
        if (collect<V>(spheres, span_of(rays, first, packet), list)) {
            intersect_list<V>(spheres, list, rays, first, first + packet, hits);
            continue;
        }
        for (std::uint32_t i = 0; i < packet_size; ++i) found.t[i] = std::numeric_limits<Real>::infinity();
        closest_in_tree<V>(spheres, source_of(rays, first), packet, found);
        for (std::uint32_t i = 0; i < packet; i += V::count) {
            save(hits.t + first + i, load<F>(found.t + i));
            save(hits.id + first + i, load<U>(found.id + i));
        }
    }
}

/// `target` as in targets_at, `deliver` as in shadow_among.
template <class V, class Target, class Deliver>
ORRERY_INLINE void shadow_in_tree(const Spheres<V>& spheres, const Shadows<V>& queue, std::uint32_t count,
                                  const Target& target, Deliver& deliver) {
    using Word = WordOf<RealOf<V>>;
    using U = Words<V>;
    alignas(64) Word occluded[packet_size];
    for (std::uint32_t first = 0; first < count; first += packet_size) {
        const std::uint32_t packet = count - first < packet_size ? count - first : packet_size;
        SphereList<RealOf<V>> list;
        if (collect<V>(spheres, span_of(queue, first, packet), list)) {
            shadow_among<V>(spheres, list, queue, first, first + packet, target, deliver);
            continue;
        }
        occluded_in_tree<V>(spheres, source_of(queue, first), queue.inverse_t_max + first, packet,
                            targets_behind(target, first), occluded);
        for (std::uint32_t i = 0; i < packet; i += V::count) {
            const auto live = first_lanes<V>(packet - i);
            deliver(first + i, live && words_equal(load<U>(occluded + i), U(0u)));
        }
    }
}

template <class V>
void shadow_tree(const Spheres<V>& spheres, const Shadows<V>& queue, std::uint32_t count, std::uint32_t target,
                 const Slots<V>& slots) {
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        AddRadiance<V> deliver{queue, slots};
        shadow_in_tree<V>(spheres, queue, count, ends, deliver);
    });
}

template <class V>
std::uint32_t unblocked_tree(const Spheres<V>& spheres, const Shadows<V>& queue, std::uint32_t count,
                             std::uint32_t target) {
    KeepUnblocked<V> deliver{queue};
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        shadow_in_tree<V>(spheres, queue, count, ends, deliver);
    });
    return deliver.size;
}

}  // namespace orrery::kernels
