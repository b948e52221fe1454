// Renders that yield no image, and the one with nothing in it.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <thread>

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

/// A white room around one pixel: a path never ends.
Scene endless() {
    Scene scene = picture({0, 0, 0}, {0, 0, 1}, 45, 1);
    add_sphere(scene, {0, 0, 0}, 1, diffuse(dvec3{1}));
    add_point_light(scene, {0, 0.5, 0}, dvec3{1});
    scene.settings.width = scene.settings.height = 1;
    scene.settings.depth = std::numeric_limits<std::uint32_t>::max();
    return scene;
}

/// A bounce of these takes minutes: every vertex aims at every lamp.
Scene many_lights() {
    Scene scene = picture({0, 1, -4}, {0, 0, 0}, 40, 64);
    add_sphere(scene, {0, -50, 0}, 50, diffuse(dvec3{0.8}));
    for (int i = 0; i < 1'000'000; ++i) add_point_light(scene, {0.001 * i, 5, 0}, dvec3{1});
    return scene;
}

std::vector<Scene> slow_scenes() {
    Scene whitted = many_lights();
    whitted.settings.integrator = Integrator::whitted;
    whitted.settings.depth = 20;
    return {endless(), many_lights(), std::move(whitted)};
}

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Far beyond a tenth of a second, so that a busy machine passes, and far below what is abandoned.
constexpr double soon = 1;

TEST(Interrupted, IsHeardWithinAPathAndAmongManyLights) {
    for (Scene scene : slow_scenes()) {
        const Plan plan(std::move(scene));
        const auto start = Clock::now();
        RenderOptions options;
        options.interrupted = [&] { return seconds_since(start) > 0.05; };
        EXPECT_THROW(orrery::render(plan, options), Interrupted);
        EXPECT_LT(seconds_since(start), soon);
    }
}

TEST(TimeUp, IsHeardWithinAPathAndAmongManyLights) {
    for (Scene scene : slow_scenes()) {
        const Plan plan(std::move(scene));
        const auto start = Clock::now();
        RenderOptions options;
        options.goal = {.seconds = 0.05};
        EXPECT_THROW(orrery::render(plan, options), NothingInTime);
        EXPECT_LT(seconds_since(start), soon);
    }
}

// The third pass does not end in time; of its tiles some were done.
TEST(TimeUp, LeavesThePassesThatEndedAndNothingOfTheOther) {
    Scene scene = everything();
    scene.settings.width = scene.settings.height = 64;
    scene.settings.estimator = Estimator::uniform;
    std::atomic<int> passes = 0, tiles = 0;
    RenderOptions options;
    options.goal = {.seconds = 1, .adaptive = false};
    options.pass_done = [&](const ImageError&) { ++passes; };
    options.interrupted = [&] {
        if (passes == 2 && ++tiles == 10) std::this_thread::sleep_for(std::chrono::milliseconds(1200));
        return false;
    };
    const RenderResult result = orrery::render(Plan(scene), options);
    EXPECT_EQ(result.stats.stopped_by, StopReason::time);
    EXPECT_EQ(result.stats.passes, 2u);
    EXPECT_EQ(result.stats.samples_per_pixel, result.stats.most_samples);
    scene.settings.samples = result.stats.most_samples;
    const RenderResult expected = render(scene);
    EXPECT_EQ(result.image.pixels, expected.image.pixels);
    EXPECT_GT(tiles, 9) << "there was nothing to drop";
    EXPECT_LT(result.stats.seconds, 2);
}

TEST(WaveSize, IsAtMostWhatHearsASignal) {
    EXPECT_NO_THROW(render(everything(), {.wave_size = largest_wave}));
    EXPECT_THROW(render(everything(), {.wave_size = largest_wave + 1}), std::invalid_argument);
}

TEST(Progress, EndsAtOneWithAllRays) {
    Scene scene = everything();
    scene.settings.width = 100;
    scene.settings.height = 70;
    double last = 0;
    std::uint64_t rays = 0;
    const RenderStats stats =
        render(scene, {.threads = 1,
                       .progress =
                           [&](double fraction, std::uint64_t so_far) {
                               EXPECT_TRUE(fraction > last || (fraction == last && so_far == rays));
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
