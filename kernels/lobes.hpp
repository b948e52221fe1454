// Directions in which surfaces send light on: mirrored, refracted with the share that each gets, and spread about
// either.
#pragma once

#include "kernels/sampling.hpp"

namespace orrery::kernels {

// --- mirror and interface: unpolarised Fresnel reflectance, exact, and the refracted direction -------------------

template <class V>
struct Interface {
    Floats<V> reflectance;  ///< F in [0, 1]; 1 where reflection is total
    Floats<V> cosine_t;     ///< of the transmitted ray with the normal, >= 0; 0 where reflection is total
    Floats<V> inverse_eta;  ///< incident index over transmitted index
};

/// `cosine` in [0, 1] with the normal on the incident side; `eta` transmitted index over incident index, > 0.
/// Source: Fresnel's equations in the amplitude form r_s, r_p (Born and Wolf, section 1.5.2).
template <class V>
ORRERY_INLINE Interface<V> interface_at(const Floats<V>& cosine, const Floats<V>& eta) {
    using F = Floats<V>;
    const F inverse_eta = F(1) / eta;
    // 1 - sin^2/eta^2 = ((eta^2 - 1) + cos^2)/eta^2: the sum keeps its digits for eta near 1; for the smallest eta,
    // whose light arrives next to the normal, eta^2 - sin^2 does.
    const F discriminant = choose(eta < F(0.25f), mul_sub(eta, eta, (F(1) - cosine) * (F(1) + cosine)),
                                  mul_add(cosine, cosine, (eta - F(1)) * (eta + F(1))));
    const auto total = discriminant <= F(0);
    const F cosine_t = root(max(discriminant, F(0))) * inverse_eta;
    const F rs = (cosine - eta * cosine_t) / (cosine + eta * cosine_t);
    const F rp = (eta * cosine - cosine_t) / (eta * cosine + cosine_t);
    return {choose(total, F(1), F(0.5f) * mul_add(rs, rs, rp * rp)), cosine_t, inverse_eta};
}

/// d - 2 (d.n) n for an arriving d, with cosine = -d.n.
template <class F>
ORRERY_INLINE Vec3<F> reflected(const Vec3<F>& d, const Vec3<F>& n, const F& cosine) {
    return along(d, cosine + cosine, n);
}

/// Snell's law for an arriving d with cosine = -d.n.
template <class V>
ORRERY_INLINE Vec3Of<V> refracted(const Vec3Of<V>& d, const Vec3Of<V>& n, const Floats<V>& cosine,
                                  const Interface<V>& at) {
    return unit(along(d * at.inverse_eta, mul_add(at.inverse_eta, cosine, Floats<V>(0) - at.cosine_t), n));
}

// --- the glossy lobe: unit(R + beta S), S uniform on the unit sphere, conditioned on the reflecting
// side.

/// Probability that R + beta S falls on the side of n, (1 + min(1, R.n / beta)) / 2.
template <class F>
ORRERY_INLINE F glossy_side_probability(const F& lobe_dot_n, const F& beta) {
    return mul_add(F(0.5f), min(lobe_dot_n / beta, F(1)), F(0.5f));
}

template <class F>
struct GlossySample {
    Vec3<F> direction;  ///< unit length, on the side of n
    F pdf;              ///< per solid angle, conditioned; +inf on the lobe's singular edge
};

/// `lobe` unit length with lobe.n = lobe_dot_n >= 0, 0 < beta < 1.
///
/// The component of S along n is uniform on [-min(1, R.n/beta), 1], the azimuth uniform. With mu = R.S the perturbed
/// vector has the length sqrt(1 + 2 beta mu + beta^2), so sin^2 theta = beta^2 (1 - mu^2) / length^2 and
/// sqrt(beta^2 - sin^2 theta) = beta |mu + beta| / length: the density of the sampled direction follows from mu without
/// the cancellation that evaluating it from the direction has near the singular edge mu = -beta.
template <class V>
ORRERY_INLINE GlossySample<Floats<V>> sample_glossy(const Vec3Of<V>& lobe, const Vec3Of<V>& n,
                                                    const Floats<V>& lobe_dot_n, const Floats<V>& beta,
                                                    const Floats<V>& u, const Floats<V>& v) {
    using F = Floats<V>;
    const F lowest = min(lobe_dot_n / beta, F(1));
    const F h = mul_add(u, F(1) + lowest, F(0) - lowest);
    const F across = root(max(neg_mul_add(h, h, F(1)), F(0)));
    const Vec3<F> s = in_frame(n, h, across, sincos_turns<V>(v));
    const Vec3<F> sum = along(lobe, beta, s);
    const F mu = dot(lobe, s);
    const F length2 = dot(sum, sum);
    const F inverse_length = F(1) / root(length2);
    const F sin2 = beta * beta * neg_mul_add(mu, mu, F(1)) * (inverse_length * inverse_length);
    // At least 1 - beta^2: what rounding makes of it for roughnesses close to 1 shall not be negative.
    const F numerator = max(neg_mul_add(F(2), sin2, mul_add(beta, beta, F(1))), F(0));
    const F denominator =
        F(static_cast<RealOf<V>>(2 * std::numbers::pi)) * beta * beta * magnitude(mu + beta) * inverse_length;
    return {sum * inverse_length, numerator / (denominator * glossy_side_probability(lobe_dot_n, beta))};
}

/// Density of `direction` (unit length), conditioned on the side of n; 0 on the other side and outside the lobe.
template <class V>
ORRERY_INLINE Floats<V> glossy_pdf(const Vec3Of<V>& lobe, const Floats<V>& lobe_dot_n, const Floats<V>& beta,
                                   const Vec3Of<V>& direction, const Floats<V>& direction_dot_n) {
    using F = Floats<V>;
    const Vec3<F> across = cross(lobe, direction);
    const F sin2 = dot(across, across);
    const F beta2 = beta * beta;
    const auto within = beta2 > sin2 && dot(lobe, direction) > F(0) && direction_dot_n > F(0);
    const F numerator = neg_mul_add(F(2), sin2, F(1) + beta2);
    const F denominator = F(static_cast<RealOf<V>>(2 * std::numbers::pi)) * beta * root(max(beta2 - sin2, F(0)));
    return choose(within, numerator / (denominator * glossy_side_probability(lobe_dot_n, beta)), F(0));
}

}  // namespace orrery::kernels
