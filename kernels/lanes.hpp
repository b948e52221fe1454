// The dozen operations the kernels use, over xsimd's batches and over plain scalars alike.
//
// A kernel is a template on a `Lanes` type V and says V::F, V::U, V::M for a vector of numbers, of unsigned words of
// the same width, and of truth values. With `ScalarLanes` the same source is ordinary scalar code.
//
// What xsimd 8.1 leaves open and this layer closes: fma on AVX-512 (xsimd multiplies and adds, which rounds twice),
// compress, a mask's bits, comparison of unsigned words as a mask of numbers. SSE2 has no fused multiply-add: there fma
// rounds twice, which is why SSE2 images equal the others in expectation only.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "kernels/always_inline.hpp"

namespace orrery::kernels {

/// The storage word as wide as a number: ids, slots and random bits live in these.
template <class Real>
using WordOf = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

template <class ArchT, class RealT>
struct SimdLanes {
    using Arch = ArchT;
    using Real = RealT;
    using Word = WordOf<Real>;
    using F = xsimd::batch<Real, Arch>;
    using U = xsimd::batch<Word, Arch>;
    using M = xsimd::batch_bool<Real, Arch>;
    static constexpr std::uint32_t count = static_cast<std::uint32_t>(F::size);
};

template <class RealT>
struct ScalarLanes {
    using Real = RealT;
    using Word = WordOf<Real>;
    using F = Real;
    using U = Word;
    using M = bool;
    static constexpr std::uint32_t count = 1;
};

// --- memory -------------------------------------------------------------------------------------------------------

template <class T, class Element>
ORRERY_INLINE T load(const Element* from) {
    if constexpr (std::is_arithmetic_v<T>) {
        return *from;
    } else {
        return T::load_unaligned(from);
    }
}

template <class Element, class T>
ORRERY_INLINE void store(Element* to, const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
        *to = value;
    } else {
        value.store_unaligned(to);
    }
}

/// table[index] per lane. Every index must be valid, those of dead lanes included.
template <class T, class Element, class U>
ORRERY_INLINE T gather(const Element* table, const U& index) {
    if constexpr (std::is_arithmetic_v<T>) {
        return table[index];
#if defined(__AVX512F__)
    } else if constexpr (T::size == 16 && sizeof(Element) == 4) {
        const __m512i i = index;
        if constexpr (std::is_floating_point_v<Element>) {
            return T(_mm512_i32gather_ps(i, table, 4));
        } else {
            return T(_mm512_i32gather_epi32(i, table, 4));
        }
#endif
#if defined(__AVX2__)
    } else if constexpr (T::size == 8 && sizeof(Element) == 4) {
        const __m256i i = index;
        if constexpr (std::is_floating_point_v<Element>) {
            return T(_mm256_i32gather_ps(table, i, 4));
        } else {
            return T(_mm256_i32gather_epi32(reinterpret_cast<const int*>(table), i, 4));
        }
#endif
    } else {
        alignas(64) typename U::value_type at[U::size];
        alignas(64) Element out[U::size];
        index.store_aligned(at);
        for (std::size_t i = 0; i < U::size; ++i) out[i] = table[at[i]];
        return T::load_aligned(out);
    }
}

/// As gather, for a table of `size` entries that is readable up to `widest` ones: a table no longer than a vector is
/// permuted in register, one operation where a gather is a load per lane.
template <class T, class Element, class U>
ORRERY_INLINE T lookup(const Element* table, const U& index, std::uint32_t size) {
    static_cast<void>(size);
#if defined(__AVX512F__)
    if constexpr (!std::is_arithmetic_v<T> && sizeof(Element) == 4) {
        if constexpr (T::size == 16) {
            if (size <= 16) {
                const __m512i i = index;
                if constexpr (std::is_floating_point_v<Element>) {
                    return T(_mm512_permutexvar_ps(i, _mm512_loadu_ps(table)));
                } else {
                    return T(_mm512_permutexvar_epi32(i, _mm512_loadu_si512(table)));
                }
            }
        }
    }
#endif
#if defined(__AVX2__)
    if constexpr (!std::is_arithmetic_v<T> && sizeof(Element) == 4) {
        if constexpr (T::size == 8) {
            if (size <= 8) {
                const __m256i i = index;
                if constexpr (std::is_floating_point_v<Element>) {
                    return T(_mm256_permutevar8x32_ps(_mm256_loadu_ps(table), i));
                } else {
                    const auto* words = reinterpret_cast<const __m256i*>(table);
                    return T(_mm256_permutevar8x32_epi32(_mm256_loadu_si256(words), i));
                }
            }
        }
    }
#endif
    return gather<T>(table, index);
}

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
inline constexpr Real iota_table[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
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
