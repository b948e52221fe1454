// A Sobol' sequence per pixel and vertex, scrambled as Owen does: samples that spread evenly over the dimensions of one
// decision, and still are random numbers, each uniform, whose mean has no bias.
//
// Art B. Owen, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences" (1995): every bit of a number is flipped or not,
// by chance, given the bits above it. Brent Burley, "Practical Hash-based Owen Scrambling" (JCGT 9(4), 2020): a hash
// in which bits change only by those below them, applied to the bits in reverse order, does it for 32 bits at once;
// scrambling the *index* too gives every vertex and decision its own order of the same points, so that sequences of
// two dimensions make one of any number.
//
// A pixel has two sequences, scrambled apart: samples of even number run through one, of odd number through the other.
// Of equally many of both the difference tells the error of the sum without bias (film/contrasts.hpp), which no single
// sequence can.
#pragma once

#include "kernels/reversed_bits.hpp"

namespace orrery::kernels {

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

/// The second dimension of Sobol's sequence at `index`, bits in reverse order: the matrix is Pascal's triangle modulo
/// 2, whose entry (j, k) is 1 where the bits of j are among those of k (Lucas), so that bit j is the sum of the bits k
/// of the index over all k that hold j: five steps, one for each bit of k.
template <class U>
ORRERY_INLINE U reversed_second_dimension(const U& index) {
    U x = low_half(index);
    x = x ^ (x >> 1 & U(0x55555555u));
    x = x ^ (x >> 2 & U(0x33333333u));
    x = x ^ (x >> 4 & U(0x0F0F0F0Fu));
    x = x ^ (x >> 8 & U(0x00FF00FFu));
    return x ^ x >> 16;
}

/// Scrambled points, in the low halves.
template <class U>
struct SobolPair {
    U x, y;
};

/// The first two dimensions; `place` is the number in the sequence, bits in reverse order.
template <class U>
ORRERY_INLINE SobolPair<U> sobol_pair(const U& place, const U& order, const U& seed_x, const U& seed_y) {
    const U index = reversed_bits(flipped_by_lower(place, order));
    // The first dimension is the index with its bits reversed: in reverse order, the index.
    return {reversed_bits(flipped_by_lower(index, seed_x)),
            reversed_bits(flipped_by_lower(reversed_second_dimension(index), seed_y))};
}

}  // namespace orrery::kernels
