// The thin layer over xsimd: every operation, on every instruction set, against plain C++.
#include <bit>
#include <cmath>
#include <limits>

#include "kernel_test.hpp"
#include "kernels/queues.hpp"
#include "numbers.hpp"
#include "probe/lane_probe.hpp"

namespace orrery::kernel_tests {
namespace {

using Floats = std::vector<float>;
using Words = std::vector<std::uint32_t>;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t n = 4096;  // a multiple of every lane count

class LanesTest : public KernelTest {
protected:
    const LaneProbe<float>& probe = lane_probe<float>(GetParam());
};

std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

/// Signed numbers over 40 powers of two, and among them everything special.
Floats numbers(std::uint64_t seed) {
    Numbers random(seed);
    Floats out(n);
    for (float& x : out) x = narrow(random.scale(1e-6, 1e6) * (random.uniform() < 0.5 ? -1 : 1));
    const float special[] = {0.0f, -0.0f, 1.0f, -1.0f, infinity, -infinity, nan, 0x1p-126f, 0x1p-149f, 0x1.fffffep127f};
    for (std::size_t i = 0; i < std::size(special); ++i)
        for (std::size_t j = 0; j < std::size(special); ++j)
            out[16 * i + j] = (seed & 1u) != 0 ? special[i] : special[j];
    return out;
}

Words words(std::uint64_t seed) {
    Numbers random(seed);
    Words out(n);
    for (std::uint32_t& w : out) w = random.below(0xFFFFFFFFu);
    const std::uint32_t special[] = {0, 1, 255, 256, 0x7FFFFFFFu, 0x80000000u, 0x80000001u, 0xFFFFFF00u, 0xFFFFFFFFu};
    for (std::size_t i = 0; i < std::size(special); ++i)
        for (std::size_t j = 0; j < std::size(special); ++j)
            out[16 * i + j] = (seed & 1u) != 0 ? special[i] : special[j];
    return out;
}

void expect_same(float got, float wanted, std::size_t i) {
    if (std::isnan(wanted)) {
        EXPECT_TRUE(std::isnan(got)) << "item " << i;
    } else {
        EXPECT_EQ(bits_of(got), bits_of(wanted)) << "item " << i << ": " << got << ", not " << wanted;
    }
}

TEST_P(LanesTest, AsManyAsTheStagesSay) { EXPECT_EQ(probe.lanes, stages.lanes); }

TEST_P(LanesTest, MulAddRoundsOnceWhereTheMachineCan) {
    const Floats a = numbers(1), b = numbers(2), c = numbers(3);
    Floats out(n), negated(n);
    probe.mul_add(a.data(), b.data(), c.data(), out.data(), n);
    probe.neg_mul_add(a.data(), b.data(), c.data(), negated.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        if (GetParam() == Isa::sse2) {
            expect_same(out[i], a[i] * b[i] + c[i], i);
            expect_same(negated[i], c[i] - a[i] * b[i], i);
        } else {
            expect_same(out[i], std::fma(a[i], b[i], c[i]), i);
            expect_same(negated[i], std::fma(-a[i], b[i], c[i]), i);
        }
    }
}

// (1 + e)(1 - e) - 1 is -e^2 rounded once and 0 rounded twice, however the numbers above may fall.
TEST_P(LanesTest, MulAddKeepsTheLowHalfOfTheProduct) {
    const Floats a(16, 1 + 0x1p-20f), b(16, 1 - 0x1p-20f), minus_one(16, -1.0f), one(16, 1.0f);
    Floats out(16), negated(16);
    probe.mul_add(a.data(), b.data(), minus_one.data(), out.data(), 16);
    probe.neg_mul_add(a.data(), b.data(), one.data(), negated.data(), 16);
    const float low = GetParam() == Isa::sse2 ? 0.0f : 0x1p-40f;
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(out[i], -low);
        EXPECT_EQ(negated[i], low);
    }
}

TEST_P(LanesTest, DivisionAndRootAreCorrectlyRounded) {
    const Floats a = numbers(1), b = numbers(2);
    Floats quotient(n), root(n), magnitude(n);
    probe.divide(a.data(), b.data(), quotient.data(), n);
    probe.root(a.data(), root.data(), n);
    probe.magnitude(a.data(), magnitude.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        expect_same(quotient[i], a[i] / b[i], i);
        expect_same(root[i], std::sqrt(a[i]), i);
        EXPECT_EQ(bits_of(magnitude[i]), bits_of(a[i]) & 0x7FFFFFFFu);
    }
}

// Kernels rely on the second operand coming back where either is no number, and of equal ones (both zeros) too.
TEST_P(LanesTest, MinAndMaxReturnTheSecondWhereNeitherIsLess) {
    const Floats a = numbers(1), b = numbers(2);
    Floats low(n), high(n);
    probe.minimum(a.data(), b.data(), low.data(), n);
    probe.maximum(a.data(), b.data(), high.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        expect_same(low[i], a[i] < b[i] ? a[i] : b[i], i);
        expect_same(high[i], a[i] > b[i] ? a[i] : b[i], i);
    }
}

TEST_P(LanesTest, ChoosesByMask) {
    const Floats a = numbers(1), b = numbers(2), c = numbers(3);
    const Words yes = words(4), no = words(5);
    Floats out(n);
    Words out_words(n);
    probe.choose_less(a.data(), b.data(), c.data(), out.data(), n);
    probe.choose_words(a.data(), b.data(), yes.data(), no.data(), out_words.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(bits_of(out[i]), bits_of(a[i] < b[i] ? c[i] : a[i]));
        EXPECT_EQ(out_words[i], a[i] < b[i] ? yes[i] : no[i]);
    }
}

TEST_P(LanesTest, WordsMultiplyAndCompare) {
    const Words a = words(1);
    Words b = words(2), product(n), equal(n);
    for (std::size_t i = 0; i < n; i += 3) b[i] = a[i];
    for (std::size_t i = 1; i < n; i += 3) b[i] = a[i] ^ (1u << i % 32);  // differ in one bit, the sign's among them
    probe.multiply_words(a.data(), b.data(), product.data(), n);
    probe.words_equal(a.data(), b.data(), equal.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(product[i], static_cast<std::uint32_t>(std::uint64_t{a[i]} * b[i]));
        EXPECT_EQ(equal[i], a[i] == b[i] ? 1u : 0u);
    }
}

TEST_P(LanesTest, UnitIntervalIsNeverOne) {
    Words in = words(1);
    for (std::uint32_t i = 0; i < 512; ++i) in[1024 + i] = 0xFFFFFFFFu - i;  // those a division by 2^32 rounds to 1
    Floats out(n);
    probe.unit_interval(in.data(), out.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_GE(out[i], 0.0f);
        EXPECT_LT(out[i], 1.0f);
        EXPECT_EQ(static_cast<double>(out[i]), (in[i] >> 8) / 16777216.0) << "exact: 24 bits fit";
    }
}

TEST_P(LanesTest, NumbersTruncateToWordsAndBack) {
    Numbers random(7);
    Floats numbers_in(n);
    Words words_in(n), truncated(n);
    for (std::size_t i = 0; i < n; ++i) {
        numbers_in[i] = narrow(random.between(0, 16777216));
        words_in[i] = random.below(16777216);
    }
    numbers_in[0] = 0.999999f, numbers_in[1] = 16777215.0f, numbers_in[2] = 0;
    words_in[0] = 16777215, words_in[1] = 0;
    Floats back(n);
    probe.truncate(numbers_in.data(), truncated.data(), n);
    probe.to_number(words_in.data(), back.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_EQ(truncated[i], static_cast<std::uint32_t>(std::floor(numbers_in[i])));
        EXPECT_EQ(static_cast<double>(back[i]), static_cast<double>(words_in[i]));
    }
}

TEST_P(LanesTest, FlipsSigns) {
    const Floats a = numbers(1);
    const Words sign = words(2);
    Floats out(n);
    probe.flip_sign(a.data(), sign.data(), out.data(), n);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(bits_of(out[i]), bits_of(a[i]) ^ (sign[i] & 0x80000000u));
}

TEST_P(LanesTest, SineAndCosineOfTurns) {
    Numbers random(8);
    Floats turns(n);
    for (std::size_t i = 0; i < n; ++i) turns[i] = static_cast<float>(random.below(16777216)) * 0x1p-24f;
    for (std::size_t i = 0; i < 64; ++i) turns[i] = static_cast<float>(i) / 64;  // all multiples of an eighth turn
    turns[64] = 1 - 0x1p-24f, turns[65] = 0x1p-24f, turns[66] = 0.125f - 0x1p-24f;
    Floats sine(n), cosine(n);
    probe.sincos(turns.data(), sine.data(), cosine.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(turns[i]);
        EXPECT_NEAR(sine[i], std::sin(angle), 0x1p-23) << turns[i];
        EXPECT_NEAR(cosine[i], std::cos(angle), 0x1p-23) << turns[i];
        EXPECT_LE(std::abs(sine[i]), 1.0f);
        EXPECT_LE(std::abs(cosine[i]), 1.0f);
    }
}

TEST_P(LanesTest, FirstLanes) {
    for (std::uint32_t live = 0; live <= 40; ++live) {
        const std::uint32_t lanes = std::min(live, probe.lanes);
        EXPECT_EQ(probe.first_lanes(live), (std::uint64_t{1} << lanes) - 1) << live;
    }
    EXPECT_EQ(probe.first_lanes(1u << 20), (std::uint64_t{1} << probe.lanes) - 1);
}

TEST_P(LanesTest, AnyAndAllOfEveryMask) {
    const std::uint32_t masks = 1u << probe.lanes;
    for (std::uint32_t mask = 0; mask < masks; ++mask) {
        const Floats half(16, 0.5f);
        Floats a(16, 1.0f);
        for (std::uint32_t lane = 0; lane < probe.lanes; ++lane)
            if ((mask >> lane & 1u) != 0) a[lane] = 0;
        bool any = false, all = false;
        probe.any_all(a.data(), half.data(), any, all);
        ASSERT_EQ(any, mask != 0);
        ASSERT_EQ(all, mask == masks - 1);
    }
}

TEST_P(LanesTest, LoadsAndStoresAnywhere) {
    const Floats from = numbers(1);
    for (std::size_t offset = 0; offset < 17; ++offset) {
        Floats to(64, 42.0f);
        probe.load_store(from.data() + 1000 + offset, to.data() + 16 + offset);
        for (std::size_t i = 0; i < to.size(); ++i) {
            const bool written = i >= 16 + offset && i < 16 + offset + probe.lanes;
            EXPECT_EQ(to[i], written ? from[1000 + i - 16] : 42.0f);
        }
    }
}

// In register or from memory, whichever the size of the table suggests: all sizes about a vector's, and all indices.
TEST_P(LanesTest, LookupIsGather) {
    Numbers random(9);
    for (std::uint32_t size = 1; size <= 40; ++size) {
        Floats table(size + kernels::widest,
                     nan);  // readable behind the end, but never to be seen
        Words word_table(size + kernels::widest, 0xDEADBEEFu);
        for (std::uint32_t k = 0; k < size; ++k) table[k] = static_cast<float>(k) + 0.5f, word_table[k] = ~k;
        Words index(256);
        for (std::uint32_t i = 0; i < 256; ++i) index[i] = i < 2 * size ? i % size : random.below(size);
        Floats gathered(256), looked_up(256);
        Words gathered_words(256), looked_up_words(256);
        probe.gather(table.data(), index.data(), gathered.data(), 256);
        probe.lookup(table.data(), size, index.data(), looked_up.data(), 256);
        probe.gather_words(word_table.data(), index.data(), gathered_words.data(), 256);
        probe.lookup_words(word_table.data(), size, index.data(), looked_up_words.data(), 256);
        for (std::uint32_t i = 0; i < 256; ++i) {
            EXPECT_EQ(gathered[i], static_cast<float>(index[i]) + 0.5f) << "size " << size;
            EXPECT_EQ(looked_up[i], static_cast<float>(index[i]) + 0.5f) << "size " << size;
            EXPECT_EQ(gathered_words[i], ~index[i]) << "size " << size;
            EXPECT_EQ(looked_up_words[i], ~index[i]) << "size " << size;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, LanesTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
