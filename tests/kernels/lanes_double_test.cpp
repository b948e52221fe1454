// The thin layer over xsimd in double: what differs from float, on every instruction set, against plain C++.
#include <bit>
#include <cmath>
#include <limits>

#include "kernel_test.hpp"
#include "kernels/queues.hpp"
#include "numbers.hpp"
#include "probe/lane_probe.hpp"
#include "random_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using Doubles = std::vector<double>;
using Words = std::vector<std::uint64_t>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t n = 4096;  // a multiple of every lane count

class DoubleLanesTest : public KernelTest {
protected:
    const LaneProbe<double>& probe = lane_probe<double>(GetParam());
};

Doubles numbers(std::uint64_t seed) {
    Numbers random(seed);
    Doubles out(n);
    for (double& x : out) x = random.scale(1e-30, 1e30) * (random.uniform() < 0.5 ? -1 : 1);
    const double special[] = {0.0, -0.0, 1.0, -1.0, infinity, -infinity, nan, 0x1p-1022, 0x1p-1074, 0x1.fp1023};
    for (std::size_t i = 0; i < std::size(special); ++i)
        for (std::size_t j = 0; j < std::size(special); ++j)
            out[16 * i + j] = (seed & 1u) != 0 ? special[i] : special[j];
    return out;
}

/// Random bits as they come out of pcg4d: only the low half is to count.
Words words(std::uint64_t seed, bool clean = false) {
    Numbers random(seed);
    Words out(n);
    for (std::uint64_t& w : out)
        w = random.below(0xFFFFFFFFu) | (clean ? 0 : std::uint64_t{random.below(0xFFFFFFFFu)} << 32);
    const std::uint32_t special[] = {0, 1, 255, 0x7FFFFFFFu, 0x80000000u, 0x80000001u, 0xFFFFFF00u, 0xFFFFFFFFu};
    for (std::size_t i = 0; i < 8; ++i) out[i] = special[i] | (clean ? 0 : out[i + 8] & ~std::uint64_t{0xFFFFFFFFu});
    return out;
}

std::uint32_t low(std::uint64_t word) { return static_cast<std::uint32_t>(word); }

void expect_same(double got, double wanted, std::size_t i) {
    if (std::isnan(wanted)) {
        EXPECT_TRUE(std::isnan(got)) << "item " << i;
    } else {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(got), std::bit_cast<std::uint64_t>(wanted)) << "item " << i;
    }
}

TEST_P(DoubleLanesTest, ArithmeticRoundsOnceWhereTheMachineCan) {
    const Doubles a = numbers(1), b = numbers(2), c = numbers(3);
    Doubles sum(n), difference(n), root(n), quotient(n);
    probe.mul_add(a.data(), b.data(), c.data(), sum.data(), n);
    probe.neg_mul_add(a.data(), b.data(), c.data(), difference.data(), n);
    probe.root(a.data(), root.data(), n);
    probe.divide(a.data(), b.data(), quotient.data(), n);
    const bool fused = GetParam() != Isa::sse2;
    for (std::size_t i = 0; i < n; ++i) {
        expect_same(sum[i], fused ? std::fma(a[i], b[i], c[i]) : a[i] * b[i] + c[i], i);
        expect_same(difference[i], fused ? std::fma(-a[i], b[i], c[i]) : c[i] - a[i] * b[i], i);
        expect_same(root[i], std::sqrt(a[i]), i);
        expect_same(quotient[i], a[i] / b[i], i);
    }
}

TEST_P(DoubleLanesTest, ChoosesNumbersAndWords) {
    const Doubles a = numbers(1), b = numbers(2), c = numbers(3);
    const Words yes = words(4), no = words(5);
    Doubles out(n), flipped(n);
    Words out_words(n), equal(n);
    probe.choose_less(a.data(), b.data(), c.data(), out.data(), n);
    probe.choose_words(a.data(), b.data(), yes.data(), no.data(), out_words.data(), n);
    probe.flip_sign(a.data(), yes.data(), flipped.data(), n);
    probe.words_equal(yes.data(), out_words.data(), equal.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        expect_same(out[i], a[i] < b[i] ? c[i] : a[i], i);
        EXPECT_EQ(out_words[i], a[i] < b[i] ? yes[i] : no[i]);
        expect_same(flipped[i], (yes[i] & 0x80000000u) != 0 ? -a[i] : a[i], i);
        EXPECT_EQ(equal[i], out_words[i] == yes[i] ? 1u : 0u);
    }
}

TEST_P(DoubleLanesTest, OnlyTheLowHalvesOfRandomWordsCount) {
    const Words a = words(1), b = words(2);
    Words product(n);
    Doubles unit(n);
    probe.multiply_words(a.data(), b.data(), product.data(), n);
    probe.unit_interval(a.data(), unit.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(low(product[i]), low(a[i]) * low(b[i]));
        EXPECT_EQ(unit[i], low(a[i]) / 4294967296.0) << "exact, and below 1";
    }
}

