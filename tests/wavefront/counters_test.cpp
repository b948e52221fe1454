// What the statistics say: rays where they are cast, memory, samples that were no number.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

constexpr std::uint64_t pixels = 16 * 16, samples = 8, paths = pixels * samples;

/// A ball that fills the image; whatever its rays do next, they do not meet it again.
Scene filled(const Material& material, std::uint32_t depth) {
    Scene scene = picture({0, 0, -3}, {0, 0, 0}, 20, depth);
    add_sphere(scene, {0, 0, 0}, 1, material);
    scene.settings.samples = samples;
    scene.settings.roulette = false;
    return scene;
}

/// Above the horizon of every point that `filled` shows.
const dvec3 overhead{0.5, 0.5, -9};

void expect_rays(const Scene& scene, std::uint64_t closest, std::uint64_t shadow, const char* what) {
    for (const Isa isa : supported_isas()) {
        const RenderStats stats = render(scene, {.isa = isa}).stats;
        EXPECT_EQ(stats.closest_rays, closest) << what << ", " << isa_name(isa);
        EXPECT_EQ(stats.shadow_rays, shadow) << what << ", " << isa_name(isa);
    }
}

TEST(Rays, OfDepthAreThoseOfTheCamera) {
    Scene scene = filled(glass(1, 1.5), 20);
    add_lamp(scene, overhead, 0.5, dvec3{1});
    add_point_light(scene, overhead, dvec3{1});
    scene.settings.integrator = Integrator::depth;
    expect_rays(scene, paths, 0, "DEPTH");
}

TEST(Rays, OfPathsAreCountedWhereTheyAreCast) {
    Scene scene = filled(diffuse(dvec3{0.5}), 0);
    add_point_light(scene, overhead, dvec3{1});
    expect_rays(scene, paths, 0, "depth 0: nothing scatters");
    scene.settings.depth = 1;
    expect_rays(scene, paths, paths, "depth 1: one shadow ray per vertex, and nothing beyond to run into");
    scene.settings.depth = 2;
    expect_rays(scene, 2 * paths, paths, "depth 2: the second rays miss");
    add_point_light(scene, overhead * 2.0, dvec3{1});
    expect_rays(scene, 2 * paths, 2 * paths, "two lights");
    add_point_light(scene, {0, 0, 5}, dvec3{1});
    expect_rays(scene, 2 * paths, 2 * paths, "a third below the horizon");
    scene.background = dvec3{1};
    scene.settings.depth = 1;
    expect_rays(scene, 2 * paths, 2 * paths, "a background the last rays may run into");
}

TEST(Rays, TowardsAreaLightsAreThoseOfTheTransport) {
    Scene scene = filled(diffuse(dvec3{0.5}), 1);
    add_lamp(scene, overhead, 0.5, dvec3{1}, diffuse(dvec3{0}));
    scene.settings.light_sampling = LightSampling::cone;
    scene.settings.transport = Transport::nee;
    expect_rays(scene, paths, paths, "nee: the last diffuse ray is not cast");
    scene.settings.transport = Transport::mis;
    expect_rays(scene, 2 * paths, paths, "mis: both");
    scene.settings.transport = Transport::naive;
    expect_rays(scene, 2 * paths, 0, "naive: no light is sampled");

    scene.materials[0] = glossy(0.5, 0.2);
    expect_rays(scene, 2 * paths, 0, "glossy, naive");
    scene.settings.transport = Transport::nee;
    expect_rays(scene, 2 * paths, 0, "glossy, nee: the perturbed ray finds the light");
    scene.materials[0] = mirror(0.5);
    scene.settings.transport = Transport::mis;
    expect_rays(scene, 2 * paths, 0, "a mirror samples no light");
}

