// Renders that yield no image, and the one with nothing in it.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

// Waves of 2048 pairs that tiles fill once, exactly once, or many times: there must be a time to ask in each.
TEST(Interrupted, IsThrownWhateverTheNumberOfSamples) {
    for (const std::uint32_t samples : {1u, 2u, 4u, 8u, 9u, 64u}) {
        Scene scene = everything();
        scene.settings.width = scene.settings.height = 128;
        scene.settings.estimator = Estimator::uniform;
        scene.settings.samples = samples;
        EXPECT_THROW(render(scene, {.interrupted = [] { return true; }}), Interrupted) << samples << " samples";
    }
}

TEST(Interrupted, IsNotThrownUnlessAsked) {
    Scene scene = everything();
    scene.settings.width = scene.settings.height = 64;
    scene.settings.samples = 9;
    std::atomic<int> polls = 0;
    const RenderResult polled = render(scene, {.interrupted = [&] { return ++polls, false; }});
    EXPECT_GT(polls, 0);
    EXPECT_EQ(polled.image.pixels, image_of(scene).pixels);
}

TEST(Interrupted, AbandonsTheRestOfTheWork) {
    Scene scene = everything();
    scene.settings.width = scene.settings.height = 128;
    scene.settings.samples = 100;
    const std::uint64_t whole = render(scene).stats.closest_rays;
    std::atomic<std::uint64_t> done = 0;
    const auto progress = [&](double, std::uint64_t rays) { done = rays; };
    EXPECT_THROW(render(scene, {.progress = progress, .interrupted = [] { return true; }}), Interrupted);
    EXPECT_LT(done, whole / 2);
}

TEST(Progress, EndsAtOneWithAllRays) {
    Scene scene = everything();
    scene.settings.width = 100;
    scene.settings.height = 70;
    double last = 0;
    std::uint64_t rays = 0;
    const RenderStats stats = render(scene, {.threads = 1,
                                             .progress =
                                                 [&](double fraction, std::uint64_t so_far) {
                                                     EXPECT_GT(fraction, last);
                                                     EXPECT_GE(so_far, rays);
                                                     last = fraction;
                                                     rays = so_far;
                                                 }})
                                  .stats;
    EXPECT_EQ(last, 1);
    EXPECT_EQ(rays, stats.closest_rays + stats.shadow_rays);
}

// A machine has some of the instruction sets; this is the test for the others.
TEST(InstructionSet, RunsOrIsRefused) {
    const Scene scene = everything();
    for (const Isa isa : all_isas) {
        if (isa_supported(isa)) {
            EXPECT_EQ(render(scene, {.isa = isa}).stats.isa, isa);
        } else {
            EXPECT_THROW(render(scene, {.isa = isa}), std::invalid_argument) << isa_name(isa);
        }
    }
}

TEST(InstructionSet, IsRefusedWhereItIsNone) {
    EXPECT_THROW(render(everything(), {.isa = static_cast<Isa>(all_isas.size())}), std::invalid_argument);
}

TEST(EmptyScene, ShowsTheEnclosingVolume) {
    Scene scene = picture({1, 2, 3}, {4, 5, 7}, 50, 5);
    scene.background = {0.25, 0.5, 3};
    add_point_light(scene, {2, 3, 4}, dvec3{100});  // lights nothing
    for (const bool lens : {false, true}) {
        scene.camera.aperture = lens ? 0.5 : 0;
        for (const Isa isa : supported_isas()) {
            for (const Integrator integrator : all_integrators) {
                scene.settings.integrator = integrator;
                const RenderResult result = render(scene, {.isa = isa});
                const float far = 1 / (1 + Plan(scene).tables().enclosing_distance);
                const Rgb expected = integrator == Integrator::depth ? Rgb{far, far, far} : Rgb{0.25f, 0.5f, 3};
                EXPECT_EQ(result.image.pixels, std::vector<Rgb>(256, expected)) << name_of(integrator);
                EXPECT_EQ(result.stats.shadow_rays, 0u);
            }
        }
    }
}

TEST(DarkScene, IsBlack) {
    Scene scene = still_life(glass(1, 1.5));
    add_lamp(scene, {0, 4, 0}, 1, dvec3{0});
    for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted}) {
        scene.settings.integrator = integrator;
        EXPECT_EQ(image_of(scene).pixels, std::vector<Rgb>(256));
    }
}

// DEPTH knows one distance for all that is not there, beyond all that is.
TEST(Depth, PutsTheEnclosingVolumeBeyondEverything) {
    Scene scene = everything(Integrator::depth);
    scene.settings.samples = 1;
    scene.settings.width = scene.settings.height = 64;
    const float far = 1 / (1 + Plan(scene).tables().enclosing_distance);
    int misses = 0, hits = 0;
    for (const Rgb& p : image_of(scene).pixels) {
        EXPECT_EQ(p, (Rgb{p.r, p.r, p.r}));
        EXPECT_GE(p.r, far);
        EXPECT_LT(p.r, 1);
        ++(p.r == far ? misses : hits);
    }
    EXPECT_GT(misses, 0);
    EXPECT_GT(hits, 0);
}

}  // namespace
}  // namespace orrery::test
