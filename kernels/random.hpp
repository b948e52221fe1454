// Randomness as a pure function of (seed, pixel, sample, vertex, dimension), independent or low-discrepancy.
//
// Nothing of queue position, thread or tile enters, so compaction, sorting, wave size and thread count cannot change an
// image. The function is pcg4d of Jarzynski and Olano, "Hash Functions for GPU Rendering" (JCGT 9(3), 2020): a
// bijection of 128 bits, so that no two (pixel, sample, vertex, key) share their numbers, and four words cost ten
// 32-bit multiplications. Philox4x32-10 needs forty 32 x 32 -> 64 ones, which no vector unit has whole.
#pragma once

#include "kernels/lanes/numbers.hpp"

namespace orrery::kernels {

/// What a block of four random numbers is for. One call of `random_block` serves one of these.
enum class Dimension : std::uint32_t {
    camera,                    ///< x, y: position in the pixel's cell; z, w: point on the lens
    scattering,                ///< x, y: direction; z: which lobe
    roulette,                  ///< x: survive or not
    light,                     ///< light + i: the point or direction sampled for light i
    caustic = 1u << 30,        ///< x: sampled or not, and which; y, z: impact parameter; w: azimuth
    caustic_lobe = 3u << 30,   ///< x, y: direction from a glossy ball to the lamp
    point_caustic = 1u << 31,  ///< point_caustic + i: decisions 4 i to 4 i + 3 about which sphere to ask
};

/// The part of the counter all lanes share.
struct RandomKey {
    std::uint32_t seed = 0;
    Dimension dimension = Dimension::camera;
    std::uint32_t index = 0;  ///< which light
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
ORRERY_INLINE RandomNumbers<Floats<V>> random_block(const RandomKey& key, const Words<V>& pixel, const Words<V>& sample,
                                                    const Words<V>& vertex) {
    using U = Words<V>;
    const auto r = pcg4d<U>(pixel, sample, vertex, U(detail::word_of(key)));
    return {unit_interval(r.x), unit_interval(r.y), unit_interval(r.z), unit_interval(r.w)};
}

// --- low-discrepancy numbers --------------------------------------------------------------------------------------
//
// A Sobol' sequence per pixel and decision, run through in an order of its own: samples that spread evenly over the
// dimensions of one decision, and still are random numbers, each uniform, whose mean has no bias.
//
// The order is what is random. Of the sequence's 2^32 points 2^m consecutive ones, begun at a multiple of 2^m, are a
// net, each of which is another's digital shift. Brent Burley, "Practical Hash-based Owen Scrambling" (JCGT 9(4), 2020)
// shuffles the *index* by a hash in which bits change only by those above them, so that the first 2^m numbers of
// samples become such indices, in an order by chance, of a net by chance. Pairs of dimensions shuffled apart make
// points of any number of dimensions. The camera's place in the pixel, on which all edges depend, is scrambled as Art
// B. Owen does, too ("Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences", 1995): every bit of a number is flipped or
// not, by chance, given the bits above it. To scramble all numbers would take twice as long and was not seen to leave
// less error.
//
// A pixel has two sequences, shuffled apart: samples of even number run through one, of odd number through the other.
// Of equally many of both the difference tells the error of the sum without bias (film/contrasts.hpp), which no single
// sequence can.

/// A bijection of 32 bits for each seed: whether a bit flips depends on those below it and the seed alone. A hash of
/// Laine and Karras's kind, by Nathan Vegdahl ("Building a Better LK Hash", 2021).
template <class U>
ORRERY_INLINE U flipped_by_lower(const U& word, const U& seed) {
    U x = word ^ multiply_words(word, U(0x3D20ADEAu));
    x = x + seed;
    x = multiply_words(x, low_half(seed) >> 16 | U(1u));
    x = x ^ multiply_words(x, U(0x05526C56u));
    return x ^ multiply_words(x, U(0x53A22864u));
}

/// The second dimension of Sobol's sequence, as 32 bits behind the point, where `first` is the first. The matrix is
/// Pascal's triangle modulo 2, whose entry (j, k) is 1 where the bits of j are among those of k (Lucas), so that bit j
/// is the sum of the bits k of the index over all k that hold j: five steps, one for each bit of k. The first dimension
/// is the index with its bits in reverse order, so that the steps go up and not down.
template <class U>
ORRERY_INLINE U second_dimension(const U& first) {
    U x = first;
    x = x ^ (x << 1 & U(0xAAAAAAAAu));
    x = x ^ (x << 2 & U(0xCCCCCCCCu));
    x = x ^ (x << 4 & U(0xF0F0F0F0u));
    x = x ^ (x << 8 & U(0xFF00FF00u));
    return x ^ x << 16;
}

/// Owen's scrambling.
template <class U>
ORRERY_INLINE U flipped_by_higher(const U& word, const U& seed) {
    return reversed_bits(flipped_by_lower(reversed_bits(word), seed));
}

/// Points of Sobol's sequences: x and y are one, z and w another, each pair spread evenly, and paired with the other by
/// chance. `sample` has its bits reversed.
template <class V>
ORRERY_INLINE RandomNumbers<Floats<V>> sobol_block(const RandomKey& key, const Words<V>& pixel, const Words<V>& sample,
                                                   const Words<V>& vertex) {
    using U = Words<V>;
    const U place = sample << 1;
    const U sequence = low_half(sample) >> 31;
    const auto orders = pcg4d<U>(pixel, sequence, vertex, U(detail::word_of(key)));
    U x = flipped_by_lower(place, orders.x);
    U y = second_dimension(x);
    if (key.dimension == Dimension::camera) {
        x = flipped_by_higher(x, orders.z);
        y = flipped_by_higher(y, orders.w);
    }
    const U z = flipped_by_lower(place, orders.y);
    return {unit_interval(x), unit_interval(y), unit_interval(z), unit_interval(second_dimension(z))};
}

/// Either of the two, decided now.
template <class V>
ORRERY_INLINE RandomNumbers<Floats<V>> random_now(bool sobol, const RandomKey& key, const Words<V>& pixel,
                                                  const Words<V>& sample, const Words<V>& vertex) {
    return sobol ? sobol_block<V>(key, pixel, sample, vertex) : random_block<V>(key, pixel, sample, vertex);
}

}  // namespace orrery::kernels
