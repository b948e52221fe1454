// Sampling a spherical light from a rough vertex by the product: the directions of the vertex's own lobe that lie
// within the cap the light subtends.
//
// The lobe is unit(R + beta S), S uniform on the unit sphere (lobes.hpp). With z = R.S and the angle g from R,
// tan g = beta sqrt(1 - z^2) / (1 + beta z): each g < asin beta comes from a far and a near z,
//
//     beta z = -sin^2 g +- q cos g,   q = sqrt(beta^2 - sin^2 g).
//
// The light, of half angle s about an axis at the angle c from R, takes up angles from |c - s| or 0 to c + s: two
// intervals of z, which join where the lobe ends first. z is uniform on them, and the azimuth uniform as far as the
// light reaches at that angle, so that the share of the lobe within the light is half the length of the intervals times
// the mean share of the azimuth.
#pragma once

#include "kernels/arcs.hpp"
#include "kernels/light.hpp"
#include "kernels/lobes.hpp"

namespace orrery::kernels {

/// Of angles about the lobe that the light takes up.
template <class F>
struct LobeBounds {
    F far_end;    ///< beta z of the far one, at the largest angle
    F near_end;   ///< of the near one, at the smallest
    F far, near;  ///< lengths of the intervals of beta z, upwards of both; 0 where lobe and light do not meet
};

/// `sine`, `cosine`: of the angle between lobe and light; the light's half angle is below a right angle.
template <class V>
ORRERY_INLINE LobeBounds<Floats<V>> lobe_bounds(const Floats<V>& beta, const Floats<V>& sine, const Floats<V>& cosine,
                                                const Floats<V>& light_sine, const Floats<V>& light_cosine) {
    using F = Floats<V>;
    const F zero(0), one(1), beta2 = beta * beta;
    const F low_sine = mul_sub(sine, light_cosine, cosine * light_sine);
    const F low_cosine = mul_add(cosine, light_cosine, sine * light_sine);
    const F high_sine = mul_add(sine, light_cosine, cosine * light_sine);
    const F high_cosine = mul_sub(cosine, light_cosine, sine * light_sine);
    const auto from_axis = low_sine <= zero && low_cosine > zero;
    const F low2 = choose(from_axis, zero, low_sine * low_sine);
    const auto to_edge = high_cosine <= zero || high_sine * high_sine >= beta2;
    const F high2 = choose(to_edge, beta2, high_sine * high_sine);
    const auto meets = (from_axis || low_cosine > zero) && low2 < high2;
    // sin^2 of the sum less sin^2 of the difference of two angles is the product of the sines of their doubles.
    const F between = choose(from_axis || to_edge, high2 - low2, F(4) * sine * cosine * light_sine * light_cosine);
    const auto q_cosine = [&](const F& sine2)
                              ORRERY_INLINE_LAMBDA { return root(max(beta2 - sine2, zero) * (one - sine2)); };
    const F low_q = q_cosine(low2), high_q = choose(to_edge, zero, q_cosine(high2));
    // What q cos loses from one end to the other, as a difference of squares.
    const F fall = between * (one + beta2 - low2 - high2) / (low_q + high_q);
    return {high_q - high2, zero - low_q - low2, choose(meets, fall + between, zero),
            choose(meets, max(fall - between, zero), zero)};
}

/// From outside the light only; `factor` is what takes the place of scattering density over light density.
template <class V>
struct LobeSample {
    LightSample<V> sample;
    Floats<V> factor;
};

/// `lobe` and `normal` unit length, lobe_dot_n >= 0, 0 < beta < 1.
template <class V>
ORRERY_INLINE LobeSample<V> sample_lobe_in_cap(const Vec3Of<V>& p, const Sphere<Floats<V>>& light,
                                               const Vec3Of<V>& lobe, const Vec3Of<V>& normal,
                                               const Floats<V>& lobe_dot_n, const Floats<V>& beta, const Floats<V>& u,
                                               const Floats<V>& v) {
    using F = Floats<V>;
    const F zero(0), one(1);
    const Vec3<F> to = light.centre - p;
    const F power = power_of_point(to, light.radius2), distance2 = dot(to, to);
    const F inverse = one / root(distance2);
    const F light_sine = light.radius * inverse, light_cosine = root(max(power, zero)) * inverse;
    const Vec3<F> axis = to * inverse;
    const F cosine = dot(lobe, axis);
    const Vec3<F> aside = back_along(axis, cosine, lobe);
    const F sine = root(dot(aside, aside));

    const auto bounds = lobe_bounds<V>(beta, sine, cosine, light_sine, light_cosine);
    const F length = bounds.far + bounds.near;
    const F at = u * length;
    const F beta_z = choose(at < bounds.far, bounds.far_end + at, bounds.near_end + (at - bounds.far));
    const F along_lobe = one + beta_z, across = root(max(mul_sub(beta, beta, beta_z * beta_z), zero));
    const F scale = one / root(mul_add(across, across, along_lobe * along_lobe));
    const F g_sine = across * scale, g_cosine = along_lobe * scale;

    // The light reaches where cos s <= cos g cos c + sin g sin c cos phi: 1 - cos phi without cancellation, from
    // cos(g - c) - cos s.
    const F off_sine = mul_sub(g_sine, cosine, g_cosine * sine), off_cosine = mul_add(g_sine, sine, g_cosine * cosine);
    const F versine = min(
        max((light_sine - off_sine) * (light_sine + off_sine) / ((off_cosine + light_cosine) * g_sine * sine), zero),
        F(2));
    const F reach =
        angle<V>(root(versine * (F(2) - versine)), one - versine) * F(static_cast<RealOf<V>>(std::numbers::inv_pi));
    const F turns = reach * (v - F(0.5f));
    const auto phi = sincos_turns<V>(choose(turns < zero, turns + one, turns));
    const Vec3<F> e = choose(sine > zero, aside * (one / sine), basis_around(lobe).s);
    const Vec3<F> direction = along(along(lobe * g_cosine, g_sine * phi.cos, e), g_sine * phi.sin, cross(lobe, e));

    const F b = dot(to, direction);
    const Vec3<F> l = back_along(to, b, direction);
    const F half_chord = root(max(light.radius2 - dot(l, l), zero));
    const F factor = F(0.5f) * length / beta * reach / glossy_side_probability(lobe_dot_n, beta);
    const auto up = dot(direction, normal) > zero;
    return {{direction, (b + half_chord) / power, one, power > zero && up}, factor};
}

}  // namespace orrery::kernels
