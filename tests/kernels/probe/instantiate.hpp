// Fills the table of probes for one type of lanes; compiled once per instruction set with the kernels' own flags.
// Everything is a member of a template on V, so that the linker can share nothing between instruction sets.
#pragma once

#include "kernels/arcs.hpp"
#include "kernels/lanes/compress.hpp"
#include "kernels/sampling.hpp"
#include "probe/lane_probe.hpp"

namespace orrery::kernel_tests {

template <class V>
struct Probe {
    using F = typename V::F;
    using U = typename V::U;
    using Real = typename V::Real;
    using Word = typename V::Word;
    using Count = std::uint32_t;

    static F number(const Real* from) { return kernels::load<F>(from); }
    static U word(const Word* from) { return kernels::load<U>(from); }

    static void mul_add(const Real* a, const Real* b, const Real* c, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::mul_add(number(a + i), number(b + i), number(c + i)));
    }
    static void neg_mul_add(const Real* a, const Real* b, const Real* c, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::neg_mul_add(number(a + i), number(b + i), number(c + i)));
    }
    static void choose_less(const Real* a, const Real* b, const Real* c, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::choose(number(a + i) < number(b + i), number(c + i), number(a + i)));
    }
    static void minimum(const Real* a, const Real* b, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::min(number(a + i), number(b + i)));
    }
    static void maximum(const Real* a, const Real* b, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::max(number(a + i), number(b + i)));
    }
    static void divide(const Real* a, const Real* b, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, F(number(a + i) / number(b + i)));
    }
    static void root(const Real* a, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::root(number(a + i)));
    }
    static void magnitude(const Real* a, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::magnitude(number(a + i)));
    }
    static void sincos(const Real* turns, Real* sin, Real* cos, Count n) {
        for (Count i = 0; i < n; i += V::count) {
            const auto at = kernels::sincos_turns<V>(number(turns + i));
            kernels::save(sin + i, at.sin);
            kernels::save(cos + i, at.cos);
        }
    }
    static void flip_sign(const Real* a, const Word* sign, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::flip_sign(number(a + i), word(sign + i)));
    }
    static void multiply_words(const Word* a, const Word* b, Word* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::multiply_words(word(a + i), word(b + i)));
    }
    static void words_equal(const Word* a, const Word* b, Word* out, Count n) {
        for (Count i = 0; i < n; i += V::count) {
            const Count equal = kernels::bits(kernels::words_equal(word(a + i), word(b + i)));
            for (Count lane = 0; lane < V::count; ++lane) out[i + lane] = equal >> lane & 1u;
        }
    }
    static void choose_words(const Real* a, const Real* b, const Word* yes, const Word* no, Word* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::choose(number(a + i) < number(b + i), word(yes + i), word(no + i)));
    }
    static void segment(const Real* sine, const Real* cosine, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::segment<V>(number(sine + i), number(cosine + i)));
    }
    static void angle(const Real* sine, const Real* cosine, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::angle<V>(number(sine + i), number(cosine + i)));
    }
    static void unit_interval(const Word* words, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::unit_interval(word(words + i)));
    }
    static void truncate(const Real* numbers, Word* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::truncate_to_word(number(numbers + i)));
    }
    static void to_number(const Word* words, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::to_number(word(words + i)));
    }

    static Count first_lanes(Count live) { return kernels::bits(kernels::first_lanes<V>(live)); }
    static void any_all(const Real* a, const Real* b, bool& any, bool& all) {
        any = any_of(number(a) < number(b));
        all = all_of(number(a) < number(b));
    }
    static void load_store(const Real* from, Real* to) { kernels::save(to, number(from)); }
    static void compress_numbers(const Real* from, Count chosen, Real* to) {
        kernels::compress_store<V>(to, number(from), chosen);
    }
    static void compress_words(const Word* from, Count chosen, Word* to) {
        kernels::compress_store<V>(to, word(from), chosen);
    }

    static void gather(const Real* table, const Word* index, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::gather<F>(table, word(index + i)));
    }
    static void gather_words(const Word* table, const Word* index, Word* out, Count n) {
        for (Count i = 0; i < n; i += V::count) kernels::save(out + i, kernels::gather<U>(table, word(index + i)));
    }
    static void lookup(const Real* table, Count size, const Word* index, Real* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::lookup<F>(table, word(index + i), size));
    }
    static void lookup_words(const Word* table, Count size, const Word* index, Word* out, Count n) {
        for (Count i = 0; i < n; i += V::count)
            kernels::save(out + i, kernels::lookup<U>(table, word(index + i), size));
    }

    static void pcg4d(const Word* const counters[4], Word* const out[4], Count n) {
        for (Count i = 0; i < n; i += V::count) {
            const auto r = kernels::pcg4d<U>(word(counters[0] + i), word(counters[1] + i), word(counters[2] + i),
                                             word(counters[3] + i));
            kernels::save(out[0] + i, r.x);
            kernels::save(out[1] + i, r.y);
            kernels::save(out[2] + i, r.z);
            kernels::save(out[3] + i, r.w);
        }
    }
    static void random_block(const kernels::RandomKey& key, const Word* pixel, const Word* sample, const Word* vertex,
                             Real* const out[4], Count n) {
        each_block(kernels::random_block<V>, key, pixel, sample, vertex, out, n);
    }
    static void sobol_block(const kernels::RandomKey& key, const Word* pixel, const Word* sample, const Word* vertex,
                            Real* const out[4], Count n) {
        each_block(kernels::sobol_block<V>, key, pixel, sample, vertex, out, n);
    }

private:
    template <class Block>
    static void each_block(Block block, const kernels::RandomKey& key, const Word* pixel, const Word* sample,
                           const Word* vertex, Real* const out[4], Count n) {
        for (Count i = 0; i < n; i += V::count) {
            const auto r = block(key, word(pixel + i), word(sample + i), word(vertex + i));
            kernels::save(out[0] + i, r.x);
            kernels::save(out[1] + i, r.y);
            kernels::save(out[2] + i, r.z);
            kernels::save(out[3] + i, r.w);
        }
    }
    // Found by argument-dependent lookup for batches, in kernels for plain truth values.
    static bool any_of(const typename V::M& m) {
        using kernels::any;
        return any(m);
    }
    static bool all_of(const typename V::M& m) {
        using kernels::all;
        return all(m);
    }
};

template <class V>
constexpr LaneProbe<typename V::Real> make_probe() {
    using P = Probe<V>;
    LaneProbe<typename V::Real> p{};
    p.lanes = V::count;
    p.mul_add = P::mul_add, p.neg_mul_add = P::neg_mul_add, p.choose_less = P::choose_less;
    p.minimum = P::minimum, p.maximum = P::maximum, p.divide = P::divide;
    p.segment = P::segment, p.angle = P::angle;
    p.root = P::root, p.magnitude = P::magnitude, p.sincos = P::sincos, p.flip_sign = P::flip_sign;
    p.multiply_words = P::multiply_words, p.words_equal = P::words_equal, p.choose_words = P::choose_words;
    p.unit_interval = P::unit_interval, p.truncate = P::truncate, p.to_number = P::to_number;
    p.first_lanes = P::first_lanes, p.any_all = P::any_all, p.load_store = P::load_store;
    p.compress_numbers = P::compress_numbers, p.compress_words = P::compress_words;
    p.gather = P::gather, p.gather_words = P::gather_words;
    p.lookup = P::lookup, p.lookup_words = P::lookup_words;
    p.pcg4d = P::pcg4d, p.random_block = P::random_block, p.sobol_block = P::sobol_block;
    return p;
}

}  // namespace orrery::kernel_tests
