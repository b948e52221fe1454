// Images with a closed form: furnaces, one light over one surface, one glass ball; and what depth counts.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "reference/small_scenes.hpp"
#include "statistics/compare.hpp"

namespace orrery::reference {
namespace {

using glm::dvec3;
using std::numbers::pi;

const dvec3 origin{0};

TEST(Furnace, ClosedSumsTheSeriesOfReflectionsUpToDepth) {
    // Inside a sphere of emission 1 and albedo a every path gathers 1 + a + ... + a^D = (1 - a^(D+1)) / (1 - a), and
    // 1 / (1 - a) in the limit. Next event estimation is exact too: the geometry factor inside a sphere is constant.
    const dvec3 albedo{0.5, 0.25, 0.9};
    for (const std::uint32_t depth : {0u, 1u, 2u, 7u, 400u}) {
        Scene scene = looking({0.3, 0.2, -0.4}, {0.1, 0.9, 0.3}, depth);
        scene.camera.fov = 90;
        add_sphere(scene, origin, 1, diffuse(albedo)).emission = dvec3{1};
        for (const bool next_event : {false, true}) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const double a = albedo[static_cast<int>(channel)];
                const double series = (1 - std::pow(a, depth + 1)) / (1 - a);
                EXPECT_NEAR(estimate(scene, {.next_event = next_event}, channel).mean, series, 1e-9 * series);
            }
        }
    }
}

TEST(Furnace, OpenReturnsTheScatteredFractionOfTheBackground) {
    // A convex body cannot see itself: one event and the path is out, for rough lobes too.
    for (const Material& material : {diffuse(dvec3{0.7}), mirror(0.7), glossy(0.7, 0.1), glossy(0.7, 0.95)}) {
        Scene scene = looking({0, 0, -3}, origin, 1);
        scene.camera.fov = 20;  // the ball fills the image
        scene.background = dvec3{2};
        scene.settings.samples = 100;
        add_sphere(scene, origin, 1, material);
        EXPECT_NEAR(estimate(scene).mean, 1.4, 1e-12) << material.id;
        scene.settings.depth = 0;
        EXPECT_EQ(estimate(scene).mean, 0) << material.id;
    }
}

TEST(Furnace, HoldsAtAnyScale) {
    // Neither acne (a second, darker event on the same ball) nor leaks, from a marble to a planet, far from the origin.
    for (const double radius : {1e-4, 1.0, 1e4, 1e8}) {
        const dvec3 centre{1000, -radius, 50};
        Scene scene = looking({1000, radius / 2, 50}, {1000 + radius / 10, 0, 50}, 3);
        scene.camera.fov = 20;
        scene.background = dvec3{1};
        scene.settings.samples = 1000;
        add_sphere(scene, centre, radius, diffuse(dvec3{0.5}));
        EXPECT_NEAR(estimate(scene).mean, 0.5, 1e-12) << radius;
        scene.primitives[0].emission = dvec3{1};
        scene.camera.position = centre + dvec3{0, radius * (1 - 1e-6), 0};
        EXPECT_NEAR(estimate(scene).mean, 1.875, 1e-12) << radius;
    }
}

TEST(Furnace, TranslucentBallLosesNothing) {
    Scene scene = looking({0, 0, -3}, origin, 200);
    scene.camera.fov = 30;
    scene.background = dvec3{1};
    scene.settings.samples = 20000;
    add_sphere(scene, origin, 1, glass(1, 1.5, 0.3));
    // Each crossing in scales radiance by 1/eta^2 and each one out by eta^2: what entered leaves with factor 1.
    EXPECT_NEAR(estimate(scene).mean, 1, 1e-9);
}

// A point light of intensity (10, 20, 0) above and beside the north pole of a large diffuse sphere, as seen from above.
Scene lit_pole(const dvec3& light, std::uint32_t depth, Integrator integrator = Integrator::path_tracing) {
    Scene scene = looking({3, 4, 0}, origin, depth, integrator);
    add_sphere(scene, {0, -1000, 0}, 1000, diffuse({0.5, 0.8, 0.9}));
    scene.point_lights.push_back({"light", light, {10, 20, 0}});
    return scene;
}

TEST(PointLight, IrradianceFallsWithCosineAndSquareOfDistance) {
    const double d = std::hypot(1, 2, 3), c = 2 / d;
    for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted}) {
        const Scene scene = lit_pole({1, 2, 3}, 1, integrator);
        EXPECT_NEAR(estimate(scene, {}, 0).mean, 0.5 / pi * 10 * c / (d * d), 1e-7);
        EXPECT_NEAR(estimate(scene, {}, 1).mean, 0.8 / pi * 20 * c / (d * d), 1e-7);
        EXPECT_EQ(estimate(scene, {}, 2).mean, 0);
        EXPECT_EQ(estimate(lit_pole({1, 2, 3}, 0, integrator)).mean, 0);
        EXPECT_EQ(estimate(lit_pole({1, -2, 3}, 1, integrator)).mean, 0);
    }
}

