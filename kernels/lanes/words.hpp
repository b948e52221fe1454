// Words beside numbers: words of random bits, ids and counts, of the same width as the numbers.
//
// In words of 64 bits all that counts is the low half: ids, slots and random bits are 32 bits wide whatever the numbers
// are, so that float and double take the same decisions from the same bits.
#pragma once

#include <bit>

#include "kernels/lanes/types.hpp"

namespace orrery::kernels {

/// The same bits, as elements of type To. Up to version 10 xsimd's function is told the type of the vector instead.
template <class To, class From, class Arch>
ORRERY_INLINE xsimd::batch<To, Arch> bits_as(const xsimd::batch<From, Arch>& x) {
#if XSIMD_VERSION_MAJOR < 11
    return xsimd::bitwise_cast<xsimd::batch<To, Arch>>(x);
#else
    return xsimd::bitwise_cast<To>(x);
#endif
}

/// Words equal, as a mask of numbers.
template <class Word, class = std::enable_if_t<std::is_integral_v<Word>>>
ORRERY_INLINE bool words_equal(Word a, Word b) {
    return a == b;
}
template <class Word, class Arch>
ORRERY_INLINE auto words_equal(const xsimd::batch<Word, Arch>& a, const xsimd::batch<Word, Arch>& b) {
    using Signed = std::make_signed_t<Word>;
    const auto equal = bits_as<Signed>(a) == bits_as<Signed>(b);
#if XSIMD_VERSION_MAJOR < 9
    return xsimd::bool_cast(equal);
#else
    return xsimd::batch_bool_cast<std::conditional_t<sizeof(Word) == 8, double, float>>(equal);
#endif
}

/// m ? a : b for words under a mask of numbers.
template <class Real, class Arch>
ORRERY_INLINE xsimd::batch<WordOf<Real>, Arch> choose(const xsimd::batch_bool<Real, Arch>& m,
                                                      const xsimd::batch<WordOf<Real>, Arch>& a,
                                                      const xsimd::batch<WordOf<Real>, Arch>& b) {
    return bits_as<WordOf<Real>>(xsimd::select(m, bits_as<Real>(a), bits_as<Real>(b)));
}

/// The low 32 bits of words that may hold anything above them.
template <class U>
ORRERY_INLINE U low_half(const U& a) {
    if constexpr (std::is_arithmetic_v<U>) {
        return static_cast<std::uint32_t>(a);
    } else if constexpr (sizeof(typename U::value_type) == 8) {
        return a & U(0xFFFFFFFFu);
    } else {
        return a;
    }
}

/// The low 32 bits of each product of low halves; above them anything. xsimd 8.1 multiplies words lane by lane on SSE2;
/// two 32 x 32 -> 64 products do.
ORRERY_INLINE std::uint32_t multiply_words(std::uint32_t a, std::uint32_t b) { return a * b; }
ORRERY_INLINE std::uint64_t multiply_words(std::uint64_t a, std::uint64_t b) { return low_half(a) * low_half(b); }
template <class Word, class Arch>
ORRERY_INLINE xsimd::batch<Word, Arch> multiply_words(const xsimd::batch<Word, Arch>& a,
                                                      const xsimd::batch<Word, Arch>& b) {
    using U [[maybe_unused]] = xsimd::batch<Word, Arch>;
    if constexpr (sizeof(Word) == 8) {
#if defined(__AVX512F__)
        if constexpr (sizeof(U) == 64) return U(_mm512_mul_epu32(a, b));
#endif
#if defined(__AVX2__)
        if constexpr (sizeof(U) == 32) return U(_mm256_mul_epu32(a, b));
#endif
#if defined(__SSE2__)
        if constexpr (sizeof(U) == 16) return U(_mm_mul_epu32(a, b));
    } else if constexpr (std::is_same_v<Arch, xsimd::sse2>) {
        const __m128i x = a, y = b;
        const __m128i even = _mm_mul_epu32(x, y);
        const __m128i odd = _mm_mul_epu32(_mm_srli_epi64(x, 32), _mm_srli_epi64(y, 32));
        return U(_mm_unpacklo_epi32(_mm_shuffle_epi32(even, 0x08), _mm_shuffle_epi32(odd, 0x08)));
#endif
    } else {
        return a * b;
    }
}

/// x with its sign flipped where bit 31 of `sign` is set.
ORRERY_INLINE float flip_sign(float x, std::uint32_t sign) { return (sign & 0x80000000u) != 0 ? -x : x; }
ORRERY_INLINE double flip_sign(double x, std::uint64_t sign) { return (sign & 0x80000000u) != 0 ? -x : x; }
template <class Real, class Arch>
ORRERY_INLINE xsimd::batch<Real, Arch> flip_sign(const xsimd::batch<Real, Arch>& x,
                                                 const xsimd::batch<WordOf<Real>, Arch>& sign) {
    using U = xsimd::batch<WordOf<Real>, Arch>;
    U top = sign & U(0x80000000u);
    if constexpr (sizeof(Real) == 8) top = top << 32;
    return bits_as<Real>(bits_as<WordOf<Real>>(x) ^ top);
}

/// The low half of a random word as a number in [0, 1). A float takes its top 24 bits, as all 32 would round to 1.0 for
/// 128 of them; a double takes all, and so differs from the float by less than 2^-24.
ORRERY_INLINE float unit_interval(std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24f; }
ORRERY_INLINE double unit_interval(std::uint64_t word) { return static_cast<double>(low_half(word)) * 0x1p-32; }
template <class Word, class Arch>
ORRERY_INLINE auto unit_interval(const xsimd::batch<Word, Arch>& word) {
    if constexpr (sizeof(Word) == 8) {
        // The bits behind the point of a number in [1, 2): exact, and no instruction set lacks it.
        using U = xsimd::batch<Word, Arch>;
        using F = xsimd::batch<double, Arch>;
        return bits_as<double>(low_half(word) << 20 | U(std::bit_cast<Word>(1.0))) - F(1);
    } else {
        return xsimd::to_float(bits_as<std::int32_t>(word >> 8)) * xsimd::batch<float, Arch>(0x1p-24f);
    }
}

/// A number in [0, 2^24) truncated to a word, and back.
ORRERY_INLINE std::uint32_t truncate_to_word(float x) { return static_cast<std::uint32_t>(x); }
ORRERY_INLINE std::uint64_t truncate_to_word(double x) { return static_cast<std::uint64_t>(x); }
template <class Real, class Arch>
ORRERY_INLINE xsimd::batch<WordOf<Real>, Arch> truncate_to_word(const xsimd::batch<Real, Arch>& x) {
    using U [[maybe_unused]] = xsimd::batch<WordOf<Real>, Arch>;
    if constexpr (sizeof(Real) == 8) {
#if defined(__AVX512DQ__)
        if constexpr (sizeof(U) == 64) return U(_mm512_cvttpd_epi64(x));
#endif
#if defined(__AVX2__)
        if constexpr (sizeof(U) == 32) return U(_mm256_cvtepu32_epi64(_mm256_cvttpd_epi32(x)));
#endif
#if defined(__SSE2__)
        if constexpr (sizeof(U) == 16) return U(_mm_unpacklo_epi32(_mm_cvttpd_epi32(x), _mm_setzero_si128()));
#endif
    } else {
        return bits_as<WordOf<Real>>(xsimd::to_int(x));
    }
}
ORRERY_INLINE float to_number(std::uint32_t word) { return static_cast<float>(static_cast<std::int32_t>(word)); }
ORRERY_INLINE double to_number(std::uint64_t word) { return static_cast<double>(static_cast<std::int64_t>(word)); }
template <class Word, class Arch>
ORRERY_INLINE auto to_number(const xsimd::batch<Word, Arch>& word) {
    if constexpr (sizeof(Word) == 8) {
        // As the last bits of a number in [2^52, 2^53).
        using F = xsimd::batch<double, Arch>;
        return bits_as<double>(word | xsimd::batch<Word, Arch>(std::bit_cast<Word>(0x1p52))) - F(0x1p52);
    } else {
        return xsimd::to_float(bits_as<std::int32_t>(word));
    }
}

// --- bits in reverse order, for which x86 has no instruction ------------------------------------------------------

namespace detail {
/// Neighbouring groups of bits change places, from halves down to single bits.
template <class U>
ORRERY_INLINE U reversed_by_halves(const U& word) {
    const auto swapped = [](const U& x, int places, std::uint32_t upper) {
        return (x << places & U(upper)) | (x >> places & U(~upper));
    };
    U x = low_half(word);
    x = swapped(x, 16, 0xFFFF0000u);
    x = swapped(x, 8, 0xFF00FF00u);
    x = swapped(x, 4, 0xF0F0F0F0u);
    x = swapped(x, 2, 0xCCCCCCCCu);
    return swapped(x, 1, 0xAAAAAAAAu);
}

#if defined(__AVX2__)
/// Where each byte of a result comes from, in sixteen bytes.
template <class Word>
ORRERY_INLINE __m128i bytes_reversed() {
    if constexpr (sizeof(Word) == 8) {  // of the low halves
        return _mm_set_epi8(-1, -1, -1, -1, 8, 9, 10, 11, -1, -1, -1, -1, 0, 1, 2, 3);
    } else {
        return _mm_set_epi8(12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3);
    }
}
/// Four bits in reverse order, as the upper or lower half of a byte.
ORRERY_INLINE __m128i reversed_into_low() { return _mm_set_epi8(15, 7, 11, 3, 13, 5, 9, 1, 14, 6, 10, 2, 12, 4, 8, 0); }
ORRERY_INLINE __m128i reversed_into_high() { return _mm_slli_epi16(reversed_into_low(), 4); }
#endif
}  // namespace detail

/// The low 32 bits in reverse order.
ORRERY_INLINE std::uint32_t reversed_bits(std::uint32_t word) { return detail::reversed_by_halves(word); }
ORRERY_INLINE std::uint64_t reversed_bits(std::uint64_t word) { return detail::reversed_by_halves(word); }
/// Where bytes can be looked up in a table of sixteen, half a byte at a time takes a third of the operations.
template <class Word, class Arch>
ORRERY_INLINE xsimd::batch<Word, Arch> reversed_bits(const xsimd::batch<Word, Arch>& word) {
#if defined(__AVX512BW__)
    if constexpr (sizeof(word.data) == 64) {
        const auto wide = [](__m128i table) { return _mm512_broadcast_i32x4(table); };
        const __m512i low_bits = _mm512_set1_epi8(0x0F);
        const __m512i bytes = _mm512_shuffle_epi8(word, wide(detail::bytes_reversed<Word>()));
        const __m512i low = _mm512_and_si512(bytes, low_bits);
        const __m512i high = _mm512_and_si512(_mm512_srli_epi32(bytes, 4), low_bits);
        return _mm512_or_si512(_mm512_shuffle_epi8(wide(detail::reversed_into_high()), low),
                               _mm512_shuffle_epi8(wide(detail::reversed_into_low()), high));
    } else
#endif
#if defined(__AVX2__)
        if constexpr (sizeof(word.data) == 32) {
        const auto wide = [](__m128i table) { return _mm256_broadcastsi128_si256(table); };
        const __m256i low_bits = _mm256_set1_epi8(0x0F);
        const __m256i bytes = _mm256_shuffle_epi8(word, wide(detail::bytes_reversed<Word>()));
        const __m256i low = _mm256_and_si256(bytes, low_bits);
        const __m256i high = _mm256_and_si256(_mm256_srli_epi32(bytes, 4), low_bits);
        return _mm256_or_si256(_mm256_shuffle_epi8(wide(detail::reversed_into_high()), low),
                               _mm256_shuffle_epi8(wide(detail::reversed_into_low()), high));
    } else
#endif
        return detail::reversed_by_halves(word);
}

}  // namespace orrery::kernels
