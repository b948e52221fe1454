// Figures of a comparison: by hand, by order statistics, and in an experiment with known noise.
#include "image/compare.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace orrery {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

const Image by_hand_a{2, 1, {{1, 2, 3}, {0, 0, 0}}};
const Image by_hand_b{2, 1, {{1, 1, 1}, {0.5f, 0, 0}}};

Image filled(std::uint32_t width, std::uint32_t height, const Rgb& pixel) {
    return {width, height, std::vector<Rgb>(std::size_t{width} * height, pixel)};
}

TEST(Compare, FiguresByHand) {
    const Comparison c = compare(by_hand_a, by_hand_b);
    EXPECT_EQ(c.pixels, 2u);
    EXPECT_DOUBLE_EQ(c.mse, 5.25 / 6);
    EXPECT_DOUBLE_EQ(c.rmse, std::sqrt(0.875));
    EXPECT_DOUBLE_EQ(c.mrse, (1 / 1.01 + 4 / 1.01 + 0.25 / 0.26) / 6);
    EXPECT_EQ(c.largest, 2);
    EXPECT_EQ(c.percentile, 2);
    EXPECT_DOUBLE_EQ(c.mean_difference, 2.5 / 6);
    EXPECT_DOUBLE_EQ(c.channel_difference[0], -0.25);
    EXPECT_DOUBLE_EQ(c.channel_difference[1], 0.5);
    EXPECT_DOUBLE_EQ(c.channel_difference[2], 1);
    EXPECT_FALSE(c.significance.has_value());
}

TEST(Compare, TheSecondImageIsTheReference) {
    const Comparison c = compare(by_hand_b, by_hand_a);
    EXPECT_DOUBLE_EQ(c.mse, 5.25 / 6);
    EXPECT_DOUBLE_EQ(c.mrse, (1 / 4.01 + 4 / 9.01 + 0.25 / 0.01) / 6);
    EXPECT_DOUBLE_EQ(c.mean_difference, -2.5 / 6);
}

TEST(Compare, SignificanceByHand) {
    const Image errors{2, 1, {{0.3f, 0.5f, 0}, {0.4f, 0, 0}}};
    const auto significance = compare(by_hand_a, by_hand_b, &errors).significance;
    ASSERT_TRUE(significance.has_value());
    EXPECT_NEAR(significance->channel_error[0], 0.25, 1e-8);
    EXPECT_NEAR(significance->channel_error[1], 0.25, 1e-8);
    EXPECT_NEAR(significance->channel_z[0], -1, 1e-7);
    EXPECT_NEAR(significance->channel_z[1], 2, 1e-7);
    EXPECT_EQ(significance->channel_z[2], infinity) << "different, and no noise to explain it";
    EXPECT_NEAR(significance->error, 0.5 / 3, 1e-8);
    EXPECT_NEAR(significance->z, 2.5, 1e-6);

    const auto both = compare(by_hand_a, by_hand_b, &errors, &errors).significance;
    EXPECT_NEAR(both->channel_error[0], 0.25 * std::sqrt(2), 1e-8);
    EXPECT_EQ(compare(by_hand_a, by_hand_a, &errors).significance->z, 0);
    const Image none = filled(2, 1, {0, 0, 0});
    EXPECT_EQ(compare(by_hand_a, by_hand_a, nullptr, &none).significance->z, 0);
}

TEST(Compare, EqualImagesDifferInNothing) {
    const Comparison c = compare(by_hand_a, by_hand_a);
    for (const double figure : {c.mse, c.rmse, c.mrse, c.largest, c.percentile, c.mean_difference})
        EXPECT_EQ(figure, 0);
}

TEST(Compare, LargestErrorNamesItsPixel) {
    Image a = filled(7, 5, {1, 1, 1});
    const Image b = a;
    a.at(3, 4).g = 0.5f;
    a.at(6, 2).b = 3.25f;
    a.at(5, 4).r = 3.25f;  // as large, but later
    const Comparison c = compare(a, b);
    EXPECT_EQ(c.largest, 2.25);
    EXPECT_EQ(c.largest_x, 6u);
    EXPECT_EQ(c.largest_y, 2u);
}

