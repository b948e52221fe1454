// The comparison itself on trial: how often it cries wolf, and what it cannot miss.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "statistics/compare.hpp"
#include "statistics/distributions.hpp"

namespace orrery::statistics {
namespace {

constexpr std::uint32_t width = 18, height = 16, block_size = 4;  // the last column of blocks is narrow

// What a pixel should be: dark to bright over the image, channels apart.
double truth(std::size_t pixel, std::size_t channel) {
    return 0.2 + 0.01 * static_cast<double>(pixel % width) + 0.3 * static_cast<double>(channel);
}

// K images whose pixels have standard deviation `noise` times their value, and a reference as precise as their mean.
struct Trial {
    BlockImage candidate, reference;

    template <typename Bias>
    Trial(std::mt19937_64& random, std::size_t seeds, double noise, Bias bias) {
        std::normal_distribution<double> normal;
        std::vector<Image> images(seeds, Image{width, height, std::vector<Rgb>(width * height)});
        std::vector<RgbEstimate> pixels(width * height);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            for (Image& image : images) {
                const auto draw = [&](std::size_t channel) {
                    return static_cast<float>(truth(i, channel) * (bias(i) + noise * normal(random)));
                };
                image.pixels[i] = {draw(0), draw(1), draw(2)};
            }
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const double error = truth(i, channel) * noise / std::sqrt(static_cast<double>(seeds));
                pixels[i][channel] = {truth(i, channel) + error * normal(random), error * error};
            }
        }
        candidate = blocks_over_seeds(images, block_size);
        reference = blocks_of_pixels(width, height, pixels, block_size);
    }
};

double unbiased(std::size_t) { return 1; }

TEST(Blocks, CutTheImageAndWeighWhatIsLeftAtTheEdges) {
    std::vector<RgbEstimate> pixels(width * height);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].fill({static_cast<double>(i), 4, 10});
    const BlockImage blocks = blocks_of_pixels(width, height, pixels, block_size);
    ASSERT_EQ(blocks.width(), 5u);
    ASSERT_EQ(blocks.height(), 4u);
    EXPECT_EQ(blocks.area(4, 3), 8);
    EXPECT_DOUBLE_EQ(blocks.at(0, 0)[1].mean, 1.5 * width + 1.5);
    EXPECT_DOUBLE_EQ(blocks.at(4, 0)[1].mean, 1.5 * width + 16.5);
    EXPECT_DOUBLE_EQ(blocks.at(4, 0)[2].variance, 4.0 / 8);
    EXPECT_DOUBLE_EQ(blocks.at(4, 0)[2].degrees, 80);
    EXPECT_DOUBLE_EQ(blocks.mean()[0].mean, (width * height - 1) / 2.0);
    EXPECT_DOUBLE_EQ(blocks.mean()[0].variance, 4.0 / (width * height));
}

TEST(Blocks, ErrorsOverSeedsAreThoseOfTheScatter) {
    std::vector<Image> images(3, Image{2, 1, std::vector<Rgb>(2)});
    for (std::size_t k = 0; k < 3; ++k) images[k].pixels = {{static_cast<float>(k), 1, 0}, {2, 1, 0}};
    const RgbEstimate block = blocks_over_seeds(images, 2).at(0, 0);
    EXPECT_DOUBLE_EQ(block[0].mean, 1.5);
    EXPECT_DOUBLE_EQ(block[0].variance, 1.0 / 3 / 4);  // the left pixel's mean has 1 / 3, the right one's 0
    EXPECT_DOUBLE_EQ(block[0].degrees, 2);
    EXPECT_EQ(block[1].variance, 0);
    EXPECT_THROW(blocks_over_seeds(std::span(images).first(1), 2), std::invalid_argument);
}

TEST(Compare, FalseAlarmsAsOftenAsClaimed) {
    constexpr int repetitions = 1000;
    constexpr double alpha = 0.05;
    std::mt19937_64 random(11);
    int alarms = 0;
    for (int i = 0; i < repetitions; ++i) {
        const Trial trial(random, 8, 0.3, unbiased);
        alarms += !compare(trial.candidate, trial.reference, {.alpha = alpha}).agrees;
    }
    const double frequency = static_cast<double>(alarms) / repetitions;
    RecordProperty("false_alarms", std::to_string(frequency));
    EXPECT_NEAR(frequency, alpha, 4 * std::sqrt(alpha * (1 - alpha) / repetitions));
}

TEST(Compare, OnePercentOfTheWholeIsFound) {
    // 288 pixels, 16 seeds, noise 0.05: the mean is known to 0.07 % on each side, so 1 % is 10 standard errors.
    std::mt19937_64 random(12);
    for (int i = 0; i < 20; ++i) {
        const Trial trial(random, 16, 0.05, [](std::size_t) { return 1.01; });
        const Comparison result = compare(trial.candidate, trial.reference);
        EXPECT_FALSE(result.agrees) << result.message;
        EXPECT_GT(result.global[1].z, result.threshold);
    }
}

TEST(Compare, OneBrightBlockIsFoundAndNamed) {
    // Light moved from one block to its neighbour: no mean of the image shows it.
    const auto moved = [](std::size_t pixel) {
        const std::size_t x = pixel % width, y = pixel / width;
        return y / block_size != 2 ? 1.0 : x / block_size == 1 ? 1.2 : x / block_size == 2 ? 0.8 : 1.0;
    };
    std::mt19937_64 random(13);
    for (int i = 0; i < 20; ++i) {
        const Trial trial(random, 16, 0.05, moved);
        const Comparison result = compare(trial.candidate, trial.reference);
        EXPECT_FALSE(result.agrees);
        EXPECT_EQ(result.worst_y, 2u);
        EXPECT_TRUE(result.worst_x == (result.worst.z > 0 ? 1u : 2u)) << result.message;
        const std::string name = "(" + std::to_string(result.worst_x) + ", 2)";
        EXPECT_NE(result.message.find(name), std::string::npos) << result.message;
    }
}

TEST(Compare, FloatRoundingOfNoiselessValuesIsNoBias) {
    const Estimate exact{0.1, 0};
    EXPECT_EQ(score({0.1f, 0}, exact, 1e-5).z, 0);
    EXPECT_GT(score({0.10001, 0}, exact, 1e-5).z, 37);
    EXPECT_GT(score({1e-6, 0}, {0, 0}, 1e-5).z, 37);
}

TEST(Compare, WhatIsNotFiniteNeverAgrees) {
    const Estimate reference{1, 0.01};
    EXPECT_GT(std::abs(score({std::numeric_limits<double>::quiet_NaN(), 1}, reference, 1e-5).z), 37);
    EXPECT_GT(std::abs(score({std::numeric_limits<double>::infinity(), 1}, reference, 1e-5).z), 37);
}

TEST(Compare, ImagesCutDifferentlyAreRefused) {
    std::mt19937_64 random(14);
    const Trial trial(random, 2, 0.1, unbiased);
    BlockImage other = trial.reference;
    other.block_size = 8;
    EXPECT_THROW(compare(trial.candidate, other), std::invalid_argument);
}

}  // namespace
}  // namespace orrery::statistics
