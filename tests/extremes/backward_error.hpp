// How wrong an answer about a ray and a sphere is: by how much the sphere would have to grow or shrink for it to be
// right.
//
// The unit is u (f + r): f the distance from origin to centre, r the radius, u the unit of rounding, 2^-24 or 2^-53. So
// much does rounding C - O and r to the number format move the surface, before anything is computed with them. An
// answer wrong by k units is the exact one for a sphere that differs by k such roundings; coordinates far from the
// origin get no discount for their own rounding.
//
// gap(t) = |O + t D - C| - r, the signed distance from the surface, is convex in t, so that over a part of the ray it
// is least at the point closest to the centre, or at an end, and greatest at an end. Nothing here solves a quadratic.
#pragma once

#include <algorithm>

#include "casting.hpp"
#include "wide.hpp"

namespace orrery::extremes {

template <class Real>
struct Ball {
    kernels::Vec3<Real> centre;
    Real radius;
};

/// As long as a direction can be: rounded once.
template <class Real, class W = Wide>
kernels::Vec3<Real> unit_length(const Double3& v) {
    const Triple<W> exact = unit(widen<W>(v));
    return {static_cast<Real>(exact.x), static_cast<Real>(exact.y), static_cast<Real>(exact.z)};
}

/// W: the oracle's numbers.
template <class W>
class GapOf {
public:
    template <class Real>
    GapOf(const Ray<Real>& ray, const Ball<Real>& ball)
        : f_(widen<W>(ball.centre) - widen<W>(ray.origin)),
          d_(widen<W>(ray.direction)),
          radius_(static_cast<W>(ball.radius)),
          closest_(dot(f_, d_) / dot(d_, d_)),
          unit_(static_cast<W>(rounding_unit<Real>) * (length(f_) + radius_)) {}

    W at(W t) const { return finite(t) ? length(t * d_ - f_) - radius_ : t; }
    W least(W from, W to) const { return at(std::clamp(closest_, from, std::max(from, to))); }
    W greatest(W from, W to) const { return std::max(at(from), at(to)); }

    /// "From `from` to `to` the ray crosses no surface": it stays outside or it stays inside.
    W of_miss(W from, W to) const {
        const W outside = std::max(W(0), -least(from, to)), inside = std::max(W(0), greatest(from, to));
        return std::min(outside, inside) / unit_;
    }
    /// "It crosses one."
    W of_crossing(W from, W to) const {
        const W low = least(from, to), high = greatest(from, to);
        return std::max(W(0), std::max(low, -high)) / unit_;
    }
    /// "It first crosses the surface at t, from within or from outside."
    W of_hit(W from, W t, bool inside) const {
        const W side = inside ? greatest(from, t) : -least(from, t);
        return std::max(magnitude(at(t)), std::max(side, from - t)) / unit_;
    }

    W unit() const { return unit_; }

private:
    Triple<W> f_, d_;
    W radius_, closest_, unit_;
};
using Gap = GapOf<Wide>;

/// Of whether something is met at all.
template <class Real, class W>
double error_of_verdict(const GapOf<W>& gap, const Ray<Real>& ray, bool met) {
    const auto from = static_cast<W>(ray.t_min), to = static_cast<W>(ray.t_max);
    return static_cast<double>(met ? gap.of_crossing(from, to) : gap.of_miss(from, to));
}

/// Of a hit: its distance, its side, and that nothing of the sphere comes before it.
template <class Real, class W>
double error_of_hit(const GapOf<W>& gap, const Ray<Real>& ray, const Hit<Real>& hit) {
    const auto t = static_cast<W>(hit.t);
    if (!finite(t) || t > static_cast<W>(ray.t_max)) return std::numeric_limits<double>::infinity();
    return static_cast<double>(gap.of_hit(static_cast<W>(ray.t_min), t, hit.inside()));
}

}  // namespace orrery::extremes