/// Errors 1, 2, ... 3n in a scrambled order: the nearest rank is ceil(0.999 * 3n).
TEST(Compare, PercentileIsTheNearestRank) {
    const auto percentile = [](std::uint32_t n) {
        std::vector<float> errors;
        for (std::uint32_t i = 1; i <= 3 * n; ++i) errors.push_back(static_cast<float>(i));
        std::shuffle(errors.begin(), errors.end(), std::mt19937(1));
        Image a = filled(n, 1, {0, 0, 0});
        for (std::uint32_t i = 0; i < n; ++i) a.at(i, 0) = {errors[3 * i], -errors[3 * i + 1], errors[3 * i + 2]};
        return compare(a, filled(n, 1, {0, 0, 0})).percentile;
    };
    EXPECT_EQ(percentile(1), 3);
    EXPECT_EQ(percentile(333), 999);
    EXPECT_EQ(percentile(334), 1001);
    EXPECT_EQ(percentile(1000), 2997);
    EXPECT_EQ(percentile(2001), 5997);
}

TEST(Compare, PixelsThatAreNotFiniteAreCountedAndLeftOut) {
    Image a = filled(4, 2, {1, 1, 1}), b = filled(4, 2, {1, 1, 1});
    a.at(0, 0).g = nan;
    a.at(1, 0) = {infinity, infinity, nan};
    b.at(1, 0).r = -infinity;
    b.at(2, 1).b = nan;
    a.at(3, 1).r = 2;
    const Comparison c = compare(a, b);
    EXPECT_EQ(c.not_finite_a, 2u);
    EXPECT_EQ(c.not_finite_b, 2u);
    EXPECT_EQ(c.pixels, 5u);
    EXPECT_DOUBLE_EQ(c.mse, 1 / 15.0);

    for (const Rgb& no_error : {Rgb{-1, 0, 0}, Rgb{0, -1, 0}, Rgb{0, 0, -1}, Rgb{0, infinity, 0}}) {
        Image errors = filled(4, 2, {0.1f, 0.1f, 0.1f});
        errors.at(3, 0).g = nan;
        errors.at(3, 1) = no_error;
        const Comparison with_errors = compare(a, b, &errors);
        EXPECT_EQ(with_errors.without_error, 2u);
        EXPECT_EQ(with_errors.pixels, 3u);
        EXPECT_EQ(with_errors.mse, 0);
    }
}

TEST(Compare, WhatCannotBeComparedIsRefused) {
    const Image small = filled(2, 2, {0, 0, 0}), wide = filled(4, 1, {0, 0, 0});
    EXPECT_THROW(compare(small, wide), std::invalid_argument);
    EXPECT_THROW(compare(small, small, &wide), std::invalid_argument);
    EXPECT_THROW(compare(small, small, nullptr, &wide), std::invalid_argument);
    EXPECT_THROW(compare(small, filled(2, 2, {nan, 0, 0})), std::invalid_argument);
    EXPECT_THROW(difference(small, wide), std::invalid_argument);
}

TEST(Compare, HugeAndTinyValuesKeepTheirFigures) {
    constexpr float huge = 3e38f, tiny = 1e-38f;
    EXPECT_DOUBLE_EQ(compare(filled(3, 3, {huge, huge, huge}), filled(3, 3, {0, 0, 0})).rmse, double{huge});
    EXPECT_DOUBLE_EQ(compare(filled(3, 3, {tiny, tiny, tiny}), filled(3, 3, {0, 0, 0})).rmse, double{tiny});
}

