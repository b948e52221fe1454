// Which way is up, where the lens focuses, how far DEPTH sees.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "reference/small_scenes.hpp"
#include "reference/world.hpp"

namespace orrery::reference {
namespace {

using glm::dvec3;

// A wide 2:1 image whose camera sees a red light at `right_up`, straight behind the middle of the top right quarter.
std::array<double, 4> quarters(const dvec3& eye, const dvec3& target, const dvec3& right_up) {
    Scene scene = looking(eye, target, 0);
    scene.camera.fov = 90;
    scene.camera.aspect = 2;
    scene.settings.width = scene.settings.height = 2;  // pixels twice as wide as high
    scene.settings.samples = 64;
    add_light(scene, right_up, 0.2, dvec3{1});
    const statistics::BlockImage image = render(scene);
    return {image.at(0, 0)[0].mean, image.at(1, 0)[0].mean, image.at(0, 1)[0].mean, image.at(1, 1)[0].mean};
}

void expect_only_top_right(const std::array<double, 4>& image) {
    EXPECT_GT(image[1], 0);
    EXPECT_EQ(image[0] + image[2] + image[3], 0);
}

TEST(Orientation, LeftHandedWithYUp) {
    expect_only_top_right(quarters({0, 0, 0}, {0, 0, 1}, {1, 0.5, 1}));
    expect_only_top_right(quarters({1, 2, 3}, {1, 2, -7}, {0, 2.5, 2}));  // looking back: right is -x
    expect_only_top_right(quarters({0, 0, 0}, {5, 0, 0}, {1, 0.5, -1}));  // looking along +x: right is -z
}

TEST(Orientation, LookingAlongYUpIsZ) {
    expect_only_top_right(quarters({0, 0, 0}, {0, -1, 0}, {1, -1, 0.5}));
    expect_only_top_right(quarters({0, 0, 0}, {0, 1, 0}, {-1, 1, 0.5}));
}

TEST(Orientation, FieldOfViewIsVerticalAndAspectItsOwn) {
    // A light that covers the view up to the edge of a 60 degree cone fills pi/4 / aspect of the image.
    Scene scene = looking({0, 0, 0}, {0, 0, 3}, 0);
    scene.camera.fov = 60;
    scene.camera.aspect = 3;
    scene.settings.width = 16;
    scene.settings.height = 16;
    scene.settings.samples = 64;
    add_light(scene, {0, 0, 10}, 10 * std::sin(std::numbers::pi / 6), dvec3{1});
    EXPECT_LT(std::abs(deviation(estimate(scene), std::numbers::pi / 4 / 3)), 4);
}

// One narrow pixel looks along the axis through a lens of diameter 0.2 that is focused at 5, at a small sphere at `z`.
double seen_through_lens(double z, double radius, statistics::Estimate& value) {
    Scene scene = looking({1, 2, 3}, {1 + 2, 2 + 1, 3 - 2}, 0);
    const dvec3 axis{2 / 3.0, 1 / 3.0, -2 / 3.0};
    scene.camera.aperture = 0.2;
    scene.camera.focal_distance = 5;
    scene.settings.samples = 40000;
    add_light(scene, scene.camera.position + z * axis, radius, dvec3{1});
    value = estimate(scene);
    return value.mean;
}

TEST(Lens, FocusesAtItsDistanceAlongTheAxis) {
    statistics::Estimate value;
    EXPECT_EQ(seen_through_lens(5, 0.01, value), 1);
    // Elsewhere rays pass the axis at |1 - z/5| times their distance from the middle of the lens.
    for (const double z : {2.5, 10.0}) {
        const double radius = 0.05 * std::abs(1 - z / 5);
        seen_through_lens(z, radius, value);
        EXPECT_LT(std::abs(deviation(value, 0.25)), 4) << z;
    }
}

TEST(Lens, FocusIsAPlane) {
    // Off the axis the point in focus lies at z = 5, not at distance 5.
    Scene scene = looking({0, 0, 0}, {0, 0, 1}, 0);
    scene.camera.fov = 90;
    scene.camera.aperture = 0.2;
    scene.camera.focal_distance = 5;
    scene.settings.width = scene.settings.height = 10001;
    Random random(1, 0);
    for (int i = 0; i < 100; ++i) {
        const Ray ray = camera_ray(scene, 10000, 5000, random);
        const dvec3 focused = ray.origin + ray.direction * (5 / ray.direction.z);
        EXPECT_EQ(ray.origin.z, 0);
        EXPECT_LE(glm::length(ray.origin), 0.1);
        EXPECT_LT(glm::length(focused - dvec3{5, 0, 5}), 2e-3);
    }
}

TEST(Depth, IsDistanceAlongTheRayOfAnySurface) {
    Scene scene = looking({0, 0, -4}, {0, 0, 0}, 0, Integrator::depth);
    add_sphere(scene, {0, 0, 0}, 1, glass(1, 1.5));
    EXPECT_NEAR(estimate(scene).mean, 1 / (1 + 3.0), 1e-9);
    EXPECT_NEAR(estimate(scene, {.post_process = false}).mean, 3, 1e-9);
    scene.camera.position = {0, 0, 0.5};  // from inside, looking back
    EXPECT_NEAR(estimate(scene).mean, 1 / (1 + 1.5), 1e-9);
}

TEST(Depth, OfTheEnclosingVolumeIsFiniteAndFarther) {
    Scene scene = looking({0, 0, -4}, {0, 0, -8}, 0, Integrator::depth);
    EXPECT_EQ(estimate(scene, {.post_process = false}).mean, 1);
    add_sphere(scene, {0, 0, 0}, 1, diffuse(dvec3{1}));
    scene.camera.aperture = 0.5;
    EXPECT_EQ(estimate(scene, {.post_process = false}).mean, 2 * (4 + 1 + 0.25));
}

TEST(Depth, ErrorOfTheProcessedMeanFollowsThatOfTheDistance) {
    Scene scene = looking({0, 0, -4}, {0, 0, 0}, 0, Integrator::depth);
    scene.camera.fov = 45;
    scene.settings.samples = 1000;
    add_sphere(scene, {0, 0, 0}, 1, diffuse(dvec3{1}));
    const statistics::Estimate far = estimate(scene, {.post_process = false}), processed = estimate(scene);
    EXPECT_NEAR(processed.mean, 1 / (1 + far.mean), 1e-12);
    EXPECT_NEAR(processed.standard_error(), far.standard_error() / std::pow(1 + far.mean, 2), 1e-12);
}

}  // namespace
}  // namespace orrery::reference
