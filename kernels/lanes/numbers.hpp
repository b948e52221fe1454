// The dozen operations the kernels use, over xsimd's batches and over plain scalars alike.
//
// What xsimd 8.1 leaves open and this layer closes: a fused multiply-add on AVX-512 (xsimd multiplies and adds, which
// rounds twice), compress (compress.hpp), a mask's bits, words beside numbers (words.hpp). SSE2 has no fused
// multiply-add: there it rounds twice, which is why SSE2 images equal the others in expectation only.
#pragma once

#include <cmath>

#include "kernels/lanes/memory.hpp"
#include "kernels/lanes/words.hpp"

namespace orrery::kernels {

// --- masks --------------------------------------------------------------------------------------------------------

ORRERY_INLINE bool any(bool m) { return m; }
ORRERY_INLINE bool all(bool m) { return m; }
ORRERY_INLINE std::uint32_t bits(bool m) { return m ? 1u : 0u; }

/// Lane i of the mask is bit i.
template <class Real, class Arch>
ORRERY_INLINE std::uint32_t bits(const xsimd::batch_bool<Real, Arch>& m) {
    if constexpr (std::is_base_of_v<xsimd::avx512f, Arch>) {
        return static_cast<std::uint32_t>(m.data);
#if defined(__AVX2__)
    } else if constexpr (std::is_base_of_v<xsimd::avx, Arch>) {
        if constexpr (sizeof(Real) == 8) {
            return static_cast<std::uint32_t>(_mm256_movemask_pd(m.data));
        } else {
            return static_cast<std::uint32_t>(_mm256_movemask_ps(m.data));
        }
#endif
#if defined(__SSE2__)
    } else if constexpr (sizeof(Real) == 8) {
        return static_cast<std::uint32_t>(_mm_movemask_pd(m.data));
    } else {
        return static_cast<std::uint32_t>(_mm_movemask_ps(m.data));
#endif
    }
}

namespace detail {
template <class Real>
inline constexpr Real iota_table[32] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
                                        16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
}

/// Lanes below n: the live part of a queue's last vector.
template <class V>
ORRERY_INLINE Mask<V> first_lanes(std::uint32_t n) {
    using Real = RealOf<V>;
    return load<Floats<V>>(detail::iota_table<Real>) < Floats<V>(static_cast<Real>(n));
}

/// first, first + 1, ... in the lanes.
template <class V>
ORRERY_INLINE Words<V> consecutive(std::uint32_t first) {
    return truncate_to_word(load<Floats<V>>(detail::iota_table<RealOf<V>>)) + Words<V>(first);
}

// --- arithmetic ---------------------------------------------------------------------------------------------------

template <class T>
ORRERY_INLINE std::enable_if_t<std::is_floating_point_v<T>, T> mul_add(T a, T b, T c) {
    return std::fma(a, b, c);
}
/// a b + c, rounded once (twice on SSE2).
template <class Real, class Arch>
ORRERY_INLINE xsimd::batch<Real, Arch> mul_add(const xsimd::batch<Real, Arch>& a, const xsimd::batch<Real, Arch>& b,
                                               const xsimd::batch<Real, Arch>& c) {
#if defined(__AVX512F__)
    if constexpr (std::is_base_of_v<xsimd::avx512f, Arch> && sizeof(Real) == 8) {
        return _mm512_fmadd_pd(a, b, c);
    } else if constexpr (std::is_base_of_v<xsimd::avx512f, Arch>) {
        return _mm512_fmadd_ps(a, b, c);
    } else
#endif
        return xsimd::fma(a, b, c);
}

template <class T>
ORRERY_INLINE std::enable_if_t<std::is_floating_point_v<T>, T> mul_sub(T a, T b, T c) {
    return std::fma(a, b, -c);
}
/// a b - c, rounded once (twice on SSE2).
template <class Real, class Arch>
ORRERY_INLINE xsimd::batch<Real, Arch> mul_sub(const xsimd::batch<Real, Arch>& a, const xsimd::batch<Real, Arch>& b,
                                               const xsimd::batch<Real, Arch>& c) {
#if defined(__AVX512F__)
    if constexpr (std::is_base_of_v<xsimd::avx512f, Arch> && sizeof(Real) == 8) {
        return _mm512_fmsub_pd(a, b, c);
    } else if constexpr (std::is_base_of_v<xsimd::avx512f, Arch>) {
        return _mm512_fmsub_ps(a, b, c);
    } else
#endif
        return xsimd::fms(a, b, c);
}

template <class T>
ORRERY_INLINE std::enable_if_t<std::is_floating_point_v<T>, T> neg_mul_add(T a, T b, T c) {
    return std::fma(-a, b, c);
}
/// c - a b, rounded once (twice on SSE2).
template <class Real, class Arch>
ORRERY_INLINE xsimd::batch<Real, Arch> neg_mul_add(const xsimd::batch<Real, Arch>& a, const xsimd::batch<Real, Arch>& b,
                                                   const xsimd::batch<Real, Arch>& c) {
#if defined(__AVX512F__)
    if constexpr (std::is_base_of_v<xsimd::avx512f, Arch> && sizeof(Real) == 8) {
        return _mm512_fnmadd_pd(a, b, c);
    } else if constexpr (std::is_base_of_v<xsimd::avx512f, Arch>) {
        return _mm512_fnmadd_ps(a, b, c);
    } else
#endif
        return xsimd::fnma(a, b, c);
}

template <class T>
ORRERY_INLINE T root(const T& x) {
    if constexpr (std::is_arithmetic_v<T>) {
        return std::sqrt(x);
    } else {
        return xsimd::sqrt(x);
    }
}

/// The machine's min and max: b where either is NaN. All instruction sets agree on that.
template <class T>
ORRERY_INLINE T min(const T& a, const T& b) {
    if constexpr (std::is_arithmetic_v<T>) {
        return a < b ? a : b;
    } else {
        return xsimd::min(a, b);
    }
}
template <class T>
ORRERY_INLINE T max(const T& a, const T& b) {
    if constexpr (std::is_arithmetic_v<T>) {
        return a > b ? a : b;
    } else {
        return xsimd::max(a, b);
    }
}

/// The least lane.
template <class T>
ORRERY_INLINE std::enable_if_t<std::is_floating_point_v<T>, T> least(T x) {
    return x;
}
template <class Real, class Arch>
ORRERY_INLINE Real least(const xsimd::batch<Real, Arch>& x) {
#if defined(__AVX512F__)
    if constexpr (std::is_base_of_v<xsimd::avx512f, Arch> && std::is_same_v<Real, float>) {
        return _mm512_reduce_min_ps(x);
    } else
#endif
#if defined(__AVX2__)
        if constexpr (std::is_base_of_v<xsimd::avx, Arch> && std::is_same_v<Real, float>) {
        const __m256 all = x;
        using Half = xsimd::batch<float, xsimd::sse2>;
        return least(min(Half(_mm256_castps256_ps128(all)), Half(_mm256_extractf128_ps(all, 1))));
    } else
#endif
    {
        alignas(64) Real lane[xsimd::batch<Real, Arch>::size];
        x.store_aligned(lane);
        Real out = lane[0];
        for (std::size_t i = 1; i < xsimd::batch<Real, Arch>::size; ++i) out = min(out, lane[i]);
        return out;
    }
}

template <class T>
ORRERY_INLINE T magnitude(const T& x) {
    if constexpr (std::is_arithmetic_v<T>) {
        return std::abs(x);
    } else {
        return xsimd::abs(x);
    }
}

/// m ? a : b for numbers.
template <class F>
ORRERY_INLINE std::enable_if_t<std::is_arithmetic_v<F>, F> choose(bool m, F a, F b) {
    return m ? a : b;
}
template <class Real, class Arch>
ORRERY_INLINE xsimd::batch<Real, Arch> choose(const xsimd::batch_bool<Real, Arch>& m, const xsimd::batch<Real, Arch>& a,
                                              const xsimd::batch<Real, Arch>& b) {
    return xsimd::select(m, a, b);
}
}  // namespace orrery::kernels
