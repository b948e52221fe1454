// Every render knows its own error: what it says against what a converged render shows.
#include <gtest/gtest.h>

#include <cmath>

#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

struct Case {
    const char* name;
    Scene scene;
};

Scene noisy(Estimator estimator, std::uint32_t size = 16) {
    Scene scene = test::noisy(4, size);
    scene.settings.samples = 16;
    scene.settings.estimator = estimator;
    return scene;
}

Scene whitted() {
    Scene scene = edges(16);
    scene.settings.samples = 16;
    return scene;
}

/// From inside a ball, so that all rays hit: what a first-order error of 1 - I/(1+I) can follow.
Scene distances() {
    Scene scene = still_life(diffuse(dvec3{0.5}), 0);
    add_sphere(scene, {0, 0, 0}, 8, diffuse(dvec3{0.5}));
    scene.settings.integrator = Integrator::depth;
    scene.settings.samples = 16;
    scene.settings.estimator = Estimator::uniform;
    return scene;
}

/// A lamp behind a ball of glass that throws its light on the floor: bright paths that few samples find, next to pixels
/// that none lights. The error of such an image is that of a few dozen of its pixels.
Scene caustic() {
    Scene scene = picture({0, 3, -5}, {0, 0, 0.5}, 30, 5);
    add_sphere(scene, {0, -40, 0}, 40, diffuse({0.8, 0.6, 0.4}));
    add_sphere(scene, {0, 1, 1}, 0.9, glass(0.9, 1.5));
    add_lamp(scene, {0, 3.5, 3}, 0.5, {40, 30, 20}, diffuse(dvec3{0}));
    scene.settings.width = scene.settings.height = 24;
    scene.settings.samples = 256;
    return scene;
}

constexpr std::uint32_t renders = 200;
/// 95 % of 200 is 190 with a standard deviation of 3.1; less than three of them below that, of twelve counts.
constexpr int fewest_inside = 181;

class Coverage : public testing::TestWithParam<int> {};

TEST_P(Coverage, OfTheInterval) {
    const Case cases[] = {{"uniform", noisy(Estimator::uniform)},
                          {"stratified", noisy(Estimator::stratified)},
                          // So large that the few pixels at the lamp's edge are not all the error.
                          {"sobol", noisy(Estimator::sobol, 64)},
                          {"edges", whitted()},
                          {"distances", distances()},
                          {"caustic", caustic()}};
    const Case& c = cases[GetParam()];
    Scene scene = c.scene;
    scene.settings.samples = 16384;
    scene.settings.seed = 12345;
    const Image truth = image_of(scene);
    scene.settings.samples = c.scene.settings.samples;

    int inside = 0, inside_absolute = 0;
    double stated_squares = 0, made_squares = 0;
    for (std::uint32_t seed = 0; seed < renders; ++seed) {
        scene.settings.seed = seed;
        const RenderResult result = render(scene);
        double absolute = 0, relative = 0;
        for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
            const Rgb &value = result.image.pixels[i], &true_value = truth.pixels[i];
            for (const auto& [v, t] :
                 {std::pair{value.r, true_value.r}, {value.g, true_value.g}, {value.b, true_value.b}}) {
                const double square = std::pow(double{v} - t, 2);
                absolute += square;
                relative += square / (double{t} * t + 0.01);
            }
        }
        const double numbers = 3.0 * static_cast<double>(truth.pixels.size());
        absolute = std::sqrt(absolute / numbers);
        relative = std::sqrt(relative / numbers);
        const auto& [stated, stated_absolute] = result.stats.error;
        inside += stated.low <= relative && relative <= stated.high ? 1 : 0;
        inside_absolute += stated_absolute.low <= absolute && absolute <= stated_absolute.high ? 1 : 0;
        stated_squares += stated_absolute.value * stated_absolute.value;
        made_squares += absolute * absolute;
    }
    RecordProperty("inside", inside);
    RecordProperty("inside_absolute", inside_absolute);
    RecordProperty("made_over_stated", std::to_string(std::sqrt(made_squares / stated_squares)));
    for (const int count : {inside, inside_absolute}) {
        EXPECT_GE(count, fewest_inside) << c.name << ": " << inside << ", " << inside_absolute;
    }
    EXPECT_NEAR(std::sqrt(made_squares / stated_squares), 1, 0.15) << c.name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Coverage, testing::Range(0, 6));

TEST(StandardError, IsTheSameForAnyWaveSizeAndNumberOfThreads) {
    for (const Estimator estimator : {Estimator::uniform, Estimator::stratified, Estimator::sobol}) {
        Scene scene = noisy(estimator);
        scene.settings.samples = 25;
        const auto result_of = [&](unsigned threads, std::uint32_t wave) {
            RenderOptions options;
            options.threads = threads;
            options.wave_size = wave;
            options.standard_error = true;
            return orrery::render(Plan(scene), options);
        };
        const RenderResult expected = result_of(1, 2048);
        for (const auto& [threads, wave] : {std::pair{1u, 1u}, {2u, 33u}, {7u, 100u}, {2u, 5000u}}) {
            const RenderResult result = result_of(threads, wave);
            EXPECT_EQ(result.standard_error.pixels, expected.standard_error.pixels) << threads << ", " << wave;
            EXPECT_EQ(result.stats.error.relative.value, expected.stats.error.relative.value);
            EXPECT_EQ(result.stats.error.absolute.high, expected.stats.error.absolute.high);
        }
    }
}

// Pixel by pixel: the squares of stated errors against the scatter between seeds.
TEST(StandardError, OfAPixelIsItsScatterBetweenSeeds) {
    const Scene scene = noisy(Estimator::stratified);
    std::vector<double> sum(256), squares(256), stated(256);
    constexpr std::uint32_t seeds = 60;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) {
        Scene other = scene;
        other.settings.seed = 500 + seed;
        RenderOptions options;
        options.standard_error = true;
        const RenderResult result = orrery::render(Plan(other), options);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const double value = result.image.pixels[i].g;
            sum[i] += value;
            squares[i] += value * value;
            stated[i] += std::pow(result.standard_error.pixels[i].g, 2) / seeds;
        }
    }
    // A ratio of variances of 59 and some 240 degrees of freedom has a standard deviation of 0.2, and there are many.
    double mean_ratio = 0;
    int pixels = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double scatter = (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
        if (stated[i] == 0) continue;
        mean_ratio += scatter / stated[i];
        ++pixels;
    }
    EXPECT_GT(pixels, 150);
    EXPECT_NEAR(mean_ratio / pixels, 1, 0.06);
}

TEST(StandardError, IsUnknownFromOneSample) {
    Scene scene = noisy(Estimator::stratified);
    scene.settings.samples = 3;  // one, stratified
    RenderOptions options;
    options.standard_error = true;
    const RenderResult result = orrery::render(Plan(scene), options);
    EXPECT_TRUE(std::isinf(result.stats.error.relative.value));
    EXPECT_TRUE(std::isinf(result.standard_error.pixels[7].g));
}

TEST(StandardError, IsOnlyMadeWhenAskedFor) { EXPECT_TRUE(render(whitted()).standard_error.pixels.empty()); }

}  // namespace
}  // namespace orrery::test
