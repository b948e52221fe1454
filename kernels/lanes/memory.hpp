// Vectors from and to memory, over xsimd's batches and over plain scalars alike.
#pragma once

#include "kernels/lanes/types.hpp"

namespace orrery::kernels {

template <class T, class Element>
ORRERY_INLINE T load(const Element* from) {
    if constexpr (std::is_arithmetic_v<T>) {
        return *from;
    } else {
        return T::load_unaligned(from);
    }
}

/// `to` needs no alignment. Not called store: xsimd's function of that name, which argument-dependent lookup would
/// prefer, wants an aligned address.
template <class Element, class T>
ORRERY_INLINE void save(Element* to, const T& value) {
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
    } else if constexpr (sizeof(T) == 64) {
        const __m512i i = index;
        if constexpr (std::is_same_v<Element, float>) {
            return T(_mm512_i32gather_ps(i, table, 4));
        } else if constexpr (std::is_same_v<Element, double>) {
            return T(_mm512_i64gather_pd(i, table, 8));
        } else if constexpr (sizeof(Element) == 4) {
            return T(_mm512_i32gather_epi32(i, table, 4));
        } else {
            return T(_mm512_i64gather_epi64(i, table, 8));
        }
#endif
#if defined(__AVX2__)
    } else if constexpr (sizeof(T) == 32) {
        const __m256i i = index;
        if constexpr (std::is_same_v<Element, float>) {
            return T(_mm256_i32gather_ps(table, i, 4));
        } else if constexpr (std::is_same_v<Element, double>) {
            return T(_mm256_i64gather_pd(table, i, 8));
        } else if constexpr (sizeof(Element) == 4) {
            return T(_mm256_i32gather_epi32(reinterpret_cast<const int*>(table), i, 4));
        } else {
            return T(_mm256_i64gather_epi64(reinterpret_cast<const long long*>(table), i, 8));
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

/// As gather, for a table of `size` entries that is readable up to `widest` ones: a table no longer than a vector (of
/// AVX-512's doubles: two) is permuted in register, one operation where a gather is a load per lane.
template <class T, class Element, class U>
ORRERY_INLINE T lookup(const Element* table, const U& index, std::uint32_t size) {
    static_cast<void>(size);
#if defined(__AVX512F__)
    if constexpr (!std::is_arithmetic_v<T> && sizeof(T) == 64) {
        if (size <= 16) {
            const __m512i i = index;
            if constexpr (std::is_same_v<Element, float>) {
                return T(_mm512_permutexvar_ps(i, _mm512_loadu_ps(table)));
            } else if constexpr (std::is_same_v<Element, double>) {
                return T(_mm512_permutex2var_pd(_mm512_loadu_pd(table), i, _mm512_loadu_pd(table + 8)));
            } else if constexpr (sizeof(Element) == 4) {
                return T(_mm512_permutexvar_epi32(i, _mm512_loadu_si512(table)));
            } else {
                return T(_mm512_permutex2var_epi64(_mm512_loadu_si512(table), i, _mm512_loadu_si512(table + 8)));
            }
        }
    }
#endif
#if defined(__AVX2__)
    if constexpr (!std::is_arithmetic_v<T> && sizeof(T) == 32 && sizeof(Element) == 4) {
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
#endif
    return gather<T>(table, index);
}

}  // namespace orrery::kernels
