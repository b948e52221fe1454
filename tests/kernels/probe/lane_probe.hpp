// The thin layer over xsimd, one function per operation, as a table per instruction set: what lets an ordinary test
// call an operation compiled for AVX-512.
//
// All arrays hold `n` items, a multiple of `widest`; masks come back as one 0 or 1 per lane.
#pragma once

#include "kernels/isa.hpp"
#include "kernels/random.hpp"

namespace orrery::kernel_tests {

template <class Real>
struct LaneProbe {
    using Word = kernels::WordOf<Real>;
    std::uint32_t lanes;

    using Numbers3 = void (*)(const Real* a, const Real* b, const Real* c, Real* out, std::uint32_t n);
    Numbers3 mul_add, neg_mul_add;
    Numbers3 choose_less;  ///< a < b ? c : a
    using Numbers2 = void (*)(const Real* a, const Real* b, Real* out, std::uint32_t n);
    Numbers2 minimum, maximum, divide;
    using Numbers1 = void (*)(const Real* a, Real* out, std::uint32_t n);
    Numbers1 root, magnitude;
    Numbers2 segment, angle;  ///< of sine and cosine
    void (*sincos)(const Real* turns, Real* sin, Real* cos, std::uint32_t n);
    void (*flip_sign)(const Real* a, const Word* sign, Real* out, std::uint32_t n);

    using Words2 = void (*)(const Word* a, const Word* b, Word* out, std::uint32_t n);
    Words2 multiply_words, words_equal;
    void (*choose_words)(const Real* a, const Real* b, const Word* yes, const Word* no, Word* out,
                         std::uint32_t n);  ///< a < b ? yes : no
    void (*unit_interval)(const Word* words, Real* out, std::uint32_t n);
    void (*truncate)(const Real* numbers, Word* out, std::uint32_t n);
    void (*to_number)(const Word* words, Real* out, std::uint32_t n);

    // One vector each.
    std::uint32_t (*first_lanes)(std::uint32_t live);  ///< as bits
    void (*any_all)(const Real* a, const Real* b, bool& any,
                    bool& all);  ///< of a < b
    void (*load_store)(const Real* from, Real* to);
    void (*compress_numbers)(const Real* from, std::uint32_t chosen, Real* to);
    void (*compress_words)(const Word* from, std::uint32_t chosen, Word* to);

    void (*gather)(const Real* table, const Word* index, Real* out, std::uint32_t n);
    void (*gather_words)(const Word* table, const Word* index, Word* out, std::uint32_t n);
    void (*lookup)(const Real* table, std::uint32_t size, const Word* index, Real* out, std::uint32_t n);
    void (*lookup_words)(const Word* table, std::uint32_t size, const Word* index, Word* out, std::uint32_t n);

    /// Four words per item, in four columns.
    void (*pcg4d)(const Word* const counters[4], Word* const out[4], std::uint32_t n);
    using Block = void (*)(const kernels::RandomKey& key, const Word* pixel, const Word* sample, const Word* vertex,
                           Real* const out[4], std::uint32_t n);
    Block random_block, sobol_block;
};

/// For a supported `isa`.
template <class Real>
const LaneProbe<Real>& lane_probe(Isa isa);
template <>
const LaneProbe<float>& lane_probe(Isa isa);
template <>
const LaneProbe<double>& lane_probe(Isa isa);

}  // namespace orrery::kernel_tests
