// Which spots bounces are guided to, and when.
#include "plan/guide.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "plan/worlds.hpp"

namespace orrery::test {
namespace {

using enum MaterialKind;

/// A diffuse ball of radius 1 at x, and nothing else.
void add_ball(Scene& scene, double x, double rho = 0.5, MaterialKind kind = diffuse) {
    Primitive& p = add(scene, kind);
    p.centre = {x, 0, 0}, p.radius = 1;
    scene.materials.push_back(scene.materials[p.material]);
    scene.materials.back().rho = dvec3{rho};
    p.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void add_point(Scene& scene, const dvec3& at, double intensity = 1) {
    scene.point_lights.push_back({"", at, dvec3{intensity}});
}

TEST(Guide, SpotsSendOnWhatTheyGet) {
    Scene scene = empty_world();
    add_ball(scene, 0);
    add_point(scene, {0, 1.25, 0}, 3);
    add_point(scene, {0, 0, 9}, 3);
    const auto spots = plan_spots(scene, true, false);
    ASSERT_EQ(spots.size(), 2u);
    EXPECT_DOUBLE_EQ(spots[0].gap, 0.25);
    EXPECT_DOUBLE_EQ(spots[0].width, 0.25) << "near lamps make spots as wide as they are far";
    EXPECT_DOUBLE_EQ(spots[1].gap, 8);
    EXPECT_DOUBLE_EQ(spots[1].width, 1) << "far ones light half of the ball";
    for (const PlannedSpot& s : spots) {
        // Flux 2 pi (1 - cos) I arrives; half of it, over pi, leaves as radiance times area.
        const double cosine = std::sqrt(1 - std::pow(1 / (1 + s.gap), 2));
        const double flux = 2 * std::numbers::pi * (1 - cosine) * 3;
        EXPECT_NEAR(s.power, 0.5 * flux / std::numbers::pi / std::numbers::pi, 1e-12);
        EXPECT_EQ(s.ball, 0u);
    }
}

TEST(Guide, TakesTheBrightestFirst) {
    Scene scene = empty_world();
    for (int i = 0; i < 9; ++i) {
        add_ball(scene, 10 * i);
        add_point(scene, {10.0 * i, 1.3, 0}, 1 + (i * 4) % 9);  // 1 5 9 4 8 3 7 2 6
    }
    const auto spots = plan_spots(scene, true, false);
    ASSERT_EQ(spots.size(), kernels::most_spots);
    const std::uint32_t balls[] = {2, 4, 6, 8};
    for (std::size_t i = 0; i < spots.size(); ++i) EXPECT_EQ(spots[i].ball, balls[i]);
}

TEST(Guide, SeesOnlySpotsThatLampsOutsideMakeOnDiffuseBalls) {
    const auto spots = [](MaterialKind kind, double rho, const dvec3& lamp) {
        Scene scene = empty_world();
        add_ball(scene, 0, rho, kind);
        add_point(scene, lamp);
        return plan_spots(scene, true, false).size();
    };
    EXPECT_EQ(spots(diffuse, 0.5, {0, 2, 0}), 1u);
    EXPECT_EQ(spots(diffuse, 0, {0, 2, 0}), 0u) << "black";
    EXPECT_EQ(spots(diffuse, 0.5, {0, 0.5, 0}), 0u) << "inside";
    EXPECT_EQ(spots(diffuse, 0.5, {0, 1, 0}), 0u) << "on it";
    for (const MaterialKind other : {specular, glossy, dielectric, translucent})
        EXPECT_EQ(spots(other, 0.5, {0, 2, 0}), 0u);
    Scene lamp = empty_world();
    add_ball(lamp, 0);
    lamp.primitives[0].emission = dvec3{1};
    EXPECT_TRUE(plan_spots(lamp, true, true).empty()) << "lights itself";
    add_ball(lamp, 3);
    EXPECT_EQ(plan_spots(lamp, true, true).size(), 1u);
    EXPECT_TRUE(plan_spots(lamp, true, false).empty());
}

/// A wall of radius 100 with a lamp of this intensity at this distance from it, seen from the side.
Scene corner(double gap) {
    Scene scene = empty_world();
    for (const dvec3& centre : {dvec3{0, -101, 0}, dvec3{-102, 0, 0}}) {
        add_ball(scene, 0);
        scene.primitives.back().centre = centre, scene.primitives.back().radius = 100;
    }
    add_point(scene, {gap - 2, 1, 0});
    scene.camera.position = {1, 2, -5};
    scene.camera.target = {0, -1, 0};
    return scene;
}

TEST(Guide, RunsWhereItPays) {
    Scene scene = corner(0.2);
    EXPECT_TRUE(needs_of(scene).guide);
    EXPECT_TRUE(needs_of(scene).roulette_scale);
    scene.settings.guide = Guide::off;
    EXPECT_FALSE(needs_of(scene).guide || needs_of(scene).roulette_scale);
    for (const Guide guide : {Guide::automatic, Guide::on}) {
        Scene far = corner(1.9);
        far.settings.guide = guide;
        EXPECT_EQ(needs_of(far).guide, guide == Guide::on) << "broad spots";
    }
}

TEST(Guide, NeedsPathsThatGoOnAndLightsThatAreSampled) {
    Scene scene = corner(0.2);
    scene.settings.guide = Guide::on;
    EXPECT_TRUE(needs_of(scene).guide);
    scene.settings.transport = Transport::naive;
    EXPECT_TRUE(needs_of(scene).guide) << "point lights are always sampled";
    scene.settings.depth = 1;
    EXPECT_FALSE(needs_of(scene).guide);
    scene.settings.depth = 5;
    for (const Integrator other : {Integrator::whitted, Integrator::depth}) {
        scene.settings.integrator = other;
        EXPECT_FALSE(needs_of(scene).guide);
    }
    Scene lamp = world({diffuse});
    add_area_light(lamp);
    lamp.settings.guide = Guide::on;
    EXPECT_TRUE(needs_of(lamp).guide);
    lamp.settings.transport = Transport::naive;
    EXPECT_FALSE(needs_of(lamp).guide) << "what bounces find there is as rare as before";
}

TEST(Guide, IsNotConsideredAmongThousands) {
    Scene scene = corner(0.2);
    for (int i = 0; i < 5000; ++i) {
        add(scene, diffuse);
        scene.primitives.back().centre = {0, 500.0 + i, 0};
    }
    EXPECT_FALSE(needs_of(scene).guide);
    scene.settings.guide = Guide::on;
    EXPECT_TRUE(needs_of(scene).guide);
}

}  // namespace
}  // namespace orrery::test