// What is known needs no ray, and what the last one runs into counts for nothing.
TEST(Rays, AreFewWhereLightIsKnownInClosedForm) {
    Scene scene = filled(diffuse(dvec3{0.5}), 1);
    add_lamp(scene, overhead, 0.5, dvec3{1}, diffuse(dvec3{0}));
    scene.settings.light_sampling = LightSampling::exact;
    for (const Transport transport : {Transport::nee, Transport::mis}) {
        scene.settings.transport = transport;
        expect_rays(scene, paths, 0, "a lamp in plain sight");
    }
    scene.materials[0] = glossy(0.5, 0.2);
    const RenderStats rough = render(scene).stats;
    EXPECT_EQ(rough.closest_rays, paths) << "mis: light samples alone count, behind rough surfaces too";
    EXPECT_LT(rough.shadow_rays, paths) << "and only of the lobe's own directions";
    scene.settings.transport = Transport::nee;
    expect_rays(scene, 2 * paths, 0, "glossy, nee: the perturbed ray finds the light");
    scene.settings.transport = Transport::mis;
    scene.materials[0] = diffuse(dvec3{0.5});
    scene.background = dvec3{1};
    expect_rays(scene, 2 * paths, 0, "a background the last rays may run into");
}

// Half of a light's surface turns away from any point outside it; no ray is cast towards that half.
TEST(Rays, AreNotCastTowardsTheFarSideOfALight) {
    Scene scene = filled(diffuse(dvec3{0.5}), 1);
    add_lamp(scene, overhead, 0.5, dvec3{1}, diffuse(dvec3{0}));
    scene.settings.transport = Transport::nee;
    scene.settings.light_sampling = LightSampling::area;
    scene.settings.samples = 100;
    const auto shadow = static_cast<double>(render(scene).stats.shadow_rays) / (100 * pixels);
    EXPECT_NEAR(shadow, 0.5 * (1 - 0.5 / 8), 0.03);  // a little less than half of a sphere so near is seen
}

TEST(Rays, OfWhittedTreesAreTheirNodes) {
    Scene scene = filled(diffuse(dvec3{0.5}), 3);
    scene.settings.integrator = Integrator::whitted;
    scene.settings.light_sampling = LightSampling::cone;
    add_point_light(scene, overhead, dvec3{1});
    add_lamp(scene, overhead, 0.5, dvec3{1}, diffuse(dvec3{0}));
    expect_rays(scene, paths, 2 * paths, "a diffuse surface ends the ray");
    scene.materials[0] = mirror(0.5);
    expect_rays(scene, 2 * paths, 0, "a mirror turns it");
    scene.materials[0] = glass(1, 1.5);
    scene.settings.depth = 0;
    expect_rays(scene, paths, 0, "depth 0");
    scene.settings.depth = 1;
    expect_rays(scene, 3 * paths, 0, "depth 1: reflected and transmitted");
    scene.settings.depth = 2;
    expect_rays(scene, 5 * paths, 0, "depth 2: the transmitted one branches again, the reflected one is gone");
    scene.settings.depth = 3;
    expect_rays(scene, 7 * paths, 0, "depth 3: of those two the one that stayed inside");
}

TEST(Statistics, SayWhatRan) {
    for (const Integrator integrator : all_integrators) {
        const Scene scene = everything(integrator);
        for (const Isa isa : supported_isas()) {
            const RenderStats stats = render(scene, {.threads = 2, .isa = isa}).stats;
            EXPECT_EQ(stats.isa, isa);
            EXPECT_EQ(stats.threads, 2u);
            EXPECT_EQ(stats.samples_per_pixel, 4u);
            EXPECT_GT(stats.seconds, 0);
            EXPECT_EQ(stats.closest_rays == 0, false);
            EXPECT_EQ(stats.shadow_rays == 0, integrator == Integrator::depth);
            for (std::size_t s = 0; s < stage_names.size(); ++s)
                EXPECT_GE(stats.profile.total(static_cast<Stage>(s)).seconds, 0);
            EXPECT_GT(stats.profile.total(Stage::intersect).seconds, 0);
            EXPECT_EQ(stats.profile.total(Stage::shadow).seconds > 0, integrator != Integrator::depth);
        }
    }
}

