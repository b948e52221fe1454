// A packet of rays through the tree, node by node: a node is read once for all rays that reach it.
//
// One ray fills the vector with sixteen boxes, or with the sixteen spheres of a leaf, so the lanes are full however
// little the rays agree, and the rays of a list are independent work that hides each other's latency. Which nodes a
// ray reaches, and in which order, depends on nothing but itself: the children are ordered by octant and each ray's
// boxes are its own. So its hit is the same whatever else is in the packet.
#pragma once

#include <bit>

#include "kernels/lanes/compress.hpp"
#include "kernels/sphere.hpp"

namespace orrery::kernels {

// Rays as the tree wants them: a packet of columns short enough for the first cache, each ray's slabs with the margin
// that keeps rounding from losing a hit.

/// A plane at x is crossed at t = x inverse + near or + far: near where the ray enters the slab, far where it leaves.
///
/// Why no hit is lost, in units of u = 2^-24 times `reach`, the largest coordinate of origin and tree together. Nothing
/// of interest lies farther than 3.5 reach. sphere.hpp finds a line that by rounding passes up to 3 ulp of |f| outside
/// a sphere, f = C - O, and places the root where a parallel line that far aside has it: 21 u. The slab's own rounding
/// is that of the inverse and of the fused sum, each relative to t, and three more of O inverse: 10 u. slab_margin is
/// 32 u, and by it near and far push the planes apart. That costs nothing per node, as the sums have to be made anyhow.
/// A component of the direction below least_slope is taken for least_slope, which moves the ray by less than a
/// thousandth of u: so 1 / D is finite, and no 0 * inf can arise. What remains is the rounding of a hit's t itself,
/// relative to t: limit_margin.
inline constexpr double slab_margin = 0x1p-19;
inline constexpr double least_slope = 0x1p-40;
inline constexpr double limit_margin = 1 + 0x1p-16;

template <class Real, std::uint32_t capacity = packet_size>
struct alignas(64) TreeRays {
    using Word = WordOf<Real>;
    using Column = Real[capacity];
    Column inverse[3], near[3], far[3];
    Column limit;  ///< no hit beyond this is of interest, margin included; negative: none at all
    Column origin[3], direction[3];
    Word octant[capacity];    ///< bit a is set where the ray runs down axis a
    Word departed[capacity];  ///< the sphere it is not to meet; no_sphere for none
};

/// Fills lanes i.. of the columns. A ray that is not finite meets nothing, whatever its limit: to the boxes'
/// comparisons it would meet all, also those of children that do not exist.
template <class V, std::uint32_t capacity>
ORRERY_INLINE void put_tree_rays(TreeRays<RealOf<V>, capacity>& rays, std::uint32_t i, const Vec3Of<V>& o,
                                 const Vec3Of<V>& d, const Words<V>& departed, RealOf<V> extent,
                                 const Floats<V>& limit) {
    using Real = typename V::Real;
    using F = Floats<V>;
    using U = Words<V>;
    const F reach = max(max(magnitude(o.x), magnitude(o.y)), max(magnitude(o.z), F(extent)));
    const F margin = reach * F(static_cast<Real>(slab_margin));
    const F zero(0), least(static_cast<Real>(least_slope));
    U octant(0u);
    const F* const from[3] = {&o.x, &o.y, &o.z};
    const F* const along[3] = {&d.x, &d.y, &d.z};
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const auto down = *along[axis] < zero;
        const F steep = max(magnitude(*along[axis]), least);
        const F inverse = choose(down, F(-1), F(1)) / steep;
        const F wide = margin * magnitude(inverse);
        const F start = *from[axis] * inverse;
        save(rays.inverse[axis] + i, inverse);
        save(rays.near[axis] + i, zero - start - wide);
        save(rays.far[axis] + i, wide - start);
        save(rays.origin[axis] + i, *from[axis]);
        save(rays.direction[axis] + i, *along[axis]);
        octant = octant | choose(down, U(1u << axis), U(0u));
    }
    save(rays.octant + i, octant);
    save(rays.departed + i, departed);
    const F sum = o.x + o.y + o.z + (d.x + d.y + d.z);
    save(rays.limit + i, choose(sum - sum == zero, limit, F(-1)));
}

