// Seeds: the same one gives the same image, any other an independent one.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

/// Every pixel has the same expectation and is noisy: a ball of albedo 1/2 from inside, under roulette.
Scene noise(std::uint32_t seed) {
    Scene scene = picture({0, 0, 0}, {0, 0, 1}, 100, 30);
    add_lamp(scene, {0, 0, 0}, 1, dvec3{1}, diffuse(dvec3{0.5}));
    scene.settings.transport = Transport::naive;
    scene.settings.estimator = Estimator::uniform;
    scene.settings.width = scene.settings.height = 128;
    scene.settings.samples = 1;
    scene.settings.seed = seed;
    return scene;
}

std::vector<double> residuals(const Image& image) {
    double mean = 0;
    for (const Rgb& p : image.pixels) mean += p.r;
    mean /= static_cast<double>(image.pixels.size());
    std::vector<double> result;
    for (const Rgb& p : image.pixels) result.push_back(p.r - mean);
    return result;
}

/// Correlation of a[i] with b[i + shift], in standard errors: nearly standard normal if they are independent.
double correlation(const std::vector<double>& a, const std::vector<double>& b, std::size_t shift = 0) {
    double ab = 0, aa = 0, bb = 0;
    const std::size_t count = a.size() - shift;
    for (std::size_t i = 0; i < count; ++i) {
        ab += a[i] * b[i + shift];
        aa += a[i] * a[i];
        bb += b[i + shift] * b[i + shift];
    }
    return ab / std::sqrt(aa * bb) * std::sqrt(static_cast<double>(count));
}

/// On about fifty correlations: 1e-3 in all.
constexpr double threshold = 4.3;

TEST(Seed, MakesTheImage) {
    for (const Integrator integrator : all_integrators) {
        Scene scene = everything(integrator);
        const Image first = image_of(scene);
        EXPECT_EQ(image_of(scene).pixels, first.pixels);
        scene.settings.seed = 1;
        EXPECT_NE(image_of(scene).pixels, first.pixels);
    }
}

TEST(Seed, NextToAnotherGivesAnIndependentImage) {
    for (const std::uint32_t seed : {0u, 1u, 2u, 1000u, 0x7fffffffu, 0xfffffffeu, 0xffffffffu}) {
        const auto image = residuals(image_of(noise(seed)));
        for (const std::uint32_t step : {1u, 2u, 16u, 65536u}) {
            EXPECT_LE(std::abs(correlation(image, residuals(image_of(noise(seed + step))))), threshold)
                << "seeds " << seed << " and " << seed + step;
        }
    }
}

// Block-wise error bars rest on this.
TEST(Pixels, AreIndependentOfTheirNeighbours) {
    for (const std::uint32_t seed : {0u, 1u, 77u}) {
        const auto image = residuals(image_of(noise(seed)));
        for (const std::size_t shift : {1u, 2u, 16u, 127u, 128u, 129u})
            EXPECT_LE(std::abs(correlation(image, image, shift)), threshold) << "seed " << seed << ", " << shift;
    }
}

// Samples of a pixel: the mean of n of them varies n times less than one.
TEST(Samples, AreIndependentOfEachOther) {
    const auto variance = [](std::uint32_t samples) {
        Scene scene = noise(3);
        scene.settings.samples = samples;
        double sum = 0;
        const auto all = residuals(image_of(scene));
        for (const double r : all) sum += r * r;
        return sum / static_cast<double>(all.size() - 1);
    };
    const double one = variance(1);
    for (const std::uint32_t samples : {2u, 4u, 16u, 64u})
        EXPECT_NEAR(variance(samples) * samples / one, 1, 0.06) << samples;
}

// The error bars of agreement.hpp hold what they promise: the scatter between seeds is the scatter around the truth.
TEST(Seed, ScattersAsMuchAsTheErrorBarSays) {
    double squares = 0;
    constexpr int groups = 40;
    for (std::uint32_t group = 0; group < groups; ++group) {
        std::array<Image, 4> images;
        for (std::uint32_t i = 0; i < images.size(); ++i) {
            Scene scene = noise(100 + 4 * group + i);
            scene.settings.width = scene.settings.height = 32;
            images[i] = image_of(scene);
        }
        const auto mean = statistics::blocks_over_seeds(images, 32).blocks[0][0];
        squares += std::pow((mean.mean - 2) / mean.standard_error(), 2);
    }
    // Chi-square of 40 degrees: a mean of 1 with a standard deviation of sqrt(2 / 40).
    EXPECT_NEAR(squares / groups, 1, 4.5 * std::sqrt(2.0 / groups));
}

}  // namespace
}  // namespace orrery::test
