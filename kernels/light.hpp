// Sampling a light from a vertex, and the density of that sampling: a point, and a sphere by one pair per strategy.
#pragma once

#include <limits>

#include "kernels/sampling.hpp"
#include "kernels/sphere.hpp"

namespace orrery::kernels {

template <class V>
struct LightSample {
    Vec3Of<V> direction;         ///< unit length
    Floats<V> inverse_distance;  ///< 1 / distance to the sampled point of the light
    Floats<V> inverse_pdf;       ///< 1 / density per solid angle, > 0 where valid
    Mask<V> valid;
};

/// sample = other in the lanes of `where`.
template <class V>
ORRERY_INLINE void replace(LightSample<V>& sample, const Mask<V>& where, const LightSample<V>& other) {
    sample.direction = choose(where, other.direction, sample.direction);
    sample.inverse_distance = choose(where, other.inverse_distance, sample.inverse_distance);
    sample.inverse_pdf = choose(where, other.inverse_pdf, sample.inverse_pdf);
    sample.valid = (where && other.valid) || (!where && sample.valid);
}

/// The one direction there is. The inverse square of the distance takes the place of 1 / density.
template <class V>
ORRERY_INLINE LightSample<V> sample_point(const Vec3Of<V>& p, const Vec3Of<V>& light) {
    using F = Floats<V>;
    const Vec3<F> to = light - p;
    const F distance2 = dot(to, to);
    const F inverse_distance = F(1) / root(distance2);
    return {to * inverse_distance, inverse_distance, inverse_distance * inverse_distance, distance2 > F(0)};
}

/// Uniform over the surface, p = 1/A. From outside only the half facing `p` is seen, from inside all of it.
template <class V>
ORRERY_INLINE LightSample<V> sample_light_area(const Vec3Of<V>& p, const Sphere<Floats<V>>& light,
                                               const Mask<V>& inside, const Floats<V>& u, const Floats<V>& v) {
    using F = Floats<V>;
    const Vec3<F> n = sample_unit_sphere<V>(u, v);
    const Vec3<F> to = along(light.centre, light.radius, n) - p;
    const F inverse_distance = F(1) / root(dot(to, to));
    const Vec3<F> direction = to * inverse_distance;
    const F cosine = dot(n, direction);
    const F facing = choose(inside, cosine, F(0) - cosine);
    const F area = F(static_cast<RealOf<V>>(4 * std::numbers::pi)) * light.radius * light.radius;
    return {direction, inverse_distance, area * facing * inverse_distance * inverse_distance, facing > F(0)};
}

/// The cone a light subtends from outside.
template <class F>
struct LightCone {
    F distance2;         ///< to the centre, squared
    F inverse_distance;  ///< 1 / distance to the centre
    F one_minus_cosine;  ///< of the half angle
};
/// `f` = p - centre, `c` its power > 0.
template <class F>
ORRERY_INLINE LightCone<F> light_cone(const Vec3<F>& f, const F& c, const F& radius) {
    const F distance2 = dot(f, f);
    const F inverse = F(1) / root(distance2);
    const F sine = radius * inverse;
    // sqrt(1 - r^2/d^2) = sqrt(c)/d: exact digits however close the light.
    return {distance2, inverse, one_minus_cosine(sine * sine, root(max(c, F(0))) * inverse)};
}

/// Uniform over the subtended solid angle, p = 1 / (2 pi (1 - cos)). From outside only.
template <class V>
ORRERY_INLINE LightSample<V> sample_light_cone(const Vec3Of<V>& p, const Sphere<Floats<V>>& light, const Floats<V>& u,
                                               const Floats<V>& v) {
    using F = Floats<V>;
    const Vec3<F> f = p - light.centre;
    const F c = power_of_point(f, light.radius2);
    const auto cone = light_cone(f, c, light.radius);
    const Vec3<F> axis = f * (F(0) - cone.inverse_distance);
    const F x = u * cone.one_minus_cosine;  // 1 - cos of the sampled angle
    const F cosine = F(1) - x;
    const F sin2 = x * (F(2) - x);
    const Vec3<F> direction = in_frame(axis, cosine, root(sin2), sincos_turns<V>(v));
    const F s = root(max(neg_mul_add(cone.distance2, sin2, light.radius * light.radius), F(0)));
    const F d = cone.distance2 * cone.inverse_distance;
    return {direction, mul_add(d, cosine, s) / c,
            F(static_cast<RealOf<V>>(2 * std::numbers::pi)) * cone.one_minus_cosine, c > F(0)};
}

/// Density with which a direction that meets the light after t is sampled from `origin`: what multiple importance
/// sampling compares: infinite where light samples alone count. `inside`: the origin lies within the light.
template <class V>
ORRERY_INLINE Floats<V> light_pdf(LightStrategy strategy, const Vec3Of<V>& origin, const Vec3Of<V>& direction,
                                  const Floats<V>& t, const Sphere<Floats<V>>& light, const Mask<V>& inside) {
    using F = Floats<V>;
    using Real = typename V::Real;
    const auto line = chord(origin, direction, light);
    const F cosine = root(max(line.disc, F(0)));  // times the radius
    const F area_pdf = t * t / (F(static_cast<Real>(4 * std::numbers::pi)) * light.radius * cosine);
    if (strategy == LightStrategy::area) return area_pdf;
    if (strategy == LightStrategy::exact) return choose(inside, area_pdf, F(std::numeric_limits<Real>::infinity()));
    const auto cone = light_cone(origin - light.centre, line.c, light.radius);
    const F cone_pdf = F(1) / (F(static_cast<Real>(2 * std::numbers::pi)) * cone.one_minus_cosine);
    return choose(inside, area_pdf, cone_pdf);
}

}  // namespace orrery::kernels