/// A node on the way down: its rays, which children each of them has met, which are still to be visited.
struct TreeFrame {
    std::uint32_t node;
    std::uint32_t pending;      ///< children some ray has met
    std::uint64_t order;        ///< the next child to visit is in the lowest four bits
    std::uint32_t begin, size;  ///< rays, in TreeStack's columns; a vector of guard behind them
};

/// Room for a path from the root to the deepest node, every ray of the packet reaching it: 140 KB of stack for a whole
/// packet, of which an ordinary tree touches a tenth, and 4 KB for a single ray.
template <class V, std::uint32_t capacity>
struct TreeStack {
    using Word = WordOf<RealOf<V>>;
    static constexpr std::uint32_t room = (tree_depth + 1) * (capacity + V::count);
    TreeFrame frame[tree_depth];
    Word ray[room];  ///< place in TreeRays
    Word met[room];  ///< bit c: the ray has met child c
};

/// Writes for every ray of the list which children it meets before its limit, and none for a vector behind the last.
/// Returns those any ray meets.
template <class V, std::uint32_t capacity>
ORRERY_INLINE std::uint32_t meet_children(const TreeNode<RealOf<V>>& node, const TreeRays<RealOf<V>, capacity>& rays,
                                          std::uint32_t octant, const WordOf<RealOf<V>>* list, std::uint32_t size,
                                          WordOf<RealOf<V>>* met) {
    using F = Floats<V>;
    std::uint32_t some = 0;
    const auto* const near_x = node.bound[octant & 1u];
    const auto* const far_x = node.bound[~octant & 1u];
    const auto* const near_y = node.bound[2 + (octant >> 1 & 1u)];
    const auto* const far_y = node.bound[2 + (~octant >> 1 & 1u)];
    const auto* const near_z = node.bound[4 + (octant >> 2 & 1u)];
    const auto* const far_z = node.bound[4 + (~octant >> 2 & 1u)];
    for (std::uint32_t c = 0; c < tree_width; c += V::count) {
        const F nx = load<F>(near_x + c), fx = load<F>(far_x + c);
        const F ny = load<F>(near_y + c), fy = load<F>(far_y + c);
        const F nz = load<F>(near_z + c), fz = load<F>(far_z + c);
        for (std::uint32_t i = 0; i < size; ++i) {
            const auto r = list[i];
            const F ix(rays.inverse[0][r]), iy(rays.inverse[1][r]), iz(rays.inverse[2][r]);
            const F enter = max(max(mul_add(nx, ix, F(rays.near[0][r])), mul_add(ny, iy, F(rays.near[1][r]))),
                                max(mul_add(nz, iz, F(rays.near[2][r])), F(0)));
            const F leave = min(min(mul_add(fx, ix, F(rays.far[0][r])), mul_add(fy, iy, F(rays.far[1][r]))),
                                min(mul_add(fz, iz, F(rays.far[2][r])), F(rays.limit[r])));
            const std::uint32_t here = bits(enter <= leave) << c;
            met[i] = c == 0 ? here : met[i] | here;
            some |= here;
        }
    }
    save(met + size, Words<V>(0u));
    return some;
}

