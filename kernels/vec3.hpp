// Three numbers that belong together; x, y, z may be scalars or vectors of lanes.
#pragma once

#include "kernels/lanes/numbers.hpp"

namespace orrery::kernels {

template <class F>
struct Vec3 {
    F x, y, z;
};

template <class V>
using Vec3Of = Vec3<typename V::F>;

template <class F>
ORRERY_INLINE Vec3<F> operator+(const Vec3<F>& a, const Vec3<F>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class F>
ORRERY_INLINE Vec3<F> operator-(const Vec3<F>& a, const Vec3<F>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class F>
ORRERY_INLINE Vec3<F> operator*(const Vec3<F>& a, const F& s) {
    return {a.x * s, a.y * s, a.z * s};
}
/// Component by component: throughput times colour.
template <class F>
ORRERY_INLINE Vec3<F> operator*(const Vec3<F>& a, const Vec3<F>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
/// a + s d, one rounding per component.
template <class F>
ORRERY_INLINE Vec3<F> along(const Vec3<F>& a, const F& s, const Vec3<F>& d) {
    return {mul_add(s, d.x, a.x), mul_add(s, d.y, a.y), mul_add(s, d.z, a.z)};
}
/// a - s d, one rounding per component.
template <class F>
ORRERY_INLINE Vec3<F> back_along(const Vec3<F>& a, const F& s, const Vec3<F>& d) {
    return {neg_mul_add(s, d.x, a.x), neg_mul_add(s, d.y, a.y), neg_mul_add(s, d.z, a.z)};
}
template <class F>
ORRERY_INLINE F dot(const Vec3<F>& a, const Vec3<F>& b) {
    return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z));
}
template <class F>
ORRERY_INLINE Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
    return {neg_mul_add(a.z, b.y, a.y * b.z), neg_mul_add(a.x, b.z, a.z * b.x), neg_mul_add(a.y, b.x, a.x * b.y)};
}
template <class F>
ORRERY_INLINE Vec3<F> unit(const Vec3<F>& a) {
    return a * (F(1) / root(dot(a, a)));
}
template <class M, class F>
ORRERY_INLINE Vec3<F> choose(const M& m, const Vec3<F>& a, const Vec3<F>& b) {
    return {choose(m, a.x, b.x), choose(m, a.y, b.y), choose(m, a.z, b.z)};
}

/// Lanes of a throughput, components >= 0, that carry nothing. One that is no number in any channel carries something:
/// it goes on to the film, which drops and counts it. (max would forget a NaN in its first operand, and xsimd's != is
/// ordered on AVX and not on SSE2.)
template <class F>
ORRERY_INLINE auto carries_nothing(const Vec3<F>& throughput) {
    return throughput.x + throughput.y + throughput.z == F(0);
}

template <class V>
ORRERY_INLINE Vec3Of<V> load3(const RealOf<V>* x, const RealOf<V>* y, const RealOf<V>* z) {
    using F = Floats<V>;
    return {load<F>(x), load<F>(y), load<F>(z)};
}
template <class V>
ORRERY_INLINE Vec3Of<V> lookup3(const RealOf<V>* x, const RealOf<V>* y, const RealOf<V>* z, const Words<V>& index,
                                std::uint32_t size) {
    using F = Floats<V>;
    return {lookup<F>(x, index, size), lookup<F>(y, index, size), lookup<F>(z, index, size)};
}
template <class V>
ORRERY_INLINE void save3(RealOf<V>* x, RealOf<V>* y, RealOf<V>* z, const Vec3Of<V>& v) {
    save(x, v.x);
    save(y, v.y);
    save(z, v.z);
}

}  // namespace orrery::kernels
