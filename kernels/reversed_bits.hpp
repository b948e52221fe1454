// The bits of a word in reverse order, for which x86 has no instruction.
#pragma once

#include "kernels/lane_words.hpp"

namespace orrery::kernels {

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