TEST_P(DoubleLanesTest, RandomNumbersAreTheFloatsWithEightBitsMore) {
    constexpr std::uint32_t count = 64;
    Words pixel(count), sample(count), vertex(count);
    for (std::uint32_t i = 0; i < count; ++i) pixel[i] = i * 977, sample[i] = i % 5, vertex[i] = i / 9;
    Doubles columns[4] = {Doubles(count), Doubles(count), Doubles(count), Doubles(count)};
    double* const out[4] = {columns[0].data(), columns[1].data(), columns[2].data(), columns[3].data()};
    const kernels::RandomKey key{0xFFFFFFFFu, kernels::Dimension::light, 7};
    probe.random_block(key, pixel.data(), sample.data(), vertex.data(), out, count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto floats = random_reference(key.seed, 10, low(pixel[i]), low(sample[i]), low(vertex[i]));
        for (std::size_t c = 0; c < 4; ++c) {
            EXPECT_EQ(std::floor(columns[c][i] * 0x1p24) * 0x1p-24, floats[c]);
            EXPECT_EQ(std::fmod(columns[c][i] * 0x1p32, 1), 0) << "32 bits";
        }
    }
}

TEST_P(DoubleLanesTest, NumbersTruncateToWordsAndBack) {
    Numbers random(7);
    Doubles in(n), back(n);
    const Words counts = words(6, true);
    Words truncated(n);
    for (double& x : in) x = random.between(0, 16777216);
    in[0] = 1 - 0x1p-53, in[1] = 16777215, in[2] = 0;
    probe.truncate(in.data(), truncated.data(), n);
    probe.to_number(counts.data(), back.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(truncated[i], static_cast<std::uint64_t>(in[i]));
        EXPECT_EQ(back[i], static_cast<double>(counts[i]));
    }
}

// Against long double, whose rounding is 2^-11 of what is allowed.
TEST_P(DoubleLanesTest, SineAndCosineOfTurnsAreDoubles) {
    Numbers random(8);
    Doubles turns(n), sine(n), cosine(n);
    for (double& x : turns) x = random.below(0xFFFFFFFFu) * 0x1p-32;
    for (std::size_t i = 0; i < 64; ++i) turns[i] = static_cast<double>(i) / 64;
    turns[64] = 1 - 0x1p-32, turns[65] = 0x1p-32, turns[66] = 0.125 - 0x1p-32;
    probe.sincos(turns.data(), sine.data(), cosine.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        const long double angle = 2 * std::numbers::pi_v<long double> * static_cast<long double>(turns[i]);
        EXPECT_LE(std::abs(sine[i] - std::sin(angle)), 0x1p-52L) << turns[i];
        EXPECT_LE(std::abs(cosine[i] - std::cos(angle)), 0x1p-52L) << turns[i];
        EXPECT_LE(std::abs(sine[i]), 1.0);
        EXPECT_LE(std::abs(cosine[i]), 1.0);
    }
}

TEST_P(DoubleLanesTest, MasksOfEveryLane) {
    for (std::uint32_t live = 0; live <= 40; ++live)
        EXPECT_EQ(probe.first_lanes(live), (1u << std::min(live, probe.lanes)) - 1) << live;
    const std::uint32_t masks = 1u << probe.lanes;
    for (std::uint32_t mask = 0; mask < masks; ++mask) {
        const Doubles half(8, 0.5);
        Doubles a(8, 1.0);
        for (std::uint32_t lane = 0; lane < probe.lanes; ++lane)
            if ((mask >> lane & 1u) != 0) a[lane] = 0;
        bool any = false, all = false;
        probe.any_all(a.data(), half.data(), any, all);
        EXPECT_EQ(any, mask != 0);
        EXPECT_EQ(all, mask == masks - 1);
    }
}

TEST_P(DoubleLanesTest, LookupIsGather) {
    Numbers random(9);
    for (std::uint32_t size = 1; size <= 40; ++size) {
        Doubles table(size + kernels::widest, nan);
        Words word_table(size + kernels::widest, 0xDEADBEEFu);
        for (std::uint32_t k = 0; k < size; ++k) table[k] = k + 0.5, word_table[k] = 1000 + k;
        constexpr std::uint32_t count = 256;
        Words index(count), gathered_words(count), looked_up_words(count);
        Doubles gathered(count), looked_up(count);
        for (std::uint32_t i = 0; i < count; ++i) index[i] = i < 2 * size ? i % size : random.below(size);
        probe.gather(table.data(), index.data(), gathered.data(), count);
        probe.lookup(table.data(), size, index.data(), looked_up.data(), count);
        probe.gather_words(word_table.data(), index.data(), gathered_words.data(), count);
        probe.lookup_words(word_table.data(), size, index.data(), looked_up_words.data(), count);
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_EQ(gathered[i], static_cast<double>(index[i]) + 0.5) << "size " << size;
            EXPECT_EQ(looked_up[i], gathered[i]) << "size " << size;
            EXPECT_EQ(gathered_words[i], 1000 + index[i]) << "size " << size;
            EXPECT_EQ(looked_up_words[i], gathered_words[i]) << "size " << size;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, DoubleLanesTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
