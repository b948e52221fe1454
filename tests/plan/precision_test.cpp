// Which precision a scene needs.
#include <gtest/gtest.h>

#include <cmath>

#include "plan/plan.hpp"
#include "worlds.hpp"

namespace orrery::test {
namespace {

/// A ball on a ground, the camera a few radii away.
Scene ball_on(double ground, double ball = 1) {
    Scene scene = empty_world();
    scene.camera.position = {0, 3, -9};
    scene.camera.target = {0, 1, 0};
    scene.settings.width = scene.settings.height = 1024;
    scene.materials.resize(1);
    scene.primitives.resize(2);
    scene.primitives[0].id = "ground", scene.primitives[0].centre = {0, -ground, 0},
    scene.primitives[0].radius = ground;
    scene.primitives[1].id = "ball", scene.primitives[1].centre = {0, ball, 0}, scene.primitives[1].radius = ball;
    return scene;
}

TEST(Precision, TheIssuesExample) {
    const auto coarse = coarse_positions(ball_on(1e7), Precision::binary32);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->id, "ground");
    EXPECT_EQ(coarse->radius, 1e7);
    EXPECT_DOUBLE_EQ(coarse->error, 1e7 / 16777216);
    EXPECT_EQ(coarse->detail, 1);
    EXPECT_EQ(in_words(*coarse, Precision::binary32),
              "sphere \"ground\" of radius 1e+07: positions are good to 0.6 units in float, details are as small as 1");
    EXPECT_FALSE(coarse_positions(ball_on(1e7), Precision::binary64));
    EXPECT_TRUE(coarse_positions(ball_on(1e17), Precision::binary64));
}

// The threshold lies where errors reach a 128th of the ball: radius 2^17.
TEST(Precision, OrdinaryGroundsAreFineInFloat) {
    for (const double ground : {10.0, 500.0, 1e4, 1e5, 1.3e5})
        EXPECT_FALSE(coarse_positions(ball_on(ground), Precision::binary32)) << ground;
    EXPECT_TRUE(coarse_positions(ball_on(1.4e5), Precision::binary32));
    EXPECT_TRUE(coarse_positions(ball_on(1e5, 0.05), Precision::binary32)) << "smaller details ask for more";
    EXPECT_TRUE(coarse_positions(
        [] {
            Scene scene = ball_on(10);
            for (Primitive& p : scene.primitives) p.centre.x += 1e8;
            scene.camera.position.x += 1e8;
            scene.camera.target.x += 1e8;
            return scene;
        }(),
        Precision::binary32))
        << "far from the origin positions are coarse, too";
}

// What no pixel resolves needs no digits.
TEST(Precision, FarAwayNothingIsCoarse) {
    Scene scene = ball_on(1);
    scene.primitives[0].centre = {0, 0, 1e9};
    scene.primitives[0].radius = 1e8;
    scene.primitives[0].id = "sun";
    EXPECT_FALSE(coarse_positions(scene, Precision::binary32));
    scene.settings.height = 1u << 16;
    scene.camera.fov = 1e-3;
    EXPECT_TRUE(coarse_positions(scene, Precision::binary32)) << "through a telescope it is";
}

// Found by a fuzzer: pixels as wide as a third of the ball the camera is in, whose radius floats round by a tenth.
TEST(Precision, FewPixelsExcuseNothingNearby) {
    Scene scene = ball_on(1);
    scene.settings.width = scene.settings.height = 3;
    for (Primitive& p : scene.primitives) p.centre = {1e17, 1e17, 1e17}, p.radius = 5.5e10;
    scene.camera.position = {1e17, 1e17, 1e17};
    scene.camera.target = {1e17, 1e17, 1.5e17};
    EXPECT_TRUE(coarse_positions(scene, Precision::binary32));
    EXPECT_FALSE(coarse_positions(scene, Precision::binary64));
}

TEST(Precision, AutomaticPicksWhatIsNeeded) {
    const auto picked = [](Scene scene, Precision asked) {
        scene.settings.precision = asked;
        return Plan(std::move(scene)).settings().precision;
    };
    EXPECT_EQ(picked(ball_on(500), Precision::automatic), Precision::binary32);
    EXPECT_EQ(picked(ball_on(1e7), Precision::automatic), Precision::binary64);
    for (const Precision asked : {Precision::binary32, Precision::binary64}) {
        EXPECT_EQ(picked(ball_on(500), asked), asked);
        EXPECT_EQ(picked(ball_on(1e7), asked), asked);
    }
}

TEST(Precision, NumbersOfTheSceneReachDoublesTablesWhole) {
    Scene scene = ball_on(1e7 + 0.3, 1.0 / 3);
    scene.settings.precision = Precision::binary64;
    scene.camera.position = {0.1, 0.2, -1e7 / 3};
    const Plan plan(scene);
    const auto& t = plan.tables<double>();
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(of_scene(plan, t.spheres.cy[i]), scene.primitives[i].centre.y);
        EXPECT_EQ(of_scene(plan, t.spheres.radius[i]), scene.primitives[i].radius);
        EXPECT_EQ(t.spheres.radius2[i], t.spheres.radius[i] * t.spheres.radius[i]);
        EXPECT_EQ(t.spheres.inverse_radius[i], 1 / t.spheres.radius[i]);
    }
    EXPECT_EQ(of_scene(plan, t.camera.px), 0.1);
    EXPECT_EQ(of_scene(plan, t.camera.pz), -1e7 / 3);
    EXPECT_THROW(plan.tables<float>(), std::bad_variant_access);
}

}  // namespace
}  // namespace orrery::test
