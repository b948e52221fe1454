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
        Image errors = image;
        for (std::size_t pixel = 0; pixel < film.pixels(); ++pixel)
            errors.pixels[pixel] = standard_error(film.estimate(pixel));
        ErrorSums sums;
        double squares = 0;
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                sums.add(film.estimate(y * side + x), surroundings(image, errors, x, y));
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
        EXPECT_GE(covered(trial, 400, samples, false), 380 - 16) << samples;
        EXPECT_LE(covered(trial, 400, samples, false), 398) << samples;
        EXPECT_GE(covered(trial, 400, samples, true), 380 - 16) << samples;  // the truth is in doubt: it is wider
    }
}

// A single contrast a pixel, of two numbers that are one of two: the lightest tails that there are, from which the
// interval must still know how much it may be off. A normal law's kurtosis would hold 369.
TEST(Interval, HoldsTheErrorMadeByOneOfTwo) {
    const Trial trial{1, [](Generator& g) { return (g() & 1u) != 0 ? 1.5f : 0.5f; }};
    EXPECT_GE(covered(trial, 400, 2, false), 380 - 13);
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
    sums.add({{1, 2, 3}, {0, 0, 0}, {}, 4}, {});
    EXPECT_EQ(sums.error().relative.value, 0);
    EXPECT_EQ(sums.error().absolute.high, 0);
    sums.add({{1, 2, 3}, {unknown, unknown, unknown}, {}, 0}, {});
    EXPECT_EQ(sums.error().relative.value, unknown);
    EXPECT_EQ(sums.error().absolute.high, unknown);
}

/// Pixels around that are all alike and without error.
Surroundings known(const Rgb64& mean) { return {mean, {}, {}, 8}; }

TEST(ImageError, IsTheRootOfTheMeanSquareOverPixelsAndChannels) {
    ErrorSums one, other;
    for (int i = 0; i < 16; ++i) {
        one.add({{1, 0, 3}, {0.04, 0.01, 0.09}, {}, 100}, known({1, 0, 3}));
        other.add({{2, 2, 2}, {0, 0, 0}, {}, 100}, known({2, 2, 2}));
    }
    one.add(other);
    const ImageError error = one.error();
    EXPECT_DOUBLE_EQ(error.absolute.value, std::sqrt((0.04 + 0.01 + 0.09) / 6));
    EXPECT_DOUBLE_EQ(error.relative.value, std::sqrt((0.04 / 1.01 + 0.01 / 0.01 + 0.09 / 9.01) / 6));
    EXPECT_NEAR(error.absolute.high / error.absolute.value, error.absolute.value / error.absolute.low, 1e-12);
}

// One bright sample of 100 made the pixel what it is; how bright it should be, its dark surroundings tell.
TEST(RelativeError, OfAFireflyIsMeasuredAgainstWhatIsAround) {
    ErrorSums sums;
    sums.add({{5, 5, 5}, {25, 25, 25}, {5, 5, 5}, 50}, known({0.2, 0.2, 0.2}));
    EXPECT_DOUBLE_EQ(sums.error().relative.value, std::sqrt(25 / (0.04 + 0.01)));
}

TEST(RelativeError, OfAPixelAtAnEdgeIsMeasuredAgainstItself) {
    ErrorSums sums;
    sums.add({{5, 5, 5}, {0.01, 0.01, 0.01}, {}, 50}, known({0.2, 0.2, 0.2}));
    EXPECT_NEAR(sums.error().relative.value, 0.1 / 5, 1e-4);
}

/// Mean over pixels, of which none knows anything of another, of the squared relative error stated, over that made:
/// each has met k bright samples of `size` (its share of the pixel's mean), k by Poisson's law with the mean
/// `expected`, on top of a `base` without noise.
double stated_over_made(double expected, double size, double base) {
    double stated = 0, chance = std::exp(-expected);
    for (int k = 0; k < 200; chance *= expected / ++k) {
        const double mean = base + k * size, variance = k * size * size;
        ErrorSums sums;
        sums.add({{mean, mean, mean}, {variance, variance, variance}, {size, size, size}, 1e9}, {});
        stated += chance * sums.relative.sum();
    }
    const double truth = base + expected * size;
    return stated / (expected * size * size / (truth * truth + relative_floor));
}

