// Random numbers: the same bits everywhere, uniform, and no relation between neighbours in any coordinate.
#include <array>

#include "fit.hpp"
#include "kernel_test.hpp"
#include "probe/lane_probe.hpp"
#include "random_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::Dimension;
using kernels::RandomKey;
using Words = std::vector<std::uint32_t>;
using Blocks = std::array<std::vector<float>, 4>;

class RandomTest : public KernelTest {
protected:
    const LaneProbe<float>& probe = lane_probe<float>(GetParam());

    Blocks draw(const RandomKey& key, const Words& pixel, const Words& sample, const Words& vertex) const {
        Blocks out;
        float* to[4];
        for (std::size_t c = 0; c < 4; ++c) out[c].resize(pixel.size()), to[c] = out[c].data();
        probe.random_block(key, pixel.data(), sample.data(), vertex.data(), to,
                           static_cast<std::uint32_t>(pixel.size()));
        return out;
    }
};

// Computed outside this program, with integers of any length.
TEST(RandomReference, KnownVectors) {
    using Vector = std::array<std::uint32_t, 4>;
    EXPECT_EQ(pcg4d_reference({0, 0, 0, 0}), (Vector{0x0F02F829u, 0x2D568769u, 0x32B0C43Bu, 0xD32548EAu}));
    EXPECT_EQ(pcg4d_reference({1, 2, 3, 4}), (Vector{0x3622CD16u, 0xF11471D8u, 0xE1109B3Fu, 0x02B94C2Fu}));
    EXPECT_EQ(pcg4d_reference({0xFFFFFFFFu, 0xFFFFFFFFu, 0xFFFFFFFFu, 0xFFFFFFFFu}),
              (Vector{0x974ED892u, 0xC015DC67u, 0x9F955760u, 0xA1BBA208u}));
}

// SSE2 included: these are integers.
TEST_P(RandomTest, Pcg4dEqualsTheReferenceToTheBit) {
    constexpr std::uint32_t n = 4096;
    std::array<Words, 4> counters, out;
    const std::uint32_t* from[4];
    std::uint32_t* to[4];
    for (std::size_t c = 0; c < 4; ++c) {
        counters[c].resize(n), out[c].resize(n);
        from[c] = counters[c].data(), to[c] = out[c].data();
        for (std::uint32_t i = 0; i < n; ++i)  // small counters as a renderer has them, then anything
            counters[c][i] = i < n / 2 ? (i >> 3 * c & 7u) : pcg4d_reference({i, 9, 9, 9})[c];
    }
    for (std::size_t c = 0; c < 4; ++c) counters[c][0] = 0, counters[c][1] = 0xFFFFFFFFu;
    probe.pcg4d(from, to, n);
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto wanted = pcg4d_reference({counters[0][i], counters[1][i], counters[2][i], counters[3][i]});
        for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(out[c][i], wanted[c]) << "item " << i << ", word " << c;
    }
}

