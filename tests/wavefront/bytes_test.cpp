// What may not change a single byte: threads, the size of a wave, and the instruction set where it rounds alike.
#include <gtest/gtest.h>

#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

/// Every integrator with what makes it hard to repeat: deep trees of branching glass, sorted kinds, partial tiles.
std::vector<Scene> scenes() {
    std::vector<Scene> all;
    for (const Integrator integrator : all_integrators) {
        Scene scene = everything(integrator);
        scene.settings.width = 37;
        scene.settings.height = 21;
        scene.settings.samples = 9;
        scene.settings.depth = 12;
        all.push_back(scene);
    }
    all.push_back(all.front());
    all.back().settings.transport = Transport::nee;
    all.back().settings.light_sampling = LightSampling::area;
    all.back().settings.estimator = Estimator::uniform;
    all.back().settings.samples = 1;
    // One kind of surface: no sort, misses stay in the queue.
    Scene glass_only = picture({0, 0.5, -5}, {0, 0, 0}, 50, 9);
    for (int i = 0; i < 5; ++i) add_sphere(glass_only, {0.8 * i - 1.6, 0.1 * i, 0.3 * (i % 2)}, 0.7, glass(0.95, 1.4));
    add_lamp(glass_only, {0, 3, 0}, 1, {3, 4, 5}, glass(0.5, 1.2));
    glass_only.background = {0.1, 0.2, 0.3};
    glass_only.settings.samples = 4;
    for (const Integrator integrator : all_integrators) {
        glass_only.settings.integrator = integrator;
        all.push_back(glass_only);
    }
    all.push_back(all.front());
    all.back().settings.estimator = Estimator::sobol;
    all.push_back(everything(Integrator::whitted));
    all.back().camera.aperture = 0.1;
    all.back().settings.estimator = Estimator::sobol;
    all.push_back(crowd());
    all.push_back(crowd(Integrator::whitted));
    // One light of several at a vertex, through the loop and through the tree.
    all.push_back(all.front());
    all.back().settings.light_choice = LightChoice::power;
    all.push_back(crowd());
    all.back().settings.light_choice = LightChoice::uniform;
    all.back().settings.transport = Transport::nee;
    return all;
}

class SameBytes : public testing::TestWithParam<std::size_t> {
protected:
    Scene scene = scenes().at(GetParam());
};

TEST_P(SameBytes, ForAnyNumberOfThreads) {
    const Image expected = image_of(scene, {.threads = 1});
    for (const unsigned threads : {1u, 2u, 7u}) {
        const RenderResult result = render(scene, {.threads = threads});
        EXPECT_EQ(result.image.pixels, expected.pixels) << threads << " threads";
        EXPECT_EQ(result.stats.threads, threads);
    }
}

TEST_P(SameBytes, ForAnyWaveSize) {
    for (const Isa isa : supported_isas()) {
        const Image expected = image_of(scene, {.isa = isa});
        for (const std::uint32_t wave : {1u, 16u, 26u, 100u, 2048u, 5000u}) {
            const RenderResult result = render(scene, {.isa = isa, .wave_size = wave});
            EXPECT_EQ(result.image.pixels, expected.pixels) << isa_name(isa) << ", waves of " << wave;
            EXPECT_EQ(result.stats.wave_size, wave);
        }
    }
}

// SSE2 has no fused multiply-add and rounds differently; that it has the same expectation is a variant in
// agreement.hpp, tested on every scene there.
TEST_P(SameBytes, OnInstructionSetsThatRoundAlike) {
    const Image expected = image_of(scene, {.isa = Isa::scalar});
    for (const Isa isa : {Isa::avx2, Isa::avx512}) {
        if (!isa_supported(isa)) continue;
        EXPECT_EQ(image_of(scene, {.isa = isa}).pixels, expected.pixels) << isa_name(isa);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBytes, testing::Range<std::size_t>(0, 13));

// Rays, too, are the same rays.
TEST(Counters, AreTheSameForAnyWaveSizeAndNumberOfThreads) {
    for (const Scene& scene : scenes()) {
        const RenderStats expected = render(scene).stats;
        for (const auto& [threads, wave] : {std::pair{1u, 1u}, {2u, 100u}, {7u, 5000u}}) {
            const RenderStats stats = render(scene, {.threads = threads, .wave_size = wave}).stats;
            EXPECT_EQ(stats.closest_rays, expected.closest_rays);
            EXPECT_EQ(stats.shadow_rays, expected.shadow_rays);
            EXPECT_EQ(stats.dropped_samples, 0u);
        }
    }
}

}  // namespace
}  // namespace orrery::test
