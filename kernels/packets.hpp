// Which spheres of a table a loop over spheres takes: all of them, or those that a packet of coherent rays may meet.
//
// Camera rays of neighbouring pixels, and the shadow rays from what they hit, fill a thin cone; most of a scene's
// spheres are nowhere near it. A cone against sixteen spheres costs about as much as one sphere against sixteen rays.
#pragma once

#include <bit>
#include <limits>
#include <type_traits>

#include "kernels/queues.hpp"
#include "kernels/tables.hpp"
#include "kernels/vec3.hpp"

namespace orrery::kernels {

/// Calls test(k) in table order until it returns true.
struct AllSpheres {
    std::uint32_t count;

    template <class Test>
    ORRERY_INLINE void each(const Test& test) const {
        for (std::uint32_t k = 0; k < count; ++k)
            if (test(k)) return;
    }
};

/// Those whose bit is set.
struct SomeSpheres {
    std::uint64_t bits;
    static constexpr std::uint32_t capacity = 64;

    template <class Test>
    ORRERY_INLINE void each(const Test& test) const {
        for (std::uint64_t rest = bits; rest != 0; rest &= rest - 1)
            if (test(static_cast<std::uint32_t>(std::countr_zero(rest)))) return;
    }
};

/// The first `count` <= SomeSpheres::capacity.
ORRERY_INLINE SomeSpheres every(std::uint32_t count) {
    return {count == 0 ? 0 : ~std::uint64_t{0} >> (SomeSpheres::capacity - count)};
}

/// Neighbours in a queue.
template <class Real>
struct RaySpan {
    const Real* column[6];      ///< of their origins and directions
    const Real* inverse_t_max;  ///< null for rays without an end
    std::uint32_t count;
};
template <class Queue>
ORRERY_INLINE auto span_of(const Queue& queue, std::uint32_t first, std::uint32_t count) {
    using Real = std::remove_pointer_t<decltype(queue.ox)>;
    const Real* inverse_t_max = nullptr;
    if constexpr (requires { queue.inverse_t_max; }) inverse_t_max = queue.inverse_t_max + first;
    return RaySpan<Real>{
        {queue.ox + first, queue.oy + first, queue.oz + first, queue.dx + first, queue.dy + first, queue.dz + first},
        inverse_t_max,
        count};
}

/// Every ray starts within `spread` of `origin` and runs along `axis`, give or take `deviation`, as far as `t_max`.
template <class Real>
struct Packet {
    Vec3<Real> origin, axis;
    Real spread, deviation, t_max;
};

/// Whether the middle and the last of the rays run within some 35 degrees of the first, and begin no further from it
/// than a fifth of its length: where they do not, as after a diffuse bounce, bounding the rest would be in vain, and so
/// it would be for fewer rays than the widest vector.
template <class Real>
ORRERY_INLINE bool may_be_coherent(const RaySpan<Real>& rays) {
    if (rays.count < widest) return false;
    const auto three = [&](int c, std::uint32_t i) ORRERY_INLINE_LAMBDA {
        return Vec3<Real>{rays.column[c][i], rays.column[c + 1][i], rays.column[c + 2][i]};
    };
    const Real inverse = rays.inverse_t_max != nullptr ? *rays.inverse_t_max : Real(0);
    const auto like_first = [&](std::uint32_t i) ORRERY_INLINE_LAMBDA {
        const Vec3<Real> apart = (three(0, i) - three(0, 0)) * inverse;
        return dot(three(3, i), three(3, 0)) > Real(0.8) && dot(apart, apart) < Real(0.04);
    };
    return like_first(rays.count - 1) && like_first(rays.count / 2);
}

/// Whose columns' ranges are `middle` give or take `half`.
template <class Real, int columns>
struct Box {
    Real middle[columns], half[columns];

    /// Half a diagonal of columns c to c + 2.
    ORRERY_INLINE Real radius(int c) const {
        return root(half[c] * half[c] + half[c + 1] * half[c + 1] + half[c + 2] * half[c + 2]);
    }
};

/// Bounds columns of at least V::count numbers each.
template <class V, int columns>
ORRERY_INLINE Box<RealOf<V>, columns> box_of(const RealOf<V>* const (&column)[columns], std::uint32_t count) {
    using Real = typename V::Real;
    using F = Floats<V>;
    F low[columns], high[columns];
    const F infinity(std::numeric_limits<Real>::infinity());
    for (int c = 0; c < columns; ++c) low[c] = infinity, high[c] = F(0) - infinity;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        // The last vector overlaps the one before rather than reach behind the last number.
        const std::uint32_t at = i + V::count <= count ? i : count - V::count;
        for (int c = 0; c < columns; ++c) {
            const F x = load<F>(column[c] + at);
            low[c] = min(x, low[c]);  // in this order: what is no number, and meets nothing, moves no bound
            high[c] = max(x, high[c]);
        }
    }
    Box<Real, columns> box;
    for (int c = 0; c < columns; ++c) {
        const Real from = least(low[c]), to = -least(F(0) - high[c]);
        box.middle[c] = Real(0.5) * (from + to);
        // The middle is rounded: far from the world's origin by more than rays that start close together are apart.
        box.half[c] = mul_add(magnitude(box.middle[c]), Real(0x1p-22), Real(0.5) * (to - from));
    }
    return box;
}

