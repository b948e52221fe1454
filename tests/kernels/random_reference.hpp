// pcg4d written a second time, from the paper, in 64-bit arithmetic modulo 2^32.
#pragma once

#include <array>
#include <cstdint>

namespace orrery::kernel_tests {

inline std::array<std::uint32_t, 4> pcg4d_reference(std::array<std::uint32_t, 4> counter) {
    constexpr std::uint64_t modulus = std::uint64_t{1} << 32;
    std::array<std::uint64_t, 4> v{};
    for (std::size_t i = 0; i < 4; ++i) v[i] = (std::uint64_t{counter[i]} * 1664525 + 1013904223) % modulus;
    const auto mix = [&] {  // every word gains the product of two others: x += y
                            // w, y += z x, z += x y, w += y z
        constexpr std::array<std::array<std::size_t, 3>, 4> steps{{{0, 1, 3}, {1, 2, 0}, {2, 0, 1}, {3, 1, 2}}};
        for (const auto& [to, a, b] : steps) v[to] = (v[to] + v[a] * v[b] % modulus) % modulus;
    };
    mix();
    for (std::uint64_t& x : v) x ^= x / 65536;
    mix();
    return {static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1]), static_cast<std::uint32_t>(v[2]),
            static_cast<std::uint32_t>(v[3])};
}

/// What the kernels draw for a vertex: the top 24 bits of each word, over 2^24. `block` is the dimension's number, plus
/// the light's for the dimension `light`.
inline std::array<double, 4> random_reference(std::uint32_t seed, std::uint32_t block, std::uint32_t pixel,
                                              std::uint32_t sample, std::uint32_t vertex) {
    const auto key = static_cast<std::uint32_t>(seed + std::uint64_t{block} * 0x9E3779B9u);
    const auto words = pcg4d_reference({pixel, sample, vertex, key});
    std::array<double, 4> u{};
    for (std::size_t i = 0; i < 4; ++i) u[i] = (words[i] / 256) / 16777216.0;
    return u;
}

}  // namespace orrery::kernel_tests
