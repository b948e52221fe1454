// Sobol' points, shuffled and scrambled, written a second time: bit by bit, from the papers, the sequence from its
// polynomials.
#pragma once

#include <array>

#include "random_reference.hpp"

namespace orrery::kernel_tests {

inline std::uint32_t reversed_reference(std::uint32_t x) {
    std::uint32_t y = 0;
    for (int bit = 0; bit < 32; ++bit)
        if ((x >> bit & 1u) != 0) y |= 1u << (31 - bit);
    return y;
}

/// Sobol's first two dimensions at `index`, as 32 bits behind the point. Direction numbers of Bratley and Fox's
/// recurrence: dimension 1 has none of it, m = 1, 1, 1 ...; dimension 2 has the polynomial x + 1, m_k = 2 m_(k-1) ^
/// m_(k-1).
inline std::array<std::uint32_t, 2> sobol_reference(std::uint32_t index) {
    std::array<std::uint32_t, 2> point{};
    std::uint64_t m = 1;
    for (std::uint32_t k = 1; k <= 32; ++k, m = 2 * m ^ m) {
        if ((index >> (k - 1) & 1u) == 0) continue;
        point[0] ^= 1u << (32 - k);
        point[1] ^= static_cast<std::uint32_t>(m << (32 - k));
    }
    return point;
}

/// Vegdahl's hash of bits by those below them.
inline std::uint32_t flipped_reference(std::uint32_t word, std::uint32_t seed) {
    constexpr std::uint64_t modulus = std::uint64_t{1} << 32;
    std::uint64_t x = word;
    x ^= x * 0x3D20ADEAu % modulus;
    x = (x + seed) % modulus;
    x = x * (seed / 65536 | 1u) % modulus;
    x ^= x * 0x05526C56u % modulus;
    x ^= x * 0x53A22864u % modulus;
    return static_cast<std::uint32_t>(x);
}

/// Owen's scrambling of a number's bits behind the point, and Burley's shuffling of an index.
inline std::uint32_t scrambled_reference(std::uint32_t x, std::uint32_t seed) {
    return reversed_reference(flipped_reference(reversed_reference(x), seed));
}

/// What the kernels draw for a vertex from Sobol's sequences: the words of a block.
inline std::array<std::uint32_t, 4> sobol_block_reference(std::uint32_t seed, std::uint32_t block, std::uint32_t pixel,
                                                          std::uint32_t sample, std::uint32_t vertex) {
    const auto key = static_cast<std::uint32_t>(seed + std::uint64_t{block} * 0x9E3779B9u);
    std::array<std::uint32_t, 4> words{};
    const auto orders = pcg4d_reference({pixel, sample % 2, vertex, key});
    for (std::uint32_t pair = 0; pair < 2; ++pair) {
        const auto point = sobol_reference(scrambled_reference(sample / 2, orders[pair]));
        words[2 * pair] = point[0];
        words[2 * pair + 1] = point[1];
    }
    if (block == 0) {  // the camera's
        words[0] = scrambled_reference(words[0], orders[2]);
        words[1] = scrambled_reference(words[1], orders[3]);
    }
    return words;
}

}  // namespace orrery::kernel_tests
