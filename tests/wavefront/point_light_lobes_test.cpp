// Point lights through the density of rough lobes.
//
// That density grows without bound towards the lobe's edge and its square has no integral: what a path of random
// vertices returns of a point light has an infinite variance, and no z-test a meaning. So the camera looks straight at
// the rough surface, one event deep, with the light well within the lobe of every point it sees: the values are smooth.
#include <gtest/gtest.h>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

// Looks from `eye` at the north pole of a sphere of radius 10.
Scene pole(const dvec3& eye, const Material& material) {
    Scene scene = picture(eye, {0, 0, 0}, 6, 1);
    add_sphere(scene, {0, -10, 0}, 10, material);
    return scene;
}

class Roughness : public testing::TestWithParam<double> {};

TEST_P(Roughness, GlossyFromAbove) {
    Scene scene = pole({-2, 3, 0}, tinted(glossy(0, GetParam()), {0.9, 0.6, 0.3}));
    add_point_light(scene, {2, 3.2, 0.2}, {10, 12, 14});
    expect_agreement(scene);
}

// At grazing incidence much of the lobe would dip below the surface: the conditioning on the reflecting side counts.
TEST_P(Roughness, GlossyNearGrazing) {
    Scene scene = pole({-3, 0.6, 0}, tinted(glossy(0, GetParam()), {0.9, 0.6, 0.3}));
    scene.camera.fov = 3;
    add_point_light(scene, {3, 0.9, 0.2}, {10, 12, 14});
    expect_agreement(scene);
}

// A light beside the mirror direction and one beside the refracted one, which is inside the sphere.
TEST_P(Roughness, TranslucentFromOutside) {
    Scene scene = pole({-1, 2, 0}, tinted(glass(0, 1.5, GetParam()), {0.9, 0.6, 0.3}, {0.3, 0.6, 0.9}));
    add_point_light(scene, {1, 2.2, 0.1}, {40, 50, 60});
    add_point_light(scene, {0.6, -2, 0.1}, {10, 12, 14});
    expect_agreement(scene);
}

TEST_P(Roughness, TranslucentFromInside) {
    Scene scene = pole({-0.5, -2, 0}, tinted(glass(0, 1.5, GetParam()), {0.9, 0.6, 0.3}, {0.3, 0.6, 0.9}));
    add_point_light(scene, {0.5, -2.2, 0.1}, {400, 500, 600});
    add_point_light(scene, {0.7, 2, 0.1}, {10, 12, 14});
    expect_agreement(scene);
}

INSTANTIATE_TEST_SUITE_P(Of, Roughness, testing::Values(0.4, 0.6, 0.95),
                         [](const testing::TestParamInfo<double>& parameter) {
                             return "Beta" + std::to_string(static_cast<int>(100 * parameter.param));
                         });

// Beyond the edge of a lobe, or below the surface, a point light returns nothing at all.
TEST(PointLight, ReturnsNothingOutsideTheLobe) {
    Scene scene = pole({-2, 3, 0}, glossy(1, 0.3));
    add_point_light(scene, {-2, 3, 2}, dvec3{10});
    add_point_light(scene, {3, -4, 0}, dvec3{10});
    EXPECT_EQ(image_of(scene).pixels, std::vector<Rgb>(256));
}

// Deeper than the first event the variance is infinite, but by a logarithm only: a mean of n samples is still nearly
// normal, with an error that shrinks a little slower than 1/sqrt(n). Wrong sides or signs would show regardless.
TEST(PointLight, ReachesThroughATranslucentBallAndOffGlossyNeighbours) {
    Scene scene = still_life(tinted(glass(0, 1.4, 0.7), {0.9, 0.8, 0.7}, {0.6, 0.8, 1}));
    add_sphere(scene, {1.4, 1.2, 0.9}, 0.7, tinted(glossy(0, 0.8), {0.9, 0.7, 0.5}));
    add_point_light(scene, {2, 4, -3}, {60, 50, 40});
    add_point_light(scene, {-2, 3, 2}, {20, 30, 40});
    expect_agreement(scene, {.samples = 400, .reference_samples = 2000});
}

}  // namespace
}  // namespace orrery::test
