// The kinds of arithmetic that give different bits. AVX2 and AVX-512 have scalar code's to the byte (tests/kernels
// shows it), so scalar code stands for them; SSE2, without fused multiply-add, is a kind of its own.
#pragma once

#include "kernels/loop.hpp"

namespace orrery::extremes {

using Float = kernels::ScalarLanes<float>;
using Double = kernels::ScalarLanes<double>;
#if defined(__SSE2__)
using FloatSse2 = kernels::SimdLanes<xsimd::sse2, float>;
#endif

template <class V>
constexpr const char* mode_name() {
    if constexpr (V::count > 1) return "float, SSE2";
    return sizeof(typename V::Real) == 4 ? "float" : "double";
}

/// A limit per kind of arithmetic.
struct Limits {
    double fused, sse2, twofold;
    template <class V>
    constexpr double of() const {
        return V::count > 1 ? sse2 : sizeof(typename V::Real) == 4 ? fused : twofold;
    }
};

/// Calls add.template operator()<V>() for every kind.
template <class Add>
void for_each_mode(const Add& add) {
    add.template operator()<Float>();
#if defined(__SSE2__)
    add.template operator()<FloatSse2>();
#endif
    add.template operator()<Double>();
}

template <class V>
kernels::Vec3<typename V::F> broadcast(const kernels::Vec3<typename V::Real>& v) {
    using F = typename V::F;
    return {F(v.x), F(v.y), F(v.z)};
}
template <class T>
auto first_lane(const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
        return value;
    } else {
        return value.get(0);
    }
}

template <class V>
kernels::Vec3<typename V::Real> first_lanes(const kernels::Vec3<typename V::F>& v) {
    return {first_lane(v.x), first_lane(v.y), first_lane(v.z)};
}

}  // namespace orrery::extremes
