// How much of a spherical light a diffuse vertex sees, in closed form: the irradiance from the visible part of a cap of
// directions over pi times its radiance.
//
// The irradiance of a region of constant radiance is an integral along its boundary (Lambert 1760; Arvo, "Analytic
// Methods for Simulated Light Transport", 1995). For what cap B leaves of cap A, each a half angle s about an axis
// whose cosine with the normal is n, the boundary is an arc of either circle, and with symmetry about the plane of the
// axes all terms with one axis join to
//
//     sin^2 sA nA (1 - S(phiA)) - sin^2 sB nB S(phiB),   S(phi) = (phi - sin phi cos phi) / pi,
//
// phiA half the arc of circle A within B and phiB half that of B within A: the two segments that the chord through the
// circles' crossings cuts off the caps' disks. All of A must lie above the horizon, or B be what is below it.
#pragma once

#include "kernels/arcs.hpp"
#include "kernels/vec3.hpp"

namespace orrery::kernels {

/// Directions about an axis.
template <class F>
struct Cap {
    F sine, cosine;  ///< of the half angle, at most a right angle
    F facing;        ///< cosine of axis and normal
};

/// All of it, above the horizon.
template <class F>
ORRERY_INLINE F form_factor(const Cap<F>& cap) {
    return cap.sine * cap.sine * cap.facing;
}

/// Cosine of half the arc of circle `a` that lies within `b`; beyond [-1, 1] where they do not cross. `sine` > 0 and
/// `cosine` are those of the angle between the axes.
template <class V>
ORRERY_INLINE Floats<V> crossing_cosine(const Cap<Floats<V>>& a, const Cap<Floats<V>>& b, const Floats<V>& sine,
                                        const Floats<V>& cosine) {
    using F = Floats<V>;
    // (cos b - cos a cosine) / (sin a sine). Where the numerator may cancel, as for all that is small, both are
    // multiplied by the sum that belongs to the difference.
    const F projected = a.sine * cosine;
    const F sum = mul_add(a.cosine, cosine, b.cosine);
    const auto ahead = min(cosine, min(a.cosine, b.cosine)) > F(0);
    const F numerator = choose(ahead, mul_add(projected, projected, (sine - b.sine) * (sine + b.sine)),
                               neg_mul_add(a.cosine, cosine, b.cosine));
    const F denominator = choose(ahead, sum * a.sine * sine, a.sine * sine);
    return min(max(numerator / denominator, F(-1)), F(1));
}

/// What `b` leaves of `a`.
template <class V>
ORRERY_INLINE Floats<V> form_factor_outside(const Cap<Floats<V>>& a, const Cap<Floats<V>>& b, const Floats<V>& sine,
                                            const Floats<V>& cosine) {
    using F = Floats<V>;
    const F one(1);
    const auto a_smaller = a.sine < b.sine;
    const Cap<F> small{choose(a_smaller, a.sine, b.sine), choose(a_smaller, a.cosine, b.cosine), one};
    const Cap<F> large{choose(a_smaller, b.sine, a.sine), choose(a_smaller, b.cosine, a.cosine), one};
    const F of_small = crossing_cosine<V>(small, large, sine, cosine);
    // The larger circle's from that, so that they err together: where the circles nearly coincide, neither is well
    // known and what is between them is. Its sine is that of the common chord, as the cosine of a short arc does not
    // know how long it is.
    const F chord = small.sine * root((one - of_small) * (one + of_small));
    const F of_large = mul_sub(small.cosine, sine, small.sine * cosine * of_small) / large.sine;
    const F part_small = segment<V>(chord / small.sine, of_small);
    const F part_large = segment<V>(min(chord / large.sine, one), min(max(of_large, F(-1)), one));
    const F part_a = choose(a_smaller, part_small, part_large), part_b = choose(a_smaller, part_large, part_small);
    const F share(static_cast<RealOf<V>>(std::numbers::inv_pi));
    const F left = form_factor(a) * neg_mul_add(part_a, share, one) - form_factor(b) * (part_b * share);
    return max(left, F(0));
}

}  // namespace orrery::kernels