TEST(PointLight, IsHiddenByAnySphereBetweenAndByNoneBeyond) {
    Scene scene = lit_pole({0, 4, 0}, 1);
    const double open = estimate(scene).mean;
    add_sphere(scene, {0, 6, 0}, 1.9, diffuse(origin));
    EXPECT_EQ(estimate(scene).mean, open);
    add_sphere(scene, {0, 2, 0}, 0.5, glass(1, 1.5));
    EXPECT_EQ(estimate(scene).mean, 0);
}

TEST(PointLight, LightsTheInsideOfASphereFromInside) {
    Scene scene = looking({0, 0.5, 0}, {0, -1, 0}, 1);
    add_sphere(scene, origin, 1, diffuse(dvec3{0.5}));
    scene.point_lights.push_back({"light", origin, dvec3{10}});
    EXPECT_NEAR(estimate(scene).mean, 0.5 / pi * 10, 1e-9);
    scene.camera.position = {0, 5, 0};  // the same wall from outside gets none of it
    EXPECT_EQ(estimate(scene).mean, 0);
}

TEST(PointLight, MeetsRoughLobesThroughTheirDensity) {
    // Along R the density is (1 + beta^2) / (2 pi beta^2); the returned radiance is rho p I / d^2, without a cosine.
    const double beta = 0.3, peak = (1 + beta * beta) / (2 * pi * beta * beta);
    Scene scene = looking({3, 4, 0}, origin, 1);
    add_sphere(scene, {0, -1000, 0}, 1000, glossy(0.5, beta));
    scene.point_lights.push_back({"light", {-6, 8, 0}, dvec3{10}});
    EXPECT_NEAR(estimate(scene).mean, 0.5 * peak * 10 / 100, 1e-6);

    // Straight down into a translucent ball: 0.96 goes in, its radiance divided by eta^2.
    Scene below = looking({0, 4, 0}, origin, 1);
    add_sphere(below, {0, -10, 0}, 10, glass(0.5, 1.5, beta));
    below.point_lights.push_back({"light", {0, -2, 0}, dvec3{10}});
    EXPECT_NEAR(estimate(below).mean, 0.5 * 0.96 / 2.25 * peak * 10 / 4, 1e-6);
}

TEST(AreaLight, IrradianceOfASphereIsThatOfItsDisk) {
    // E = pi L (r/d)^2 cos for a sphere wholly above the horizon, so the surface returns rho L (r/d)^2 cos.
    const dvec3 centre{1, 2, 2};
    const double r = 0.8, d = 3, returned = 0.5 * 7 * (r / d) * (r / d) * (2 / d);
    for (const bool next_event : {false, true}) {
        for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted}) {
            Scene scene = looking({3, 4, 0}, origin, 1, integrator);
            add_sphere(scene, {0, -1000, 0}, 1000, diffuse(dvec3{0.5}));
            add_light(scene, centre, r, dvec3{7});
            scene.settings.samples = 200000;
            EXPECT_LT(std::abs(deviation(estimate(scene, {.next_event = next_event}), returned)), 4);
        }
    }
}

TEST(AreaLight, ShinesInwardsToo) {
    for (const bool next_event : {false, true}) {
        Scene scene = looking({0, 0, -3}, origin, 1);
        add_sphere(scene, origin, 1, diffuse(dvec3{0.5}));
        add_light(scene, {0, 1, 0}, 5, dvec3{7});
        scene.settings.samples = 200000;
        const statistics::Estimate value = estimate(scene, {.next_event = next_event});
        // All around the ball is light. Running into it is exact, sampling its surface is not.
        EXPECT_NEAR(value.mean, 3.5, next_event ? 4 * value.standard_error() : 1e-12);
    }
}

TEST(Dielectric, CentralRaySplitsByFresnel) {
    // Straight through: F = 0.04 at every surface. D = 1 sees the background in the reflection alone, D = 2 also
    // through the ball, and each further event adds one more internal reflection.
    Scene scene = looking({0, 0, -3}, origin, 1, Integrator::whitted);
    scene.background = dvec3{1};
    add_sphere(scene, origin, 1, glass(1, 1.5));
    double expected = 0.04, inside = 0.96;
    for (std::uint32_t depth = 1; depth <= 6; ++depth, expected += inside * 0.96, inside *= 0.04) {
        scene.settings.depth = depth;
        EXPECT_NEAR(estimate(scene).mean, expected, 1e-9) << depth;
    }
}

TEST(Dielectric, BallWithoutLossIsInvisible) {
    Scene scene = looking({0, 0, -3}, origin, 400);
    scene.camera.fov = 30;
    scene.background = dvec3{1};
    scene.settings.samples = 20000;
    add_sphere(scene, origin, 1, glass(1, 1.5));
    EXPECT_NEAR(estimate(scene).mean, 1, 1e-4);  // a ray that grazes stays in for long
}

