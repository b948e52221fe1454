// The thin layer over xsimd, one function per operation, as a table per instruction set: what lets an ordinary test
// call an operation compiled for AVX-512.
//
// All arrays hold `n` items, a multiple of `widest`; masks come back as one 0 or 1 per lane.
#pragma once

#include "kernels/isa.hpp"
#include "kernels/random.hpp"

namespace orrery::kernel_tests {

struct LaneProbe {
    std::uint32_t lanes;

    using Numbers3 = void (*)(const float* a, const float* b, const float* c, float* out, std::uint32_t n);
    Numbers3 mul_add, neg_mul_add;
    Numbers3 choose_less;  ///< a < b ? c : a
    using Numbers2 = void (*)(const float* a, const float* b, float* out, std::uint32_t n);
    Numbers2 minimum, maximum, divide;
    using Numbers1 = void (*)(const float* a, float* out, std::uint32_t n);
    Numbers1 root, magnitude;
    void (*sincos)(const float* turns, float* sin, float* cos, std::uint32_t n);
    void (*flip_sign)(const float* a, const std::uint32_t* sign, float* out, std::uint32_t n);

    using Words2 = void (*)(const std::uint32_t* a, const std::uint32_t* b, std::uint32_t* out, std::uint32_t n);
    Words2 multiply_words, words_equal;
    void (*choose_words)(const float* a, const float* b, const std::uint32_t* yes, const std::uint32_t* no,
                         std::uint32_t* out,
                         std::uint32_t n);  ///< a < b ? yes : no
    void (*unit_interval)(const std::uint32_t* words, float* out, std::uint32_t n);
    void (*truncate)(const float* numbers, std::uint32_t* out, std::uint32_t n);
    void (*to_number)(const std::uint32_t* words, float* out, std::uint32_t n);

    // One vector each.
    std::uint32_t (*first_lanes)(std::uint32_t live);  ///< as bits
    void (*any_all)(const float* a, const float* b, bool& any,
                    bool& all);  ///< of a < b
    void (*load_store)(const float* from, float* to);
    void (*compress_numbers)(const float* from, std::uint32_t chosen, float* to);
    void (*compress_words)(const std::uint32_t* from, std::uint32_t chosen, std::uint32_t* to);

    void (*gather)(const float* table, const std::uint32_t* index, float* out, std::uint32_t n);
    void (*gather_words)(const std::uint32_t* table, const std::uint32_t* index, std::uint32_t* out, std::uint32_t n);
    void (*lookup)(const float* table, std::uint32_t size, const std::uint32_t* index, float* out, std::uint32_t n);
    void (*lookup_words)(const std::uint32_t* table, std::uint32_t size, const std::uint32_t* index, std::uint32_t* out,
                         std::uint32_t n);

    /// Four words per item, in four columns.
    void (*pcg4d)(const std::uint32_t* const counters[4], std::uint32_t* const out[4], std::uint32_t n);
    void (*random_block)(const kernels::RandomKey& key, const std::uint32_t* pixel, const std::uint32_t* sample,
                         const std::uint32_t* vertex, float* const out[4], std::uint32_t n);
};

/// For a supported `isa`.
const LaneProbe& lane_probe(Isa isa);

}  // namespace orrery::kernel_tests