/// Half grey under normal noise of known deviation.
Image noisy(std::uint32_t side, double sigma, std::mt19937& random) {
    std::normal_distribution<double> noise(0.5, sigma);
    Image image = filled(side, side, {0, 0, 0});
    for (Rgb& pixel : image.pixels)
        for (float* channel : {&pixel.r, &pixel.g, &pixel.b}) *channel = static_cast<float>(noise(random));
    return image;
}

TEST(Compare, KnownNoiseIsMeasured) {
    constexpr double sigma = 0.1;
    constexpr double values = 3.0 * 400 * 400;
    std::mt19937 random(5);
    const Comparison c = compare(noisy(400, sigma, random), filled(400, 400, {0.5f, 0.5f, 0.5f}));
    // Five standard errors each. The square of a normal has variance 2 sigma^4; the quantile q of |N| at 0.999 is
    // 3.2905, where the density of |N| is 2 phi(q) = 0.003554.
    EXPECT_NEAR(c.mse, sigma * sigma, 5 * sigma * sigma * std::sqrt(2 / values));
    EXPECT_NEAR(c.mrse, c.mse / 0.26, 1e-12);
    EXPECT_NEAR(c.percentile, 3.2905 * sigma, 5 * sigma * std::sqrt(0.001 * 0.999 / values) / 0.003554);
    EXPECT_NEAR(c.mean_difference, 0, 5 * sigma / std::sqrt(values));
}

/// Two noisy images of one world: z is standard normal by channel, and smaller together, as channels are independent
/// here. Another world is found out.
TEST(Compare, ZTellsNoiseFromDifference) {
    constexpr int trials = 2000;
    constexpr std::uint32_t side = 16;
    const Image error_a = filled(side, side, {0.1f, 0.1f, 0.1f}), error_b = filled(side, side, {0.3f, 0.3f, 0.3f});
    std::mt19937 random(6);
    double sum = 0, squares = 0, together = 0;
    for (int i = 0; i < trials; ++i) {
        const Image a = noisy(side, 0.1, random), b = noisy(side, 0.3, random);
        const auto s = *compare(a, b, &error_a, &error_b).significance;
        sum += s.channel_z[i % 3];
        squares += s.channel_z[i % 3] * s.channel_z[i % 3];
        together += s.z * s.z;
    }
    EXPECT_NEAR(sum / trials, 0, 5 * std::sqrt(1.0 / trials));
    EXPECT_NEAR(squares / trials, 1, 5 * std::sqrt(2.0 / trials));
    EXPECT_NEAR(together / trials, 1 / 3.0, 5 * std::sqrt(2.0 / trials) / 3);

    Image brighter = noisy(side, 0.1, random);
    for (Rgb& pixel : brighter.pixels) pixel.g += 0.2f;
    const auto s = *compare(brighter, noisy(side, 0.3, random), &error_a, &error_b).significance;
    EXPECT_GT(s.channel_z[1], 5);
    EXPECT_LT(std::abs(s.channel_z[0]), 5);
}

TEST(Difference, IsSignedOrVisible) {
    const Image d = difference(by_hand_a, by_hand_b);
    EXPECT_EQ(d.pixels, (std::vector<Rgb>{{0, 1, 2}, {-0.5f, 0, 0}}));
    EXPECT_EQ(visible_difference(by_hand_a, by_hand_b, 1).pixels, (std::vector<Rgb>{{0, 1, 1}, {0.5f, 0, 0}}));
    EXPECT_EQ(visible_difference(by_hand_a, by_hand_b, 4).pixels, (std::vector<Rgb>{{0, 0.25f, 0.5f}, {0.125f, 0, 0}}));
    EXPECT_EQ(visible_difference(by_hand_a, by_hand_a, 0).pixels, filled(2, 1, {0, 0, 0}).pixels);
    EXPECT_EQ(visible_difference({1, 1, {{nan, infinity, 1}}}, {1, 1, {{0, 0, 0}}}, 1).pixels[0], (Rgb{0, 0, 1}));
}

}  // namespace
}  // namespace orrery