// Over the mean itself instead of the truth it would be 1.29, 1.17, 1.14, 1.03 and 1.04.
TEST(RelativeError, IsRightOnAverageThoughTheTruthIsNotKnown) {
    EXPECT_NEAR(stated_over_made(4, 1, 0), 1, 0.03);
    EXPECT_NEAR(stated_over_made(8, 1, 0), 1, 0.03);
    EXPECT_NEAR(stated_over_made(8, 0.1, 0), 1, 0.04);
    EXPECT_NEAR(stated_over_made(8, 1, 2), 1, 0.02);
    EXPECT_NEAR(stated_over_made(30, 1, 0), 1, 0.004);
}

TEST(Interval, IsWiderWhereTheTruthIsInDoubt) {
    const auto width = [](double mean) {
        ErrorSums sums;
        for (int i = 0; i < 100000; ++i) sums.add({{mean, mean, mean}, {1, 1, 1}, {}, 50}, known({mean, mean, mean}));
        const RootMeanSquare error = sums.error().relative;
        return error.high / error.low;
    };
    EXPECT_LT(width(100), 1.02);
    EXPECT_GT(width(2), 1.2);
}

TEST(Surroundings, LeaveOutThePixelAndWhatIsBeyondTheBorder) {
    Image image{4, 3, std::vector<Rgb>(12)}, errors = image;
    for (std::size_t i = 0; i < 12; ++i) image.pixels[i] = {static_cast<float>(i), static_cast<float>(i * i), 1e30f};
    EXPECT_DOUBLE_EQ(surroundings(image, errors, 1, 1).mean.r, (0 + 1 + 2 + 4 + 6 + 8 + 9 + 10) / 8.0);
    EXPECT_DOUBLE_EQ(surroundings(image, errors, 2, 1).mean.g, (1 + 4 + 9 + 25 + 49 + 81 + 100 + 121) / 8.0);
    EXPECT_DOUBLE_EQ(surroundings(image, errors, 0, 0).mean.r, (1 + 4 + 5) / 3.0);
    EXPECT_DOUBLE_EQ(surroundings(image, errors, 3, 2).mean.r, (6 + 7 + 10) / 3.0);
    EXPECT_DOUBLE_EQ(surroundings(image, errors, 1, 2).mean.r, (4 + 5 + 6 + 8 + 10) / 5.0);
    EXPECT_EQ(surroundings({1, 1, {{1, 2, 3}}}, {1, 1, {{0, 0, 0}}}, 0, 0).count, 0u);
}

// 0 and 4 to both sides of an edge, four of each, known to 1, 1 and 2 in the channels.
TEST(Surroundings, TellWhatTheirErrorsDoNotExplain) {
    Image image{3, 3, std::vector<Rgb>(9)}, errors = image;
    for (std::size_t i = 0; i < 9; ++i) {
        const float value = i < 4 ? 0.0f : 4.0f;
        image.pixels[i] = {value, value, value};
        errors.pixels[i] = {1, 1, 2};
    }
    image.pixels[4] = errors.pixels[4] = {1e30f, 1e30f, 1e30f};
    const Surroundings around = surroundings(image, errors, 1, 1);
    EXPECT_EQ(around.count, 8u);
    EXPECT_EQ(around.mean.g, 2);
    EXPECT_EQ(around.variance.b, 0.5);
    EXPECT_DOUBLE_EQ(around.scatter.r, 32.0 / 7 - 1);
    EXPECT_DOUBLE_EQ(around.scatter.b, 32.0 / 7 - 4);
    errors.pixels[0].r = std::numeric_limits<float>::infinity();
    EXPECT_EQ(surroundings(image, errors, 1, 1).count, 7u);
}

TEST(StandardError, IsTheRootOfTheVariance) {
    EXPECT_EQ(standard_error({{}, {4, 0, unknown}, {}, 1}), (Rgb{2, 0, std::numeric_limits<float>::infinity()}));
}

}  // namespace
}  // namespace orrery
