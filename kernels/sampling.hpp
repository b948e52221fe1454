// Directions from uniform numbers: sphere, cosine lobe, disk, cone. u, v in [0, 1).
#pragma once

#include <numbers>

#include "kernels/vec3.hpp"

namespace orrery::kernels {

template <class F>
struct SinCos {
    F sin, cos;
};

namespace detail {
/// Terms of the series below: on [-pi/4, pi/4] what is left out is less than half an ulp of the result.
template <class Real>
inline constexpr int taylor_terms = sizeof(Real) == 4 ? 5 : 9;

/// (-1)^k / (2 k + first)!, the coefficient of a^2k in sin(a) / a (first 1) and cos(a) (first 0).
template <class Real>
consteval Real taylor_coefficient(int k, int first) {
    double factorial = 1;
    for (int n = 2; n <= 2 * k + first; ++n) factorial *= n;
    return static_cast<Real>(k % 2 == 0 ? 1 : -1) / static_cast<Real>(factorial);
}

/// The series from its term k on, by Horner's rule.
template <class V, int first, int k = 0>
ORRERY_INLINE Floats<V> taylor_series(const Floats<V>& a2) {
    using Real = typename V::Real;
    const Floats<V> coefficient(taylor_coefficient<Real>(k, first));
    if constexpr (k + 1 == taylor_terms<Real>) {
        return coefficient;
    } else {
        return mul_add(a2, taylor_series<V, first, k + 1>(a2), coefficient);
    }
}
}  // namespace detail

/// Sine and cosine of u turns, u in [0, 1), to 2 ulp of 1. Our own series, so that every instruction set rounds alike:
/// the quarter turn nearest is taken off exactly, what is left is at most pi/4 and a short Taylor series does.
template <class V>
ORRERY_INLINE SinCos<Floats<V>> sincos_turns(const Floats<V>& u) {
    using F = Floats<V>;
    using U = Words<V>;
    const F quarters = u * F(4);
    const U quarter = truncate_to_word(quarters + F(0.5f));
    const F a = (quarters - to_number(quarter)) * F(static_cast<RealOf<V>>(std::numbers::pi / 2));
    const F a2 = a * a;
    const F s = a * detail::taylor_series<V, 1>(a2);
    const F c = detail::taylor_series<V, 0>(a2);
    const auto swapped = words_equal(quarter & U(1u), U(1u));
    return {flip_sign(choose(swapped, c, s), quarter << 30), flip_sign(choose(swapped, s, c), (quarter + U(1u)) << 30)};
}

/// Uniform on the unit sphere (Archimedes: z is uniform). 1 - z^2 = 4 u (1 - u) keeps its digits at the poles.
template <class V>
ORRERY_INLINE Vec3Of<V> sample_unit_sphere(const Floats<V>& u, const Floats<V>& v) {
    using F = Floats<V>;
    const F r = F(2) * root(u * (F(1) - u));
    const auto phi = sincos_turns<V>(v);
    return {r * phi.cos, r * phi.sin, neg_mul_add(F(2), u, F(1))};
}

template <class F>
struct DirectionSample {
    Vec3<F> direction;  ///< unit length
    F cosine;           ///< with the axis, >= 0
};

/// Cosine-weighted about the unit normal n, density cosine / pi: n plus a uniform point of the unit sphere lies on a
/// sphere that touches the surface, whose points are cosine distributed as seen from it. Needs no basis; the cosine is
/// half the length before normalising, exact where a dot product would cancel.
template <class V>
ORRERY_INLINE DirectionSample<Floats<V>> sample_cosine(const Vec3Of<V>& n, const Floats<V>& u, const Floats<V>& v) {
    using F = Floats<V>;
    const Vec3<F> sum = n + sample_unit_sphere<V>(u, v);
    // Far below the square of an ulp: only a sum of exactly zero is touched, which no pair of numbers makes likely.
    const F length = root(max(dot(sum, sum), F(sizeof(RealOf<V>) == 4 ? 0x1p-80f : 0x1p-126f)));
    return {sum * (F(1) / length), F(0.5f) * length};
}

/// Uniform on the disk of radius 1.
template <class V>
ORRERY_INLINE SinCos<Floats<V>> sample_disk(const Floats<V>& u, const Floats<V>& v) {
    const auto r = root(u);
    const auto phi = sincos_turns<V>(v);
    return {r * phi.sin, r * phi.cos};
}

template <class F>
struct Basis {
    Vec3<F> s, t;  ///< with n: orthonormal
};

/// Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 6(1), 2017); Frisvad's breaks near z = -1.
template <class F>
ORRERY_INLINE Basis<F> basis_around(const Vec3<F>& n) {
    const F sign = choose(n.z < F(0), F(-1), F(1));
    const F a = F(-1) / (sign + n.z);
    const F b = n.x * n.y * a;
    return {{mul_add(sign * n.x, n.x * a, F(1)), sign * b, F(0) - sign * n.x},
            {b, mul_add(n.y, n.y * a, sign), F(0) - n.y}};
}

/// axis * along + (s cos phi + t sin phi) * across.
template <class F>
ORRERY_INLINE Vec3<F> in_frame(const Vec3<F>& axis, const F& along_axis, const F& across, const SinCos<F>& phi) {
    const Basis<F> e = basis_around(axis);
    return along(along(axis * along_axis, across * phi.cos, e.s), across * phi.sin, e.t);
}

/// 1 - cos of the half angle a sphere subtends, from s^2 = r^2/d^2 and the cosine itself: no cancellation for the
/// smallest lights.
template <class F>
ORRERY_INLINE F one_minus_cosine(const F& sin2, const F& cosine) {
    return sin2 / (F(1) + cosine);
}

}  // namespace orrery::kernels