/// Bounds at least V::count rays.
template <class V>
ORRERY_INLINE Packet<RealOf<V>> bound(const RaySpan<RealOf<V>>& rays) {
    using Real = typename V::Real;
    using F = Floats<V>;
    const auto box = box_of<V>(rays.column, rays.count);
    F nearest(rays.inverse_t_max != nullptr ? std::numeric_limits<Real>::infinity() : Real(0));
    if (rays.inverse_t_max != nullptr) {
        for (std::uint32_t i = 0; i < rays.count; i += V::count) {
            const std::uint32_t at = i + V::count <= rays.count ? i : rays.count - V::count;
            nearest = min(load<F>(rays.inverse_t_max + at), nearest);
        }
    }
    return {{box.middle[0], box.middle[1], box.middle[2]},
            {box.middle[3], box.middle[4], box.middle[5]},
            box.radius(0),
            box.radius(3),
            Real(1) / least(nearest)};
}

/// The cone of a packet, ready for a vector of spheres at a time.
///
/// Point t of a ray lies within spread + t deviation of origin + t axis. So a ray can only meet a sphere where, with
/// f = C - origin and R = r + spread, |f - t axis| <= R + t deviation for some t in [0, t_max]. Squared that is a
/// parabola, whose lowest point is easily found; there the distance is computed as `chord` does it, without
/// cancellation. R is enlarged by 2^-18 of itself and of |f|, which is sixteen times what rounding makes of either.
template <class V>
struct Cone {
    using Real = typename V::Real;
    using F = Floats<V>;

    ORRERY_INLINE explicit Cone(const Packet<Real>& packet)
        : origin{F(packet.origin.x), F(packet.origin.y), F(packet.origin.z)},
          axis{F(packet.axis.x), F(packet.axis.y), F(packet.axis.z)},
          spread(packet.spread),
          deviation(packet.deviation),
          t_max(packet.t_max) {
        const Real square = dot(packet.axis, packet.axis) - packet.deviation * packet.deviation;
        narrow = square > Real(0.01);
        inverse_square = F(Real(1) / square);
    }

    /// Errs on the side of yes.
    ORRERY_INLINE Mask<V> may_meet(const Vec3<F>& centre, const F& sphere_radius) const {
        const Vec3<F> f = centre - origin;
        const F f2 = dot(f, f);
        const F enough = sphere_radius + spread;
        const F radius = mul_add(root(f2) + enough, F(Real(0x1p-18)), enough);
        const F slope = mul_add(radius, deviation, dot(f, axis));
        const F t = min(max(slope * inverse_square, F(0)), t_max);
        const Vec3<F> l = back_along(f, t, axis);
        const F reach = mul_add(t, deviation, radius);
        return !(reach * reach < dot(l, l));
    }

    Vec3<F> origin, axis;
    F spread, deviation, t_max, inverse_square;
    bool narrow;  ///< or else it bounds nothing
};

/// The spheres of a table of at most SomeSpheres::capacity that some ray of the packet may meet.
template <class V>
ORRERY_INLINE SomeSpheres candidates(const Spheres<V>& spheres, const Packet<RealOf<V>>& packet) {
    const Cone<V> cone(packet);
    if (!cone.narrow) return every(spheres.count);
    std::uint64_t may = 0;
    for (std::uint32_t k = 0; k < spheres.count; k += V::count) {
        const auto centre = load3<V>(spheres.cx + k, spheres.cy + k, spheres.cz + k);
        may |= std::uint64_t{bits(cone.may_meet(centre, load<Floats<V>>(spheres.radius + k)))} << k;
    }
    return {may & every(spheres.count).bits};
}

/// The same for rays that may run anywhere.
template <class V>
ORRERY_INLINE SomeSpheres candidates(const Spheres<V>& spheres, const RaySpan<RealOf<V>>& rays) {
    return may_be_coherent(rays) ? candidates<V>(spheres, bound<V>(rays)) : every(spheres.count);
}

}  // namespace orrery::kernels