TEST(Dielectric, RadianceInsideIsEtaSquaredOfThatOutside) {
    Scene scene = looking({0, 0, 0.5}, {0, 0, 1}, 20, Integrator::whitted);
    scene.background = dvec3{1};
    add_sphere(scene, origin, 1, glass(1, 1.5));
    EXPECT_NEAR(estimate(scene).mean, 2.25, 1e-9);
    scene.camera.position = {0.8, 0, 0};  // incidence at sine 0.8 > 1/1.5: light is trapped, and so is the eye
    scene.camera.target = {0.8, 0, 1};
    EXPECT_EQ(estimate(scene).mean, 0);
}

TEST(DepthCount, IsScatteringEventsBetweenEyeAndLight) {
    // Eye -> mirror -> diffuse wall behind the eye, lit by a point light: two events. Emission in the mirror: one.
    for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted}) {
        for (std::uint32_t depth = 0; depth <= 3; ++depth) {
            Scene scene = looking({0, 0, 0}, {0, 0, 1}, depth, integrator);
            add_sphere(scene, {0, 0, 2}, 1, mirror(0.5));
            add_sphere(scene, {0, 0, -1010}, 1000, diffuse(dvec3{1})).emission = dvec3{3};
            scene.point_lights.push_back({"light", {0, 3, -6}, dvec3{pi * 125}});  // d = 5, cosine 4/5 at the wall
            const double expected = depth == 0 ? 0 : depth == 1 ? 1.5 : 1.5 + 0.5 * 4;
            EXPECT_NEAR(estimate(scene, {.caustics = false}).mean, expected, 1e-6) << depth;
        }
    }
}

TEST(Whitted, HasNoIndirectDiffuseLight) {
    // In a diffuse sphere with a point light at its centre paths gather a + a^2 + ..., Whitted the first alone.
    Scene scene = looking({0, 0, 0.1}, {0, 0, 1}, 5, Integrator::whitted);
    add_sphere(scene, origin, 1, diffuse(dvec3{0.5}));
    scene.point_lights.push_back({"light", origin, dvec3{pi}});
    scene.background = dvec3{9};
    EXPECT_NEAR(estimate(scene).mean, 0.5, 1e-9);
    scene.settings.integrator = Integrator::path_tracing;
    EXPECT_NEAR(estimate(scene).mean, 1 - std::pow(0.5, 5), 1e-9);
}

TEST(Whitted, FollowsRoughLobesUnperturbed) {
    Scene scene = looking({0, 0, 0}, {0, 0, 1}, 4, Integrator::whitted);
    add_sphere(scene, {0, 0, 2}, 1, glossy(0.5, 0.4));
    add_light(scene, {0, 0, -5}, 0.01, dvec3{8});
    EXPECT_NEAR(estimate(scene).mean, 4, 1e-12);
}

// Everything at once: both light kinds, all materials, touching and nested spheres.
Scene crowd() {
    Scene scene = looking({0, 1, -8}, {0, 0, 0}, 5);
    scene.camera.fov = 45;
    scene.camera.aperture = 0.3;
    scene.camera.focal_distance = 8;
    scene.settings.width = scene.settings.height = 24;
    scene.background = {0.1, 0.2, 0.3};
    add_sphere(scene, {0, -101, 0}, 100, diffuse({0.5, 0.6, 0.7}));
    add_sphere(scene, {-2, 0, 0}, 1, glossy(0.9, 0.4));
    add_sphere(scene, {0, 0, 0}, 1, glass(0.9, 1.5));
    add_sphere(scene, {0, 0, 0}, 0.5, diffuse({0.9, 0.1, 0.1}));
    add_sphere(scene, {2, 0, 0}, 1, glass(0.9, 1.3, 0.2));
    add_sphere(scene, {1, 2, 2}, 1, mirror(0.9));
    add_light(scene, {-1, 3, -1}, 1, {6, 5, 4});
    scene.point_lights.push_back({"light", {3, 4, -3}, dvec3{20}});
    return scene;
}

TEST(Reference, NextEventEstimationChangesNoExpectation) {
    const Options naive{.seed = 1, .samples = 800, .block_size = 6, .caustics = false};
    const Options next_event{.seed = 2, .samples = 400, .block_size = 6, .next_event = true, .caustics = false};
    const statistics::Comparison result =
        statistics::compare(render(crowd(), next_event), render(crowd(), naive), {.alpha = 1e-4});
    EXPECT_TRUE(result.agrees) << result.message;
}

TEST(Reference, IsTheSameForAnyNumberOfThreadsAndAnotherForAnotherSeed) {
    const auto bits = [](std::uint64_t seed, unsigned threads) {
        const statistics::RgbEstimate mean =
            render(crowd(), {.seed = seed, .samples = 4, .next_event = true, .threads = threads}).mean();
        return std::array{mean[0].mean, mean[1].mean, mean[2].variance};
    };
    EXPECT_EQ(bits(1, 1), bits(1, 3));
    EXPECT_NE(bits(1, 2), bits(2, 2));
}

TEST(Reference, RefusesToGuessAnError) { EXPECT_THROW(render(crowd(), {.samples = 1}), std::invalid_argument); }

}  // namespace
}  // namespace orrery::reference
