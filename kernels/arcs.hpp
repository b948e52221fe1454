// Angles of arcs, and the segments that their chords cut off the unit disk, from sine and cosine.
#pragma once

#include <array>
#include <numbers>

#include "kernels/lanes/twin.hpp"

namespace orrery::kernels {

namespace detail {
/// What is left out is less than half an ulp of the series below.
template <class Real>
inline constexpr int segment_terms = sizeof(Real) == 4 ? 9 : 20;

/// Coefficients of a polynomial in z = 2 x^2, 0 <= z <= 1, for (asin x - x sqrt(1 - x^2)) / x^3. The power series has
/// 2 C(2k, k) / (4^k (2k + 3)) before x^2k; its terms are economised (Lanczos, "Trigonometric Interpolation of
/// Empirical and Analytical Functions", 1938): from the last down each is replaced by lower ones, so that the
/// difference is a multiple of a Chebyshev polynomial on [0, 1], which is small everywhere there.
consteval std::array<double, 64> segment_coefficients(int terms) {
    constexpr int all = 64;
    std::array<double, all> series{};
    double central = 1;  // C(2k, k) / 8^k
    for (int k = 0; k < all; ++k) {
        series[static_cast<std::size_t>(k)] = 2 * central / (2 * k + 3);
        central *= (2.0 * k + 1) / (4.0 * k + 4);
    }
    std::array<std::array<double, all>, all> chebyshev{};  // by degree; T(n + 1) = (4 z - 2) T(n) - T(n - 1)
    chebyshev[0][0] = 1, chebyshev[1][0] = -1, chebyshev[1][1] = 2;
    for (std::size_t n = 1; n + 1 < all; ++n)
        for (std::size_t k = 0; k <= n + 1; ++k)
            chebyshev[n + 1][k] = 4 * (k > 0 ? chebyshev[n][k - 1] : 0) - 2 * chebyshev[n][k] - chebyshev[n - 1][k];
    for (auto n = static_cast<std::size_t>(all - 1); n >= static_cast<std::size_t>(terms); --n) {
        const double multiple = series[n] / chebyshev[n][n];
        for (std::size_t k = 0; k <= n; ++k) series[k] -= multiple * chebyshev[n][k];
    }
    return series;
}
template <class Real>
inline constexpr auto segment_series = segment_coefficients(segment_terms<Real>);

/// The series from its term k on, by Horner's rule.
template <class V, int k = 0>
ORRERY_INLINE Floats<V> segment_tail(const Floats<V>& z) {
    using Real = RealOf<V>;
    const Floats<V> coefficient(static_cast<Real>(segment_series<Real>[k]));
    if constexpr (k + 1 == segment_terms<Real>) {
        return coefficient;
    } else {
        return mul_add(z, segment_tail<V, k + 1>(z), coefficient);
    }
}
}  // namespace detail

/// a - sin a cos a of an angle a in [0, pi]: twice the area that the chord of the arc from -a to a cuts off the unit
/// disk, pi for all of it. To 5 ulp of itself where a <= pi/4, else to 5 ulp of pi.
template <class V>
ORRERY_INLINE Floats<V> segment(const Floats<V>& sine, const Floats<V>& cosine) {
    using F = Floats<V>;
    using Real = RealOf<V>;
    // With asin x = x sqrt(1 - x^2) + t(x): a - sin a cos a is t(sin a), pi/2 - t(cos a) - 2 sin a cos a, or
    // pi - t(sin a), the first and the last where the sine is the smaller one; of a sine of 0 the sign of the cosine is
    // enough.
    const auto steep = magnitude(cosine) < sine;
    const F x = choose(steep, cosine, sine);
    const F x2 = x * x;
    const F t = x * x2 * detail::segment_tail<V>(x2 + x2);
    const F base = choose(steep, F(static_cast<Real>(std::numbers::pi / 2)) - F(2) * sine * cosine,
                          choose(cosine < F(0), F(static_cast<Real>(std::numbers::pi)), F(0)));
    return choose(steep || cosine < F(0), base - t, t);
}

/// The angle in [0, pi] itself, to 3 ulp of itself up to pi/4 and of pi beyond.
template <class V>
ORRERY_INLINE Floats<V> angle(const Floats<V>& sine, const Floats<V>& cosine) {
    return mul_add(sine, cosine, segment<V>(sine, cosine));
}

}  // namespace orrery::kernels