TEST_P(RandomTest, BlocksAreKeyedAsDocumented) {
    constexpr std::uint32_t n = 64;
    Words pixel(n), sample(n), vertex(n);
    for (std::uint32_t i = 0; i < n; ++i) pixel[i] = i * 977, sample[i] = i % 5, vertex[i] = i / 9;
    for (const std::uint32_t seed : {0u, 1u, 0xFFFFFFFFu}) {
        for (const auto& [key, block] : {std::pair{RandomKey{seed, Dimension::camera, 0}, 0u},
                                         {RandomKey{seed, Dimension::scattering, 0}, 1u},
                                         {RandomKey{seed, Dimension::roulette, 0}, 2u},
                                         {RandomKey{seed, Dimension::light, 0}, 3u},
                                         {RandomKey{seed, Dimension::light, 7}, 10u}}) {
            const Blocks out = draw(key, pixel, sample, vertex);
            for (std::uint32_t i = 0; i < n; ++i) {
                const auto wanted = random_reference(seed, block, pixel[i], sample[i], vertex[i]);
                for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(static_cast<double>(out[c][i]), wanted[c]);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, RandomTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

// From here on one instruction set speaks for all: the bits are the same.
class RandomQuality : public RandomTest {
protected:
    static constexpr std::uint32_t side = 512;  // of the image, in pixels
    static constexpr std::uint32_t n = side * side;

    /// One block for every pixel of an image.
    Blocks image(std::uint32_t seed, std::uint32_t block, std::uint32_t sample, std::uint32_t vertex,
                 std::uint32_t pixel_offset = 0) const {
        Words pixel(n), samples(n, sample), vertices(n, vertex);
        for (std::uint32_t i = 0; i < n; ++i) pixel[i] = i + pixel_offset;
        return draw({seed, Dimension::camera, block}, pixel, samples, vertices);
    }
};

TEST_P(RandomQuality, EachWordIsUniformAndEachPairOfWords) {
    for (const std::uint32_t seed : {0u, 1u}) {
        const Blocks u = image(seed, 1, 0, 0);
        for (std::size_t a = 0; a < 4; ++a) {
            Histogram line(1024, 1);
            for (std::uint32_t i = 0; i < n; ++i) line.add(u[a][i], 0);
            line.expect_uniform("word " + std::to_string(a));
            for (std::size_t b = a + 1; b < 4; ++b) {
                Histogram square(32, 32);
                for (std::uint32_t i = 0; i < n; ++i) square.add(u[a][i], u[b][i]);
                square.expect_uniform("words " + std::to_string(a) + " and " + std::to_string(b));
            }
        }
    }
}

// Every coordinate of the counter moved by one step, or by a row of the image: the pair (old, new) must fill the unit
// square evenly, whichever two of the four words form it.
TEST_P(RandomQuality, NeighboursAreUnrelated) {
    const Blocks here = image(0, 1, 5, 2);
    const std::pair<const char*, Blocks> neighbours[] = {
        {"pixel to the right", image(0, 1, 5, 2, 1)}, {"pixel below", image(0, 1, 5, 2, side)},
        {"next sample", image(0, 1, 6, 2)},           {"next bounce", image(0, 1, 5, 3)},
        {"next dimension", image(0, 2, 5, 2)},        {"next seed", image(1, 1, 5, 2)},
    };
    for (const auto& [name, there] : neighbours) {
        for (std::size_t a = 0; a < 4; ++a) {
            for (std::size_t b = 0; b < 4; ++b) {
                Histogram square(32, 32);
                for (std::uint32_t i = 0; i < n; ++i) square.add(here[a][i], there[b][i]);
                square.expect_uniform(std::string(name) + ", words " + std::to_string(a) + " and " + std::to_string(b));
            }
        }
    }
}

// The numbers of one pixel, sample after sample: what its estimate is made of.
TEST_P(RandomQuality, SamplesOfOnePixelAreUniform) {
    for (const std::uint32_t pixel_number : {0u, 1u, 123456u}) {
        Words pixel(n, pixel_number), samples(n), vertices(n, 0);
        for (std::uint32_t i = 0; i < n; ++i) samples[i] = i;
        const Blocks u = draw({0, Dimension::camera, 0}, pixel, samples, vertices);
        Histogram plane(32, 32), lens(32, 32), serial(32, 32);
        for (std::uint32_t i = 0; i < n; ++i) plane.add(u[0][i], u[1][i]), lens.add(u[2][i], u[3][i]);
        for (std::uint32_t i = 0; i + 1 < n; i += 2) serial.add(u[0][i], u[0][i + 1]);
        plane.expect_uniform("image plane");
        lens.expect_uniform("lens");
        serial.expect_uniform("consecutive samples");
    }
}

INSTANTIATE_TEST_SUITE_P(Best, RandomQuality, ::testing::Values(best_isa()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