/// Tests every ray of the list against the sixteen spheres from `first` on. Behind a shorter leaf those are others of
/// the table, which can do no harm.
template <class V, std::uint32_t capacity, class Meet>
ORRERY_INLINE void meet_spheres(const Spheres<V>& spheres, std::uint32_t first, TreeRays<RealOf<V>, capacity>& rays,
                                const WordOf<RealOf<V>>* list, std::uint32_t size, const Meet& meet) {
    using Real = typename V::Real;
    using F = Floats<V>;
    using U = Words<V>;
    const std::uint32_t end = spheres.count - first < tree_width ? spheres.count : first + tree_width;
    for (std::uint32_t k = first; k < end; k += V::count) {
        const auto centre = load3<V>(spheres.cx + k, spheres.cy + k, spheres.cz + k);
        const F radius = load<F>(spheres.radius + k);
        const F radius2 = load<F>(spheres.radius2 + k);
        const U id = consecutive<V>(k);
        const std::uint32_t live = end - k < V::count ? (1u << (end - k)) - 1 : ~0u;
        for (std::uint32_t i = 0; i < size; ++i) {
            const auto r = list[i];
            const Vec3<F> o{F(rays.origin[0][r]), F(rays.origin[1][r]), F(rays.origin[2][r])};
            const Vec3<F> d{F(rays.direction[0][r]), F(rays.direction[1][r]), F(rays.direction[2][r])};
            const auto line = chord(o, d, Sphere<F>{centre, radius, radius2});
            std::uint32_t hit = bits(line.disc > F(0) && !words_equal(id, U(rays.departed[r]))) & live;
            if (hit == 0) continue;
            alignas(64) Real b[V::count], c[V::count], disc[V::count];
            save(b, line.b), save(c, line.c), save(disc, line.disc);
            do {
                const auto lane = static_cast<std::uint32_t>(std::countr_zero(hit));
                hit &= hit - 1;
                meet(static_cast<std::uint32_t>(r), Chord<Real>{b[lane], c[lane], disc[lane]}, k + lane);
            } while (hit != 0);
        }
    }
}

/// The entries of `from` where the bits of `key` under `mask` are `wanted`: to `to`. Returns how many. No entry of key
/// in the vector behind the last may fit.
template <class V>
ORRERY_INLINE std::uint32_t select(const WordOf<RealOf<V>>* from, const WordOf<RealOf<V>>* key, std::uint32_t size,
                                   WordOf<RealOf<V>> mask, WordOf<RealOf<V>> wanted, WordOf<RealOf<V>>* to) {
    using U = Words<V>;
    std::uint32_t chosen = 0;
    for (std::uint32_t i = 0; i < size; i += V::count) {
        const std::uint32_t lanes = bits(words_equal(load<U>(key + i) & U(mask), U(wanted)));
        compress_store<V>(to + chosen, load<U>(from + i), lanes);
        chosen += static_cast<std::uint32_t>(std::popcount(lanes));
    }
    return chosen;
}

/// Calls meet(ray, chord, sphere) for every sphere (and some in vain) whose line a ray may meet before its limit. meet
/// lowers the limit.
template <class V, std::uint32_t capacity, class Meet>
ORRERY_INLINE void traverse(const Spheres<V>& spheres, TreeRays<RealOf<V>, capacity>& rays, std::uint32_t count,
                            TreeStack<V, capacity>& stack, const Meet& meet) {
    using Word = WordOf<RealOf<V>>;
    const auto& tree = spheres.tree;
    alignas(64) Word places[capacity];
    for (std::uint32_t i = 0; i < count; i += V::count) save(places + i, consecutive<V>(i));
    for (std::uint32_t i = count; i % V::count != 0; ++i) rays.octant[i] = 8;

    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        const std::uint32_t size = select<V>(places, rays.octant, count, ~Word{0}, octant, stack.ray);
        if (size == 0) continue;
        TreeFrame* top = stack.frame;
        *top = {0, meet_children<V>(tree.nodes[0], rays, octant, stack.ray, size, stack.met),
                tree.nodes[0].order[octant], 0, size};
        while (true) {
            if (top->pending == 0) {
                if (top == stack.frame) break;
                --top;
                continue;
            }
            std::uint32_t bit = 0, c = 0;
            do {
                c = static_cast<std::uint32_t>(top->order & 15u);
                top->order >>= 4;
                bit = 1u << c;
            } while ((top->pending & bit) == 0);
            top->pending &= ~bit;
            // Behind the guard of the list above: a vector that meets nothing.
            const std::uint32_t begin = top->begin + top->size + V::count;
            const std::uint32_t rest =
                select<V>(stack.ray + top->begin, stack.met + top->begin, top->size, bit, bit, stack.ray + begin);
            const std::uint32_t child = tree.nodes[top->node].child[c];
            if ((child & leaf_bit) != 0) {
                meet_spheres<V>(spheres, child & ~leaf_bit, rays, stack.ray + begin, rest, meet);
            } else {
                const auto& node = tree.nodes[child];
                *++top = {child, meet_children<V>(node, rays, octant, stack.ray + begin, rest, stack.met + begin),
                          node.order[octant], begin, rest};
            }
        }
    }
}

}  // namespace orrery::kernels
