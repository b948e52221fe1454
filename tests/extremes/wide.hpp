// The oracle's numbers: IEEE quadruple precision, 113 bits, next to which the rounding of floats and doubles is exact
// input. Wider in range than either, so that nothing the tests square overflows. Where millions of rays are judged a
// format next to theirs does: double for float, whose rounding is 2^-29 of a float's, long double for double.
#pragma once

#include <cmath>

#include "kernels/vec3.hpp"

namespace orrery::extremes {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Wide;
#else
using Wide = long double;  // quadruple where the type above is missing (AArch64)
#endif

template <class W>
struct Triple {
    W x, y, z;
};
using Wide3 = Triple<Wide>;

template <class W = Wide, class Real>
Triple<W> widen(const kernels::Vec3<Real>& v) {
    return {static_cast<W>(v.x), static_cast<W>(v.y), static_cast<W>(v.z)};
}

template <class W>
Triple<W> operator+(const Triple<W>& a, const Triple<W>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class W>
Triple<W> operator-(const Triple<W>& a, const Triple<W>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class W>
Triple<W> operator*(W s, const Triple<W>& v) {
    return {s * v.x, s * v.y, s * v.z};
}
template <class W>
W dot(const Triple<W>& a, const Triple<W>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class W>
W magnitude(W x) {
    return x < 0 ? -x : x;
}
template <class W>
bool finite(W x) {
    return x - x == 0;
}

inline double root(double x) { return std::sqrt(x); }
inline long double root(long double x) { return std::sqrt(x); }
#if defined(__SIZEOF_FLOAT128__)
/// One step of Newton's from 64 bits gives the rest.
inline Wide root(Wide x) {
    if (!(x > 0) || !finite(x)) return x;
    const Wide s = root(static_cast<long double>(x));
    return (s + x / s) / 2;
}
#endif
template <class W>
W length(const Triple<W>& v) {
    return root(dot(v, v));
}
template <class W>
Triple<W> unit(const Triple<W>& v) {
    return (1 / length(v)) * v;
}

}  // namespace orrery::extremes
