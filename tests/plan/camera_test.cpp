// The camera table, against the conventions of scenes/README.md.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "plan/worlds.hpp"

namespace orrery::test {
namespace {

struct Frame {
    dvec3 x, y, z;
};

Frame frame_of(const dvec3& position, const dvec3& target) {
    Scene scene = empty_world();
    scene.camera.position = position;
    scene.camera.target = target;
    const Plan plan(scene);
    const auto& c = plan.tables().camera;
    EXPECT_EQ(of_scene(plan, dvec3{c.px, c.py, c.pz}), position);
    return {{c.xx, c.xy, c.xz}, {c.yx, c.yy, c.yz}, {c.zx, c.zy, c.zz}};
}

void expect_near(const dvec3& value, const dvec3& expected) {
    EXPECT_LT(glm::length(value - expected), 1e-6) << value.x << ' ' << value.y << ' ' << value.z;
}

TEST(Frame, HasTheTargetAheadOnZAndXToTheRight) {
    const Frame ahead = frame_of({0, 0, 0}, {0, 0, 5});
    expect_near(ahead.x, {1, 0, 0});
    expect_near(ahead.y, {0, 1, 0});
    expect_near(ahead.z, {0, 0, 1});
    const Frame back = frame_of({1, 2, 3}, {1, 2, -3});  // turned round, right is left
    expect_near(back.x, {-1, 0, 0});
    expect_near(back.y, {0, 1, 0});
    expect_near(back.z, {0, 0, -1});
    const Frame sideways = frame_of({0, 0, 0}, {7, 0, 0});
    expect_near(sideways.x, {0, 0, -1});
    expect_near(sideways.y, {0, 1, 0});
}

TEST(Frame, IsOrthonormalAndLeftHanded) {
    for (const dvec3& to : {dvec3{1, 2, 3}, {-4, 0.1, 2}, {1e-3, 5, 1e-3}, {3, -9, -1}}) {
        const Frame f = frame_of({0.5, -1, 2}, dvec3{0.5, -1, 2} + to);
        expect_near(f.z, glm::normalize(to));
        for (const dvec3& axis : {f.x, f.y, f.z}) EXPECT_NEAR(glm::length(axis), 1, 1e-6);
        EXPECT_NEAR(glm::dot(f.x, f.z), 0, 1e-6);
        expect_near(f.y, glm::cross(f.z, f.x));
        EXPECT_GT(f.y.y, 0) << "up is up";
        EXPECT_EQ(f.x.y, 0) << "the horizon is level";
    }
}

TEST(Frame, TakesZForUpWhereUpIsAhead) {
    const Frame up = frame_of({1, 1, 1}, {1, 4, 1});
    expect_near(up.z, {0, 1, 0});
    expect_near(up.x, glm::cross(dvec3{0, 0, 1}, dvec3{0, 1, 0}));
    expect_near(up.y, {0, 0, 1});
    const Frame down = frame_of({1, 1, 1}, {1, -4, 1});
    expect_near(down.x, {1, 0, 0});
    expect_near(down.y, {0, 0, 1});
}

TEST(ImagePlane, IsCutIntoPixelsAndCells) {
    Scene scene = empty_world();
    scene.camera.fov = 90;  // half the height is tan 45 degrees = 1
    scene.camera.aspect = 1.5;
    scene.settings.width = 30;
    scene.settings.height = 10;
    scene.settings.samples = 10;
    scene.settings.estimator = Estimator::stratified;
    {
        const Plan plan(scene);
        EXPECT_NEAR(plan.half_height(), 1, 1e-15);
        EXPECT_NEAR(plan.half_width(), 1.5, 1e-15);
        EXPECT_EQ(plan.strata(), 3u);
        EXPECT_FLOAT_EQ(plan.tables().camera.cell_width, 3.0f / 30 / 3);
        EXPECT_FLOAT_EQ(plan.tables().camera.cell_height, -2.0f / 10 / 3) << "down";
    }
    scene.settings.estimator = Estimator::uniform;
    const Plan plan(scene);
    EXPECT_FLOAT_EQ(plan.tables().camera.cell_width, 3.0f / 30) << "the pixel is one cell";
    EXPECT_FLOAT_EQ(plan.tables().camera.cell_height, -2.0f / 10);
}

TEST(Lens, HasHalfTheApertureForRadius) {
    Scene scene = empty_world();
    scene.camera.aperture = 0.5;
    scene.camera.focal_distance = 7;
    const Plan plan(scene);
    EXPECT_EQ(of_scene(plan, plan.tables().camera.lens_radius), 0.25);
    EXPECT_EQ(of_scene(plan, plan.tables().camera.focal_distance), 7.0);
}

TEST(EnclosingDistance, ExceedsEveryHit) {
    for (const double aperture : {0.0, 3.0}) {
        for (const double size : {1e-3, 1.0, 1e6}) {
            Scene scene = world({MaterialKind::diffuse, MaterialKind::specular, MaterialKind::dielectric});
            scene.camera.position = {3, -2, 1};
            scene.camera.target = {0, 0, 0};
            scene.camera.aperture = aperture;
            scene.primitives[1].centre = {-size, size, 7};
            scene.primitives[2].radius = size;
            double farthest = 0;  // from the far rim of the lens to the far side of a sphere
            for (const Primitive& p : scene.primitives)
                farthest = std::max(farthest, glm::length(p.centre - scene.camera.position) + p.radius + aperture / 2);
            EXPECT_GT(Plan(scene).tables().enclosing_distance, farthest);
            EXPECT_TRUE(std::isfinite(Plan(scene).tables().enclosing_distance));
        }
    }
    EXPECT_GT(Plan(empty_world()).tables().enclosing_distance, 0);
    EXPECT_TRUE(std::isfinite(Plan(empty_world()).tables().enclosing_distance));
}

TEST(Samples, AreRoundedDownToASquareOrAnEvenNumber) {
    for (const auto& [asked, side] : {std::pair{1u, 1u},
                                      {2u, 1u},
                                      {3u, 1u},
                                      {4u, 2u},
                                      {8u, 2u},
                                      {9u, 3u},
                                      {15u, 3u},
                                      {1000u, 31u},
                                      {0x3fffffffu, 32767u},
                                      {0x40000000u, 32768u},
                                      {0xfffe0001u, 65535u},
                                      {0xffffffffu, 65535u}}) {
        Scene scene = empty_world();
        scene.settings.samples = asked;
        scene.settings.estimator = Estimator::stratified;
        EXPECT_EQ(Plan(scene).strata(), side) << asked;
        EXPECT_EQ(Plan(scene).samples(), side * side) << asked;
        scene.settings.estimator = Estimator::uniform;
        EXPECT_EQ(Plan(scene).strata(), 1u);
        EXPECT_EQ(Plan(scene).samples(), asked);
        scene.settings.estimator = Estimator::sobol;
        EXPECT_EQ(Plan(scene).samples(), asked == 1 ? 1 : asked / 2 * 2) << "as many of both sequences";
    }
}

}  // namespace
}  // namespace orrery::test
