// Rays as the tree wants them: a bunch of columns short enough for the first cache, each ray's slabs with the margin
// that keeps rounding from losing a hit.
#pragma once

#include "kernels/queues.hpp"
#include "kernels/tables.hpp"
#include "kernels/vec3.hpp"

namespace orrery::kernels {

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

template <class Real, std::uint32_t capacity = bunch_size>
struct alignas(64) TreeRays {
    using Word = WordOf<Real>;
    using Column = Real[capacity];
    Column inverse[3], near[3], far[3];
    Column limit;  ///< no hit beyond this is of interest, margin included; negative: none at all
    Column origin[3], direction[3];
    Word octant[capacity];  ///< bit a is set where the ray runs down axis a
    Word left[capacity];    ///< the sphere it is not to meet; no_sphere for none
};

/// Fills lanes i.. of the columns. A ray that is not finite meets nothing, whatever its limit: to the boxes'
/// comparisons it would meet all, also those of children that do not exist.
template <class V, std::uint32_t capacity>
ORRERY_INLINE void put_tree_rays(TreeRays<typename V::Real, capacity>& rays, std::uint32_t i,
                                 const Vec3<typename V::F>& o, const Vec3<typename V::F>& d, const typename V::U& left,
                                 typename V::Real extent, const typename V::F& limit) {
    using Real = typename V::Real;
    using F = typename V::F;
    using U = typename V::U;
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
    save(rays.left + i, left);
    const F sum = o.x + o.y + o.z + (d.x + d.y + d.z);
    save(rays.limit + i, choose(sum - sum == zero, limit, F(-1)));
}

}  // namespace orrery::kernels
