// Coherent rays and a tree: one cone goes down for all of them, and what spheres it finds they take in a loop.
//
// A packet of camera rays meets a dozen spheres where every ray of it alone would visit the same nodes. A cone is
// tested against sixteen boxes at a time, each as the ball around it; where it finds too many spheres or passes too
// many nodes, the rays go down one by one as they would have (tree_cast.hpp), to the same hits.
#pragma once

#include "kernels/loop.hpp"
#include "kernels/tree_traverse.hpp"

namespace orrery::kernels {

/// Spheres by id, ascending; an Among for closest and any hit.
template <class Real>
struct SphereList {
    using Word = WordOf<Real>;
    /// More go down the tree ray by ray. Of 16, 32, 48, 64 and 128 this is the least with all there is to gain: camera
    /// rays to 694 spheres in strings take 23 ns with 32, 17 with 64 and 15 with 128; worlds of 484, 1024 and 65536 do
    /// not care (AVX-512). Nor do they for 24, 96 or 192 nodes, but that the largest pays 2 % for more in vain.
    static constexpr std::uint32_t capacity = 64;
    std::uint32_t count = 0;
    alignas(64) Word id[capacity + widest];

    template <class Test>
    ORRERY_INLINE void each(const Test& test) const {
        for (std::uint32_t i = 0; i < count; ++i)
            if (test(static_cast<std::uint32_t>(id[i]))) return;
    }
};

/// Sorts, and leaves out what stands there twice: a leaf is tested with the spheres behind it.
template <class Real>
ORRERY_INLINE void put_in_order(SphereList<Real>& list) {
    std::uint32_t size = 0;
    for (std::uint32_t i = 0; i < list.count; ++i) {
        const auto id = list.id[i];
        std::uint32_t at = size;
        while (at > 0 && list.id[at - 1] > id) --at;
        if (at > 0 && list.id[at - 1] == id) continue;
        for (std::uint32_t j = size; j > at; --j) list.id[j] = list.id[j - 1];
        list.id[at] = id;
        ++size;
    }
    list.count = size;
}

/// Adds those spheres of a leaf that the cone meets. False where the list overflows.
template <class V>
ORRERY_INLINE bool collect_leaf(const Spheres<V>& spheres, const Cone<V>& cone, std::uint32_t first,
                                SphereList<RealOf<V>>& list) {
    const std::uint32_t last = spheres.count - first < tree_width ? spheres.count : first + tree_width;
    for (std::uint32_t k = first; k < last; k += V::count) {
        const std::uint32_t live = last - k < V::count ? (1u << (last - k)) - 1 : ~0u;
        const auto centre = load3<V>(spheres.cx + k, spheres.cy + k, spheres.cz + k);
        const std::uint32_t met = bits(cone.may_meet(centre, load<Floats<V>>(spheres.radius + k))) & live;
        compress_store<V>(list.id + list.count, consecutive<V>(k), met);
        list.count += static_cast<std::uint32_t>(std::popcount(met));
        if (list.count > list.capacity) return false;
    }
    return true;
}

/// Collects what spheres the packet may meet. False where they are too many or too far apart in the tree.
template <class V>
ORRERY_INLINE bool collect(const Spheres<V>& spheres, const Packet<RealOf<V>>& packet, SphereList<RealOf<V>>& list) {
    using Real = typename V::Real;
    using F = Floats<V>;
    constexpr std::uint32_t most_nodes = 24;
    const Cone<V> cone(packet);
    if (!cone.narrow) return false;
    const F rounding(spheres.tree.extent * Real(0x1p-22));
    std::uint32_t waiting[most_nodes + tree_width];
    std::uint32_t end = 1;
    waiting[0] = 0;
    for (std::uint32_t at = 0; at < end; ++at) {
        if (end > most_nodes) return false;
        const auto& node = spheres.tree.nodes[waiting[at]];
        for (std::uint32_t c = 0; c < tree_width; c += V::count) {
            const auto low = load3<V>(node.bound[0] + c, node.bound[2] + c, node.bound[4] + c);
            const auto high = load3<V>(node.bound[1] + c, node.bound[3] + c, node.bound[5] + c);
            const Vec3<F> half = (high - low) * F(Real(0.5));
            // The middle of a box far from the world's origin is rounded by more than the cone allows for.
            const F radius = root(dot(half, half)) + rounding;
            // An unused child's box is empty: its half is -inf.
            std::uint32_t may = bits(cone.may_meet((high + low) * F(Real(0.5)), radius) && half.x >= F(0));
            for (; may != 0; may &= may - 1) {
                const std::uint32_t child = node.child[c + static_cast<std::uint32_t>(std::countr_zero(may))];
                if ((child & leaf_bit) == 0)
                    waiting[end++] = child;
                else if (!collect_leaf<V>(spheres, cone, child & ~leaf_bit, list))
                    return false;
            }
            if (end > most_nodes) return false;
        }
    }
    put_in_order(list);
    return true;
}

/// The same for rays that may run anywhere; false also where they are not alike.
template <class V>
ORRERY_INLINE bool collect(const Spheres<V>& spheres, const RaySpan<RealOf<V>>& rays, SphereList<RealOf<V>>& list) {
    return may_be_coherent(rays) && collect<V>(spheres, bound<V>(rays), list);
}

/// The least (t, id) of the list for every ray, as the tree has it: t is divided before it is compared.
template <class V>
ORRERY_INLINE void intersect_list(const Spheres<V>& spheres, const SphereList<RealOf<V>>& list, const Rays<V>& rays,
                                  std::uint32_t begin, std::uint32_t end, const Hits<V>& hits) {
    using F = Floats<V>;
    using U = Words<V>;
    for (std::uint32_t i = begin; i < end; i += V::count) {
        const auto o = load3<V>(rays.ox + i, rays.oy + i, rays.oz + i);
        const auto d = load3<V>(rays.dx + i, rays.dy + i, rays.dz + i);
        const U departed = choose(first_lanes<V>(end - i), load<U>(rays.departed + i), U(no_sphere));
        const U departed_id = departed & U(no_sphere);
        F t(std::numeric_limits<RealOf<V>>::infinity());
        U id(no_sphere);
        put_inner_roots<V>(spheres, o, d, departed, t, id);
        list.each([&](std::uint32_t k) ORRERY_INLINE_LAMBDA {
            const auto line = chord(o, d, broadcast_sphere<V>(spheres, k));
            const auto candidate = line.disc > F(0) && !words_equal(departed_id, U(k));
            if (!any(candidate)) return false;
            const auto first = first_root<V>(line, root(line.disc), FromOrigin{}, candidate);
            const F here = first.num / first.den;
            // Ids ascend: an equal hit counts only before the inner root of a sphere further on.
            const auto before = words_equal(((U(k) - (id & U(no_sphere))) >> 31) & U(1u), U(1u));
            const auto tie = here == t && before && !words_equal(id, U(no_sphere));
            const auto closer = first.exists && (here < t || tie);
            t = choose(closer, here, t);
            id = choose(closer, choose(first.inside, U(k | inside_bit), U(k)), id);
            return false;
        });
        save(hits.t + i, t);
        save(hits.id + i, id);
    }
}

}  // namespace orrery::kernels
