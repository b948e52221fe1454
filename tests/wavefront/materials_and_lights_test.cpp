// The grid: every material under every light through every integrator, against the reference renderer.
#include <gtest/gtest.h>

#include <tuple>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

struct NamedMaterial {
    const char* name;
    Material material;
};

const std::vector<NamedMaterial> materials = {
    {"Diffuse", diffuse({0.7, 0.4, 0.2})},
    {"Specular", tinted(mirror(0), {0.9, 0.6, 0.3})},
    {"SharpGlossy", tinted(glossy(0, 0.05), {0.9, 0.6, 0.3})},
    {"WideGlossy", tinted(glossy(0, 0.6), {0.9, 0.6, 0.3})},
    {"Dielectric", tinted(glass(0, 1.5), {0.9, 0.8, 0.7}, {0.6, 0.8, 1})},
    {"Translucent", tinted(glass(0, 1.5, 0.3), {0.9, 0.8, 0.7}, {0.6, 0.8, 1})},
};

struct NamedLight {
    const char* name;
    void (*add)(Scene&);
};

// Area lights are large, so that paths which find them by chance, the reference's among them, find them often.
const std::vector<NamedLight> lights = {
    {"Area",
     [](Scene& scene) {
         add_lamp(scene, {1.7, 3.2, -1.5}, 1, {4, 3, 5});
     }},
    {"Background",
     [](Scene& scene) {
         scene.background = {0.5, 0.7, 1};
     }},
    {"InsideAnEmitter",
     [](Scene& scene) {
         add_lamp(scene, {0, -35, 0}, 60, {0.5, 0.7, 1});
     }},
};

template <class Named>
std::string name_of_parameter(const testing::TestParamInfo<Named>& parameter) {
    return parameter.param.name;
}

using MaterialAndLight = std::tuple<NamedMaterial, NamedLight>;
class Grid : public testing::TestWithParam<MaterialAndLight> {
protected:
    static Scene scene() {
        const auto& [material, light] = GetParam();
        Scene lit = still_life(material.material);
        light.add(lit);
        return lit;
    }
};

TEST_P(Grid, PathTracing) { expect_agreement(scene()); }

TEST_P(Grid, Whitted) {
    Scene lit = scene();
    lit.settings.integrator = Integrator::whitted;
    expect_agreement(lit);
}

INSTANTIATE_TEST_SUITE_P(Of, Grid, testing::Combine(testing::ValuesIn(materials), testing::ValuesIn(lights)),
                         [](const testing::TestParamInfo<MaterialAndLight>& parameter) {
                             return std::string(std::get<0>(parameter.param).name) + "By" +
                                    std::get<1>(parameter.param).name;
                         });

// Point lights have a grid of their own, without rough lobes: what those return of a point light has an infinite
// variance at the lobe's edge. See point_light_lobes_test.cpp.
class PointLit : public testing::TestWithParam<NamedMaterial> {};

TEST_P(PointLit, PathTracing) {
    Scene lit = still_life(GetParam().material);
    add_point_light(lit, {2, 4, -3}, {60, 50, 40});
    add_point_light(lit, {-3, 1, -1}, {3, 5, 9});
    expect_agreement(lit);
}

TEST_P(PointLit, Whitted) {
    Scene lit = still_life(GetParam().material);
    add_point_light(lit, {2, 4, -3}, {60, 50, 40});
    add_point_light(lit, {-3, 1, -1}, {3, 5, 9});
    lit.settings.integrator = Integrator::whitted;
    expect_agreement(lit);
}

INSTANTIATE_TEST_SUITE_P(Of, PointLit, testing::Values(materials[0], materials[1], materials[4]),
                         name_of_parameter<NamedMaterial>);

Scene through_a_lens(Integrator integrator) {
    Scene scene = still_life(tinted(glossy(0, 0.3), {0.9, 0.6, 0.3}));
    add_lamp(scene, {1.7, 3.2, -1.5}, 1, {4, 3, 5});
    scene.background = {0.2, 0.3, 0.4};
    scene.camera.aperture = 1.5;
    scene.camera.focal_distance = 4;
    scene.camera.aspect = 1.6;  // pixels need not be square
    scene.settings.integrator = integrator;
    return scene;
}

TEST(Lens, PathTracing) { expect_agreement(through_a_lens(Integrator::path_tracing)); }
TEST(Lens, Whitted) { expect_agreement(through_a_lens(Integrator::whitted)); }
TEST(Lens, Depth) { expect_agreement(through_a_lens(Integrator::depth)); }

TEST(Pinhole, Depth) {
    Scene scene = still_life(diffuse(dvec3{0}));
    scene.settings.integrator = Integrator::depth;
    expect_agreement(scene);
}

TEST(Depth, SeesTheInsideOfASphere) {
    Scene scene = picture({0.3, 0.2, 0.1}, {1, 1, 1}, 120, 0);
    add_sphere(scene, {0, 0, 0}, 2, diffuse(dvec3{0}));
    add_sphere(scene, {1, 1, 1}, 0.3, glass(1, 1.5));
    scene.settings.integrator = Integrator::depth;
    expect_agreement(scene);
}

}  // namespace
}  // namespace orrery::test
