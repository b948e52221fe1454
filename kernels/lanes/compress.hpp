// Move the chosen lanes of a vector to the front of memory.
//
// xsimd 8.1 has no compress. AVX-512 compresses in register and stores the whole vector, because compressing to memory
// is micro-coded on Zen 4; AVX2 permutes by a table; the rest copies lane by lane.
#pragma once

#include <array>
#include <bit>

#include "kernels/lanes/numbers.hpp"

namespace orrery::kernels {

namespace detail {
/// For every mask of `lanes` lanes of `words` 32-bit words each: byte i is the word that comes to place i (0 behind the
/// last).
template <unsigned lanes, unsigned words>
consteval std::array<std::uint64_t, 1u << lanes> make_compress_table() {
    std::array<std::uint64_t, 1u << lanes> table{};
    for (unsigned m = 0; m < table.size(); ++m) {
        unsigned out = 0;
        for (unsigned word = 0; word < lanes * words; ++word)
            if (m >> (word / words) & 1u) table[m] |= std::uint64_t{word} << (8 * out++);
    }
    return table;
}
template <unsigned lanes, unsigned words>
inline constexpr std::array<std::uint64_t, 1u << lanes> compress_table = make_compress_table<lanes, words>();
}  // namespace detail

/// Stores the lanes of `value` whose bit is set in `chosen` at to[0], to[1], ... in lane order. Writes a whole vector:
/// what lies between popcount(chosen) and the vector's width behind `to` is overwritten with anything.
template <class V, class T>
ORRERY_INLINE void compress_store(typename T::value_type* to, const T& value, std::uint32_t chosen) {
    using Element = typename T::value_type;
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 64) {
        if constexpr (std::is_same_v<Element, float>) {
            _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(chosen), value));
        } else if constexpr (std::is_same_v<Element, double>) {
            _mm512_storeu_pd(to, _mm512_maskz_compress_pd(static_cast<__mmask8>(chosen), value));
        } else if constexpr (sizeof(Element) == 4) {
            _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(chosen), value));
        } else {
            _mm512_storeu_si512(to, _mm512_maskz_compress_epi64(static_cast<__mmask8>(chosen), value));
        }
        return;
    }
#endif
#if defined(__AVX2__)
    if constexpr (sizeof(T) == 32) {
        constexpr auto& table = detail::compress_table<V::count, sizeof(Element) / 4>;
        const __m256i words = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(table[chosen])));
        if constexpr (std::is_same_v<Element, float>) {
            _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(value, words));
        } else if constexpr (std::is_same_v<Element, double>) {
            _mm256_storeu_pd(to, _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(value), words)));
        } else {
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(value, words));
        }
        return;
    }
#endif
    if constexpr (sizeof(T) == 16) {
        alignas(16) Element lane[T::size];
        value.store_aligned(lane);
        // A store for every lane, each on top of the last one unless that was chosen: a loop over the chosen lanes took
        // twice as long, its end being anybody's guess.
        const std::uint32_t first = chosen & 1u;
        to[0] = lane[0];
        to[first] = lane[1];
        if constexpr (T::size == 4) {
            const std::uint32_t second = first + (chosen >> 1 & 1u), third = second + (chosen >> 2 & 1u);
            to[second] = lane[2];
            to[third] = lane[3];
        }
    }
}

template <class V, class T>
ORRERY_INLINE std::enable_if_t<std::is_arithmetic_v<T>> compress_store(T* to, T value, std::uint32_t chosen) {
    if (chosen != 0) *to = value;
}

/// Moves the chosen lanes of every field that both have, of `from` lanes i.., to the entries of `to` from `at` on.
template <class V, class Queue>
ORRERY_INLINE void move_record(const Queue& from, std::uint32_t i, const Queue& to, std::uint32_t at,
                               std::uint32_t chosen) {
    Queue::each_field([&](const char*, auto field) {
        if (from.*field == nullptr || to.*field == nullptr) return;
        using Element = std::remove_pointer_t<std::remove_cvref_t<decltype(from.*field)>>;
        using T = std::conditional_t<std::is_floating_point_v<Element>, typename V::F, typename V::U>;
        compress_store<V>(to.*field + at, load<T>(from.*field + i), chosen);
    });
}

}  // namespace orrery::kernels
