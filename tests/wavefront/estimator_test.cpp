// The three image estimators: where in its pixel a sample falls.
#include <gtest/gtest.h>

#include <cmath>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

// How far it is to the wall of a sphere around the camera: smooth over the pixels, and different all over each. The
// mean tells where the samples are, with no rare event to wait for.
Scene wall() {
    Scene scene = picture({0.5, 0.3, 0.2}, {1, 1, 1}, 100, 0);
    add_sphere(scene, {0, 0, 0}, 1, diffuse(dvec3{0}));
    scene.settings.integrator = Integrator::depth;
    return scene;
}

// Pixel by pixel, because a shift by part of a pixel is lost in the mean of a block. Cells that do not tile the pixel,
// or hold one sample too many or too few, move the mean.
class Strata : public testing::TestWithParam<std::uint32_t> {};

TEST_P(Strata, CoverThePixel) {
    const Budget budget{.samples = GetParam(), .seeds = 64, .reference_samples = 6000, .block_size = 1};
    const auto in = [](Estimator estimator) { return [=](RenderSettings& s) { s.estimator = estimator; }; };
    expect_agreement_of({{"uniform", in(Estimator::uniform)},
                         {"stratified", in(Estimator::stratified)},
                         {"sobol", in(Estimator::sobol)}},
                        wall(), budget);
}

INSTANTIATE_TEST_SUITE_P(Samples, Strata, testing::Values(1u, 4u, 6u, 9u, 30u));

// Edges in all directions and no other noise: how bright a pixel is, is how much of it a lamp covers.
Scene edges() {
    Scene scene = picture({0, 0, -5}, {0, 0, 0}, 40, 0);
    add_lamp(scene, {0, 0, 0}, 1.2, {1, 2, 3});
    add_lamp(scene, {1.5, 1.2, -1}, 0.5, {3, 2, 1});
    add_lamp(scene, {-6, -6, 3}, 6, {2, 1, 2});
    return scene;
}

double noise(const Scene& scene, Estimator estimator) {
    const auto blocks = blocks_of(scene, {"", [=](RenderSettings& s) { s.estimator = estimator; }},
                                  {.samples = 64, .seeds = 16, .block_size = 16});
    return blocks.blocks[0][0].standard_error();
}

// The point of stratification.
TEST(Stratified, IsLessNoisyThanUniform) {
    EXPECT_LT(noise(edges(), Estimator::stratified), 0.5 * noise(edges(), Estimator::uniform));
}

/// A wall lit by a large lamp above it, seen close enough that the picture's plane hardly matters.
Scene soft_light() {
    Scene scene = picture({0, 0, -1.2}, {0, 0, 0}, 20, 1);
    add_sphere(scene, {0, 0, 1000}, 1000, diffuse(dvec3{0.7}));
    add_lamp(scene, {0, 2, -2}, 1.2, {3, 3, 3});
    scene.settings.transport = Transport::nee;
    return scene;
}

// The point of a sequence for every decision: the lamp is sampled evenly too, which strata of the pixel leave to
// chance.
TEST(Sobol, IsLessNoisyThanUniformInThePixelAndOverLights) {
    EXPECT_LT(noise(edges(), Estimator::sobol), 0.5 * noise(edges(), Estimator::uniform));
    EXPECT_LT(noise(soft_light(), Estimator::sobol), 0.5 * noise(soft_light(), Estimator::uniform));
    EXPECT_LT(noise(soft_light(), Estimator::sobol), 0.6 * noise(soft_light(), Estimator::stratified));
}

TEST(Stratified, TakesTheLargestSquareOfSamples) {
    for (const auto& [asked, taken] : {std::pair{1u, 1u}, {2u, 1u}, {3u, 1u}, {4u, 4u}, {8u, 4u}, {99u, 81u}}) {
        Scene scene = edges();
        scene.settings.samples = asked;
        scene.settings.estimator = Estimator::stratified;
        const RenderStats stratified = render(scene).stats;
        EXPECT_EQ(stratified.samples_per_pixel, taken);
        EXPECT_EQ(stratified.closest_rays, 256 * taken);
        scene.settings.estimator = Estimator::uniform;
        const RenderStats uniform = render(scene).stats;
        EXPECT_EQ(uniform.samples_per_pixel, asked);
        EXPECT_EQ(uniform.closest_rays, 256 * asked);
    }
}

// Asking for more samples adds to those there are. Here a sample is 0 or 1, so that a pixel's mean tells their number.
class Prefix : public testing::TestWithParam<Estimator> {};

TEST_P(Prefix, SampleIsTheSameHoweverManyFollow) {
    Scene scene = picture({0, 0, -5}, {0, 0, 0}, 40, 0);
    add_lamp(scene, {0.3, 0.4, 0}, 1.2, dvec3{1});
    scene.settings.estimator = GetParam();
    std::vector<long> lit(256, 0);
    long mixed = 0;
    const std::uint32_t step = GetParam() == Estimator::sobol ? 2 : 1;  // as many of both sequences
    for (std::uint32_t samples = step; samples <= 40; samples += step) {
        scene.settings.samples = samples;
        const Image image = image_of(scene);
        for (std::size_t i = 0; i < lit.size(); ++i) {
            const long now = std::lround(image.pixels[i].r * static_cast<float>(samples));
            const long added = now - lit[i];
            EXPECT_TRUE(0 <= added && added <= step) << "pixel " << i << ", sample " << samples - 1;
            lit[i] = now;
            if (samples == 40 && now > 0 && now < 40) ++mixed;
        }
    }
    EXPECT_GT(mixed, 10) << "the scene has pixels on an edge";
}

INSTANTIATE_TEST_SUITE_P(Estimators, Prefix, testing::Values(Estimator::uniform, Estimator::sobol));

}  // namespace
}  // namespace orrery::test
