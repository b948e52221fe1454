// The oracle's numbers: IEEE quadruple precision, 113 bits, next to which the rounding of floats and doubles is exact
// input. Wider in range than either, so that nothing the tests square overflows.
#pragma once

#include <cmath>

#include "kernels/vec3.hpp"

namespace orrery::extremes {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Wide;
#else
using Wide = long double;  // quadruple where the type above is missing (AArch64)
#endif

struct Wide3 {
    Wide x, y, z;
};

template <class Real>
Wide3 widen(const kernels::Vec3<Real>& v) {
    return {static_cast<Wide>(v.x), static_cast<Wide>(v.y), static_cast<Wide>(v.z)};
}

inline Wide3 operator+(const Wide3& a, const Wide3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Wide3 operator-(const Wide3& a, const Wide3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Wide3 operator*(Wide s, const Wide3& v) { return {s * v.x, s * v.y, s * v.z}; }
inline Wide dot(const Wide3& a, const Wide3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Wide3 cross(const Wide3& a, const Wide3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Wide magnitude(Wide x) { return x < 0 ? -x : x; }
inline bool finite(Wide x) { return x - x == 0; }

/// One step of Newton's from 64 bits gives the rest.
inline Wide root(Wide x) {
    if (!(x > 0) || !finite(x)) return x;
    const Wide s = std::sqrt(static_cast<long double>(x));
    return (s + x / s) / 2;
}
inline Wide length(const Wide3& v) { return root(dot(v, v)); }
inline Wide3 unit(const Wide3& v) { return (1 / length(v)) * v; }

}  // namespace orrery::extremes
