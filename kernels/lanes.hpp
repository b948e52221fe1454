// The dozen operations the kernels use, over xsimd's batches and over plain scalars alike.
//
// What xsimd 8.1 leaves open and this layer closes: a fused multiply-add on AVX-512 (xsimd multiplies and adds, which
// rounds twice), compress (compress.hpp), a mask's bits, comparison of unsigned words as a mask of numbers. SSE2 has no
// fused multiply-add: there it rounds twice, which is why SSE2 images equal the others in expectation only.
#pragma once

#include <cmath>

#include "kernels/lane_memory.hpp"

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
        return static_cast<std::uint32_t>(_mm256_movemask_ps(m.data));
#endif
    } else {
        return static_cast<std::uint32_t>(_mm_movemask_ps(m.data));
    }
}

template <class V>
ORRERY_INLINE typename V::M no_lane() {
    return typename V::M(false);
}

namespace detail {
template <class Real>
inline constexpr Real iota_table[32] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
                                        16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31};
}

/// Lanes below n: the live part of a queue's last vector.
template <class V>
ORRERY_INLINE typename V::M first_lanes(std::uint32_t n) {
    using Real = typename V::Real;
    return load<typename V::F>(detail::iota_table<Real>) < typename V::F(static_cast<Real>(n));
}

/// Words equal, as a mask of numbers.
template <class Word, class = std::enable_if_t<std::is_integral_v<Word>>>
ORRERY_INLINE bool words_equal(Word a, Word b) {
    return a == b;
}
template <class Arch>
ORRERY_INLINE xsimd::batch_bool<float, Arch> words_equal(const xsimd::batch<std::uint32_t, Arch>& a,
                                                         const xsimd::batch<std::uint32_t, Arch>& b) {
    using I = xsimd::batch<std::int32_t, Arch>;
    const auto equal = xsimd::bitwise_cast<I>(a) == xsimd::bitwise_cast<I>(b);
#if XSIMD_VERSION_MAJOR < 9
    return xsimd::bool_cast(equal);
#else
    return xsimd::batch_bool_cast<float>(equal);
#endif
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
    if constexpr (std::is_base_of_v<xsimd::avx512f, Arch> && std::is_same_v<Real, float>) {
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
    if constexpr (std::is_base_of_v<xsimd::avx512f, Arch> && std::is_same_v<Real, float>) {
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
    if constexpr (std::is_base_of_v<xsimd::avx512f, Arch> && std::is_same_v<Real, float>) {
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

/// The low 32 bits of each product. xsimd 8.1 multiplies words lane by lane on SSE2; two 32 x 32 -> 64 products do.
ORRERY_INLINE std::uint32_t multiply_words(std::uint32_t a, std::uint32_t b) { return a * b; }
template <class Arch>
ORRERY_INLINE xsimd::batch<std::uint32_t, Arch> multiply_words(const xsimd::batch<std::uint32_t, Arch>& a,
                                                               const xsimd::batch<std::uint32_t, Arch>& b) {
    if constexpr (std::is_same_v<Arch, xsimd::sse2>) {
        const __m128i x = a, y = b;
        const __m128i even = _mm_mul_epu32(x, y);
        const __m128i odd = _mm_mul_epu32(_mm_srli_epi64(x, 32), _mm_srli_epi64(y, 32));
        return xsimd::batch<std::uint32_t, Arch>(
            _mm_unpacklo_epi32(_mm_shuffle_epi32(even, 0x08), _mm_shuffle_epi32(odd, 0x08)));
    } else {
        return a * b;
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
/// m ? a : b for words under a mask of numbers.
template <class Arch>
ORRERY_INLINE xsimd::batch<std::uint32_t, Arch> choose(const xsimd::batch_bool<float, Arch>& m,
                                                       const xsimd::batch<std::uint32_t, Arch>& a,
                                                       const xsimd::batch<std::uint32_t, Arch>& b) {
    using F = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    return xsimd::bitwise_cast<U>(xsimd::select(m, xsimd::bitwise_cast<F>(a), xsimd::bitwise_cast<F>(b)));
}

/// x with its sign flipped where bit 31 of `sign` is set.
ORRERY_INLINE float flip_sign(float x, std::uint32_t sign) { return (sign & 0x80000000u) != 0 ? -x : x; }
template <class Arch>
ORRERY_INLINE xsimd::batch<float, Arch> flip_sign(const xsimd::batch<float, Arch>& x,
                                                  const xsimd::batch<std::uint32_t, Arch>& sign) {
    using F = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    return xsimd::bitwise_cast<F>(xsimd::bitwise_cast<U>(x) ^ (sign & U(0x80000000u)));
}

/// The top 24 bits of a random word as a number in [0, 1): all 32 would round to 1.0 for 128 of them.
ORRERY_INLINE float unit_interval(std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24f; }
template <class Arch>
ORRERY_INLINE xsimd::batch<float, Arch> unit_interval(const xsimd::batch<std::uint32_t, Arch>& word) {
    using I = xsimd::batch<std::int32_t, Arch>;
    return xsimd::to_float(xsimd::bitwise_cast<I>(word >> 8)) * xsimd::batch<float, Arch>(0x1p-24f);
}

/// A number in [0, 2^24) truncated to a word, and back.
ORRERY_INLINE std::uint32_t truncate_to_word(float x) { return static_cast<std::uint32_t>(x); }
template <class Arch>
ORRERY_INLINE xsimd::batch<std::uint32_t, Arch> truncate_to_word(const xsimd::batch<float, Arch>& x) {
    return xsimd::bitwise_cast<xsimd::batch<std::uint32_t, Arch>>(xsimd::to_int(x));
}
ORRERY_INLINE float to_number(std::uint32_t word) { return static_cast<float>(static_cast<std::int32_t>(word)); }
template <class Arch>
ORRERY_INLINE xsimd::batch<float, Arch> to_number(const xsimd::batch<std::uint32_t, Arch>& word) {
    return xsimd::to_float(xsimd::bitwise_cast<xsimd::batch<std::int32_t, Arch>>(word));
}

}  // namespace orrery::kernels
