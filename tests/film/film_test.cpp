#include "film/film.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace orrery {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float largest = std::numeric_limits<float>::max();

TEST(Film, IsBlackWithoutSamples) {
    const Image image = Film(3, 2).mean();
    EXPECT_EQ(image.width, 3u);
    EXPECT_EQ(image.height, 2u);
    EXPECT_EQ(image.pixels, std::vector<Rgb>(6));
}

TEST(Film, MeansEachPixelByItsOwnNumberOfSamples) {
    Film film(2, 2);
    EXPECT_TRUE(film.add(1, 1, 2, 3));
    EXPECT_TRUE(film.add(1, 3, 4, 8));
    EXPECT_TRUE(film.add(2, 0.25f, 0, 7));
    const Image image = film.mean();
    EXPECT_EQ(image.at(0, 0), Rgb{});
    EXPECT_EQ(image.at(1, 0), (Rgb{2, 3, 5.5f}));
    EXPECT_EQ(image.at(0, 1), (Rgb{0.25f, 0, 7}));
    EXPECT_EQ(film.samples(0), 0u);
    EXPECT_EQ(film.samples(1), 2u);
    EXPECT_EQ(film.samples(2), 1u);
}

// A float sum of these stops growing at 2^24 samples of 1; in double 24 bits of sample times 2^26 is exact.
TEST(Film, SumsManyEqualSamplesExactly) {
    constexpr std::uint64_t count = std::uint64_t{1} << 26;
    const Rgb sample{0.1f, 1.0f, 16777215.0f / 3.0f};
    Film film(1, 1);
    for (std::uint64_t i = 0; i < count; ++i) film.add(0, sample.r, sample.g, sample.b);
    EXPECT_EQ(film.samples(0), count);
    EXPECT_EQ(film.mean().at(0, 0), sample);
}

TEST(Film, DropsASampleOfWhichAnyChannelIsNotFinite) {
    Film film(1, 1);
    for (const float bad : {inf, -inf, nan}) {
        EXPECT_FALSE(film.add(0, bad, 1, 1));
        EXPECT_FALSE(film.add(0, 1, bad, 1));
        EXPECT_FALSE(film.add(0, 1, 1, bad));
        EXPECT_FALSE(film.add(0, bad, bad, bad));
    }
    EXPECT_FALSE(film.add(0, inf, -inf, 0));
    EXPECT_EQ(film.samples(0), 0u);
    EXPECT_TRUE(film.add(0, 1, 2, 3));
    EXPECT_EQ(film.mean().at(0, 0), (Rgb{1, 2, 3}));
}

TEST(Film, KeepsTheLargestAndTheSmallestFiniteSamples) {
    constexpr float smallest = std::numeric_limits<float>::denorm_min();
    Film film(1, 1);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(film.add(0, largest, largest, smallest));
    EXPECT_EQ(film.mean().at(0, 0), (Rgb{largest, largest, smallest}));
}

}  // namespace
}  // namespace orrery
