// An image's error and its interval, against images whose truth is known.
#include "film/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "film/contrasts.hpp"

namespace orrery {
namespace {

using Generator = std::mt19937;

struct Trial {
    double truth;  ///< of every pixel
    std::function<float(Generator&)> sample;
};

/// How many of `images` have the error they really have inside the interval they state.
int covered(const Trial& trial, int images, std::uint32_t samples, bool relative) {
    constexpr std::uint32_t side = 12;
    int inside = 0;
    Generator generator(17);
    for (int i = 0; i < images; ++i) {
        Film film(side, side);
        Contrasts contrasts;
        contrasts.begin(1, true);
        std::vector<float> rgbx(4 * samples);
        for (std::size_t pixel = 0; pixel < film.pixels(); ++pixel) {
            for (std::size_t s = 0; s < samples; ++s) {
                const float value = trial.sample(generator);
                rgbx[4 * s] = rgbx[4 * s + 1] = rgbx[4 * s + 2] = value;
            }
            film.add(pixel, rgbx.data(), samples);
            contrasts.add(film, pixel, rgbx.data(), samples);
        }
        const Image image = film.mean();
        ErrorSums sums;
        double squares = 0;
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                sums.add(film.estimate(y * side + x), mean_around(image, x, y));
                squares += std::pow(image.at(x, y).r - trial.truth, 2);
            }
        const double weight = relative ? 1 / (trial.truth * trial.truth + relative_floor) : 1;
        const double made = std::sqrt(squares * weight / (side * side));
        const RootMeanSquare stated = relative ? sums.error().relative : sums.error().absolute;
        if (stated.low <= made && made <= stated.high) ++inside;
    }
    return inside;
}

// 95 % of 400 is 380 with a standard deviation of 4.4.
TEST(Interval, HoldsTheErrorMadeByNormalSamples) {
    const Trial trial{1, [](Generator& g) { return std::normal_distribution<float>(1, 0.3f)(g); }};
    for (const std::uint32_t samples : {2u, 8u, 32u}) {
        EXPECT_NEAR(covered(trial, 400, samples, false), 380, 16) << samples;
        EXPECT_NEAR(covered(trial, 400, samples, true), 380, 16) << samples;
    }
}

Trial rare(float chance) {
    return {0.5, [chance](Generator& g) {
                return std::uniform_real_distribution<float>()(g) < chance ? 0.5f / chance : 0.0f;
            }};
}

// The fourth cumulant is 1000 times the normal variance squared, and a handful of events lies in an image. The interval
// may be too wide, it may not be too narrow.
TEST(Interval, HoldsTheErrorMadeByRareBrightSamples) {
    for (const std::uint32_t samples : {32u, 128u})
        EXPECT_GE(covered(rare(1e-3f), 300, samples, false), 270) << samples;
    // What a pixel should be, to be relative to, takes a few events around it to know.
    for (const std::uint32_t samples : {128u, 512u}) EXPECT_GE(covered(rare(0.1f), 300, samples, true), 270) << samples;
}

constexpr double unknown = std::numeric_limits<double>::infinity();

TEST(ImageError, IsZeroWithoutNoiseAndUnknownWithoutContrasts) {
    ErrorSums sums;
    sums.add({{1, 2, 3}, {0, 0, 0}, 4}, {1, 2, 3});
    EXPECT_EQ(sums.error().relative.value, 0);
    EXPECT_EQ(sums.error().absolute.high, 0);
    sums.add({{1, 2, 3}, {unknown, unknown, unknown}, 0}, {1, 2, 3});
    EXPECT_EQ(sums.error().relative.value, unknown);
    EXPECT_EQ(sums.error().absolute.high, unknown);
}

TEST(ImageError, IsTheRootOfTheMeanSquareOverPixelsAndChannels) {
    ErrorSums one, other;
    one.add({{1, 0, 3}, {0.04, 0.01, 0.09}, 100}, {1, 0, 3});
    other.add({{2, 2, 2}, {0, 0, 0}, 100}, {2, 2, 2});
    one.add(other);
    const ImageError error = one.error();
    EXPECT_DOUBLE_EQ(error.absolute.value, std::sqrt((0.04 + 0.01 + 0.09) / 6));
    EXPECT_DOUBLE_EQ(error.relative.value, std::sqrt((0.04 / 1.01 + 0.01 / 0.01 + 0.09 / 9.01) / 6));
    EXPECT_NEAR(error.absolute.high / error.absolute.value, error.absolute.value / error.absolute.low, 1e-12);
}

// One bright sample of 100 made the pixel what it is; how bright it should be, its dark surroundings tell.
TEST(RelativeError, OfAFireflyIsMeasuredAgainstWhatIsAround) {
    ErrorSums sums;
    sums.add({{5, 5, 5}, {25, 25, 25}, 50}, {0.2, 0.2, 0.2});
    EXPECT_DOUBLE_EQ(sums.error().relative.value, std::sqrt(25 / (0.04 + 0.01)));
}

TEST(RelativeError, OfAPixelAtAnEdgeIsMeasuredAgainstItself) {
    ErrorSums sums;
    sums.add({{5, 5, 5}, {0.01, 0.01, 0.01}, 50}, {0.2, 0.2, 0.2});
    EXPECT_NEAR(sums.error().relative.value, 0.1 / 5, 1e-4);
}

TEST(MeanAround, LeavesOutThePixelAndWhatIsBeyondTheBorder) {
    Image image{4, 3, std::vector<Rgb>(12)};
    for (std::size_t i = 0; i < 12; ++i) image.pixels[i] = {static_cast<float>(i), static_cast<float>(i * i), 1e30f};
    EXPECT_EQ(mean_around(image, 1, 1).r, (0 + 1 + 2 + 4 + 6 + 8 + 9 + 10) / 8.0);
    EXPECT_EQ(mean_around(image, 2, 1).g, (1 + 4 + 9 + 25 + 49 + 81 + 100 + 121) / 8.0);
    EXPECT_EQ(mean_around(image, 0, 0).r, (1 + 4 + 5) / 3.0);
    EXPECT_EQ(mean_around(image, 3, 2).r, (6 + 7 + 10) / 3.0);
    EXPECT_EQ(mean_around(image, 1, 2).r, (4 + 5 + 6 + 8 + 10) / 5.0);
    EXPECT_EQ(mean_around({1, 1, {{1, 2, 3}}}, 0, 0).b, 3.0);
}

TEST(StandardError, IsTheRootOfTheVariance) {
    EXPECT_EQ(standard_error({{}, {4, 0, unknown}, 1}), (Rgb{2, 0, std::numeric_limits<float>::infinity()}));
}

}  // namespace
}  // namespace orrery
