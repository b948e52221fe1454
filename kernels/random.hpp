// Randomness as a pure function of (seed, pixel, sample, vertex, dimension), independent or low-discrepancy.
//
// Nothing of queue position, thread or tile enters, so compaction, sorting, wave size and thread count cannot change an
// image. The function is pcg4d of Jarzynski and Olano, "Hash Functions for GPU Rendering" (JCGT 9(3), 2020): a
// bijection of 128 bits, so that no two (pixel, sample, vertex, key) share their numbers, and four words cost ten
// 32-bit multiplications. Philox4x32-10 needs forty 32 x 32 -> 64 ones, which no vector unit has whole.
#pragma once

#include "kernels/sobol.hpp"

namespace orrery::kernels {

/// What a block of four random numbers is for. One call of `random_block` serves one of these.
enum class Dimension : std::uint32_t {
    camera,      ///< x, y: position in the pixel's cell; z, w: point on the lens
    scattering,  ///< x, y: direction; z: which lobe
    roulette,    ///< x: survive or not
    light,       ///< light + i: the point or direction sampled for light i
};

/// The part of the counter all lanes share.
struct RandomKey {
    std::uint32_t seed = 0;
    Dimension dimension = Dimension::camera;
    std::uint32_t index = 0;  ///< which light, for Dimension::light
};

template <class U>
struct RandomWords {
    U x, y, z, w;
};

/// The four words of one counter, in the low halves.
template <class U>
ORRERY_INLINE RandomWords<U> pcg4d(U x, U y, U z, U w) {
    const U a(1664525u), c(1013904223u);
    x = multiply_words(x, a) + c;
    y = multiply_words(y, a) + c;
    z = multiply_words(z, a) + c;
    w = multiply_words(w, a) + c;
    x = x + multiply_words(y, w);
    y = y + multiply_words(z, x);
    z = z + multiply_words(x, y);
    w = w + multiply_words(y, z);
    x = x ^ (low_half(x) >> 16);
    y = y ^ (low_half(y) >> 16);
    z = z ^ (low_half(z) >> 16);
    w = w ^ (low_half(w) >> 16);
    x = x + multiply_words(y, w);
    y = y + multiply_words(z, x);
    z = z + multiply_words(x, y);
    w = w + multiply_words(y, z);
    return {x, y, z, w};
}

/// Four numbers in [0, 1).
template <class F>
struct RandomNumbers {
    F x, y, z, w;
};

namespace detail {
/// The golden-ratio step keeps the keys of small seeds and small dimensions apart.
ORRERY_INLINE std::uint32_t word_of(const RandomKey& key) {
    return key.seed + (static_cast<std::uint32_t>(key.dimension) + key.index) * 0x9E3779B9u;
}
}  // namespace detail

/// Independent numbers. `vertex` is the bounce number of a path, or the node of a Whitted ray tree.
template <class V>
ORRERY_INLINE RandomNumbers<typename V::F> random_block(const RandomKey& key, const typename V::U& pixel,
                                                        const typename V::U& sample, const typename V::U& vertex) {
    using U = typename V::U;
    const auto r = pcg4d<U>(pixel, sample, vertex, U(detail::word_of(key)));
    return {unit_interval(r.x), unit_interval(r.y), unit_interval(r.z), unit_interval(r.w)};
}

/// Points of Sobol's sequences: x and y are one, z and w another, each pair spread evenly, and paired with the other by
/// chance. `sample` has its bits reversed.
template <class V>
ORRERY_INLINE RandomNumbers<typename V::F> sobol_block(const RandomKey& key, const typename V::U& pixel,
                                                       const typename V::U& sample, const typename V::U& vertex) {
    using U = typename V::U;
    const U word(detail::word_of(key));
    const U place = sample << 1;
    const U sequence = low_half(sample) >> 31;
    const auto seeds = pcg4d<U>(pixel, sequence, vertex, word);
    const auto more = pcg4d<U>(pixel, sequence | U(2u), vertex, word);
    const auto first = sobol_pair<U>(place, seeds.x, seeds.y, seeds.z);
    const auto second = sobol_pair<U>(place, more.x, more.y, more.z);
    return {unit_interval(first.x), unit_interval(first.y), unit_interval(second.x), unit_interval(second.y)};
}

}  // namespace orrery::kernels