// The profile accounts for every ray that was cast and for all of the threads' time.
TEST(Statistics, ProfileAddsUp) {
    for (const Integrator integrator : all_integrators) {
        const RenderStats stats = render(everything(integrator), {.threads = 2}).stats;
        const Profile& profile = stats.profile;
        EXPECT_EQ(profile.total(Stage::intersect).rays, stats.closest_rays);
        EXPECT_EQ(profile.total(Stage::shadow).rays, stats.shadow_rays);
        double seconds = profile.others;
        for (std::size_t s = 0; s < stage_names.size(); ++s) {
            const StageCost all = profile.total(static_cast<Stage>(s));
            seconds += all.seconds;
            EXPECT_LE(all.filled, all.lanes);
            EXPECT_EQ(all.bytes > 0, all.rays > 0);
        }
        EXPECT_NEAR(seconds, 2 * stats.seconds, 1e-6 * stats.seconds);
        EXPECT_GE(profile.others, 0) << "the stages took no more time than there was";
        // What one bounce casts the next one intersects, less what died.
        for (std::size_t b = 1; b + 1 < profile_bounces && integrator == Integrator::path_tracing; ++b)
            EXPECT_LE(profile.at(b, Stage::intersect).rays, profile.at(b - 1, Stage::roulette).rays);
    }
}

// The queues of a thread stay below 4 MiB whatever the image, the integrator and the depth of its trees.
TEST(Statistics, QueuesStaySmall) {
    for (const Integrator integrator : all_integrators) {
        for (const std::uint32_t depth : {0u, 1u, 5u, 20u}) {
            Scene scene = everything(integrator);
            scene.settings.depth = depth;
            scene.settings.width = 200;
            scene.settings.height = 3;
            const RenderStats stats = render(scene).stats;
            EXPECT_LT(stats.queue_bytes, std::uint64_t{4} << 20) << name_of(integrator) << ", depth " << depth;
            EXPECT_GE(stats.wave_size, 256u);
            EXPECT_EQ(stats.bytes_per_ray, stats.queue_bytes / stats.wave_size);
        }
    }
}

void expect_finite(const Image& image) {
    for (const Rgb& p : image.pixels) EXPECT_TRUE(std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b));
}

// So bright among lengths so small that the radiance it returns is no float: those samples are dropped, every one is
// counted, and the pixel keeps the mean of the others.
TEST(DroppedSamples, AreCountedAndKeptOut) {
    for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted}) {
        Scene scene = picture({0, 0, -3}, {0, 0, 0}, 60, 1);
        add_sphere(scene, {0, 0, 0}, 1, diffuse(dvec3{0.5}));
        add_point_light(scene, {0, 0, -1.05}, dvec3{0});
        scene = scaled(scene, -14);
        scene.point_lights[0].intensity = dvec3{1e30};
        scene.background = {1, 2, 3};
        scene.settings.integrator = integrator;
        scene.settings.precision = Precision::binary32;  // double can compute most of them
        scene.settings.samples = 16;
        scene.settings.roulette = false;
        for (const Isa isa : supported_isas()) {
            const RenderResult result = render(scene, {.isa = isa});
            expect_finite(result.image);
            EXPECT_GT(result.stats.dropped_samples, 0u);
            EXPECT_LE(result.stats.dropped_samples, result.stats.shadow_rays);
            EXPECT_EQ(result.image.at(0, 0), (Rgb{1, 2, 3}));
            EXPECT_EQ(result.image.at(8, 8), Rgb{}) << "no sample was left";
        }
    }
}

TEST(DroppedSamples, AreNoneWhereALightLiesOnASurface) {
    Scene scene = still_life(diffuse(dvec3{0.5}));
    add_point_light(scene, {-0.5, 2, 0}, {1, 2, 3});  // the ball's north pole
    add_point_light(scene, {-0.5, 1, 0}, {1, 2, 3});  // its centre
    add_point_light(scene, scene.camera.position, {1, 2, 3});
    const RenderResult result = render(scene);
    expect_finite(result.image);
    EXPECT_EQ(result.stats.dropped_samples, 0u);
}

}  // namespace
}  // namespace orrery::test
