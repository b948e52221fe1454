// Unpolarised Fresnel reflectance of a dielectric, exact, and the refracted direction.
#pragma once

#include "kernels/vec3.hpp"

namespace orrery::kernels {

template <class V>
struct Interface {
    typename V::F reflectance;  ///< F in [0, 1]; 1 where reflection is total
    typename V::F cosine_t;     ///< of the transmitted ray with the normal, >= 0; 0 where reflection is total
    typename V::F inverse_eta;  ///< incident index over transmitted index
};

/// `cosine` in [0, 1] with the normal on the incident side; `eta` transmitted index over incident index, > 0.
/// Source: Fresnel's equations in the amplitude form r_s, r_p (Born and Wolf, section 1.5.2).
template <class V>
ORRERY_INLINE Interface<V> interface_at(const typename V::F& cosine, const typename V::F& eta) {
    using F = typename V::F;
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
ORRERY_INLINE Vec3<typename V::F> refracted(const Vec3<typename V::F>& d, const Vec3<typename V::F>& n,
                                            const typename V::F& cosine, const Interface<V>& at) {
    return unit(along(d * at.inverse_eta, mul_add(at.inverse_eta, cosine, typename V::F(0) - at.cosine_t), n));
}

}  // namespace orrery::kernels
