// Scenes on which an estimator could go wrong: all settings must agree with each other and with the reference.
#include <gtest/gtest.h>

#include <cmath>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

const Material clear = glass(1, 1.5);

TEST(HardScene, CameraInsideALightOfGlass) {
    Scene scene = still_life(diffuse({0.7, 0.4, 0.2}));
    add_lamp(scene, scene.camera.position, 1.2, {0.6, 0.8, 1}, glass(0.9, 1.2));
    expect_agreement(scene);
}

TEST(HardScene, CameraAndObjectsInsideADiffuseLight) {
    Scene scene = picture({0.5, 0.4, -1.5}, {0, 0, 0}, 60, 5);
    add_lamp(scene, {0, 0, 0}, 2, {1, 0.6, 0.3}, diffuse({0.5, 0.7, 0.2}));
    add_sphere(scene, {-0.4, 0, 0}, 0.5, glossy(0.8, 0.4));
    add_sphere(scene, {0.6, -0.2, 0.2}, 0.4, diffuse({0.2, 0.5, 0.8}));
    expect_agreement(scene);
}

TEST(HardScene, LightInsideGlass) {
    for (const double roughness : {0.0, 0.2}) {
        Scene scene = still_life(glass(0.95, 1.5, roughness), 6);
        add_lamp(scene, {-0.5, 1, 0}, 0.5, {4, 3, 5});
        expect_agreement(scene, {.samples = 400});
    }
}

TEST(HardScene, NestedGlass) {
    Scene scene = still_life(clear, 8);
    add_sphere(scene, {-0.5, 1, 0}, 0.8, tinted(glass(0, 0.7), {0.9, 0.8, 0.7}, {0.7, 0.8, 0.9}));
    add_sphere(scene, {-0.5, 1, 0}, 0.5, tinted(glass(0, 1.3, 0.1), {0.9, 0.8, 0.7}, {0.7, 0.8, 0.9}));
    add_lamp(scene, {1.7, 3.2, -1.5}, 1, {4, 3, 5});
    scene.background = {0.3, 0.4, 0.5};
    expect_agreement(scene);
    scene.settings.integrator = Integrator::whitted;
    scene.settings.depth = 6;  // the reference follows every branch
    expect_agreement(scene, {.reference_samples = 400});
}

Scene overlapping() {
    Scene scene = still_life(clear, 6);
    add_sphere(scene, {0, 1.3, -0.2}, 0.7, glass(0.9, 1.3));             // glass in glass
    add_sphere(scene, {1.3, 0.9, -0.5}, 0.5, diffuse({0.7, 0.3, 0.2}));  // diffuse in diffuse
    add_sphere(scene, {1.2, 0.2, -1.2}, 0.5, mirror(0.8));               // mirror in the floor
    return scene;
}

TEST(HardScene, OverlappingSpheres) {
    Scene scene = overlapping();
    add_lamp(scene, {-1.6, 0.2, -0.6}, 0.7, {2, 3, 1}, diffuse(dvec3{0.5}));  // light in the floor and in glass
    add_lamp(scene, {-1.9, 0.6, -0.9}, 0.5, {1, 2, 3}, glossy(0.5, 0.5));     // light in light
    expect_agreement_of(finite_at_contact(path_variants(scene)), scene, {});
}

// As seen by Whitted, where the reference samples the areas of lights: these keep their distance from diffuse surfaces.
TEST(HardScene, OverlappingSpheresInWhittedsEyes) {
    Scene scene = overlapping();
    scene.settings.integrator = Integrator::whitted;
    add_lamp(scene, {-1.3, 2.0, -0.2}, 0.6, {2, 3, 1}, mirror(0.5));  // light in glass
    add_lamp(scene, {-1.7, 2.3, -0.5}, 0.5, {1, 2, 3}, mirror(0.5));  // light in light
    expect_agreement(scene, {.reference_samples = 600});
}

class EmissiveMaterial : public testing::TestWithParam<Material> {};

// The emitter is the object itself: its own reflections and, of glass, the light from its far side pass through it.
TEST_P(EmissiveMaterial, LightsItsSurroundingsAndReflectsThem) {
    Scene scene = still_life(GetParam(), 5);
    scene.primitives[1].emission = dvec3{0.8, 1, 1.2};
    add_sphere(scene, {-2.2, 0.6, -0.5}, 0.6, diffuse({0.7, 0.3, 0.5}));
    expect_agreement(scene);
}

std::string kind_of(const testing::TestParamInfo<Material>& parameter) {
    constexpr const char* kinds[] = {"Diffuse", "Specular", "Glossy", "Dielectric", "Translucent"};
    return kinds[static_cast<std::size_t>(parameter.param.kind)];
}

INSTANTIATE_TEST_SUITE_P(Of, EmissiveMaterial,
                         testing::Values(diffuse({0.5, 0.6, 0.7}), mirror(0.9), glossy(0.9, 0.3), glass(0.9, 1.5),
                                         glass(0.9, 1.5, 0.4)),
                         kind_of);

// Next to the point of contact the light fills half the sky, and rounding decides which of the two is nearer.
TEST(HardScene, LightTouchingTheFloor) {
    Scene scene = still_life(diffuse({0.7, 0.4, 0.2}));
    add_lamp(scene, {0.2, 0.5, -1.8}, 0.5, {2, 3, 4});
    expect_agreement_of(finite_at_contact(path_variants(scene)), scene, {});
    scene.primitives[0].material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(glossy(0.9, 0.5));
    expect_agreement_of(finite_at_contact(path_variants(scene)), scene, {});
}

TEST(HardScene, ManyLights) {
    Scene scene = still_life(glossy(0.8, 0.3), 3);
    for (int i = 0; i < 20; ++i) {
        const double angle = i * 0.7, height = 2 + 0.1 * i;
        const dvec3 colour{1 + 0.2 * i, 3 - 0.1 * i, 2};
        add_lamp(scene, {2.5 * std::cos(angle), height, 2.5 * std::sin(angle)}, 0.25, colour);
    }
    expect_agreement(scene, {.samples = 144, .reference_samples = 700});
}

TEST(HardScene, CrowdOfSpheres) {
    for (const Integrator integrator : all_integrators) {
        Scene scene = crowd(integrator);
        if (integrator == Integrator::whitted) scene.settings.depth = 3;  // the reference follows every branch
        expect_agreement(scene, {.samples = 100, .reference_samples = 300});
    }
}

TEST(HardScene, SmallFarLight) {
    Scene scene = still_life(diffuse({0.7, 0.4, 0.2}), 3);
    add_lamp(scene, {30, 40, -30}, 0.05, {9e4, 8e4, 7e4});
    auto variants = path_variants(scene);
    std::erase_if(variants, [](const Variant& v) { return v.name == "naive"; });  // would hardly ever run into it
    expect_agreement_of(variants, scene, {.next_event = true});
}

// Light that rough lobes of every width find by scattering and by light sampling: mis must weigh the two right.
TEST(HardScene, GlossyPlatesUnderOneLight) {
    Scene scene = picture({0, 2.5, -6}, {0, 0.6, 0}, 40, 2);
    const double widths[] = {0.03, 0.1, 0.3, 0.6, 0.98};
    for (int i = 0; i < 5; ++i) add_sphere(scene, {1.2 * i - 2.4, 0.6, 0}, 0.6, glossy(0.9, widths[i]));
    add_lamp(scene, {0, 3, 1}, 1.5, {2, 3, 4});
    scene.background = dvec3{0.1};
    expect_agreement(scene);
}

class DepthLimit : public testing::TestWithParam<std::uint32_t> {};

TEST_P(DepthLimit, CountsScatteringEvents) {
    Scene scene = still_life(glass(0.95, 1.5), GetParam());
    add_sphere(scene, {1.5, 1.6, 0.6}, 0.6, mirror(0.9));
    add_lamp(scene, {1.7, 3.2, -1.5}, 1, {4, 3, 5});
    add_point_light(scene, {-3, 3, -3}, {20, 30, 10});
    scene.background = {0.3, 0.2, 0.1};
    expect_agreement(scene, {.reference_samples = 1000});
}

// Without a background nee leaves the last pass of its loop to the rays that are not diffuse, or out altogether.
TEST_P(DepthLimit, CountsTheSameInTheDark) {
    Scene scene = still_life(glossy(0.9, 0.3), GetParam());
    add_lamp(scene, {1.7, 3.2, -1.5}, 1, {4, 3, 5});
    expect_agreement(scene, {.reference_samples = 1000});
}

TEST_P(DepthLimit, CountsAloneNodesOfAWhittedTree) {
    Scene scene = still_life(glass(0.95, 1.5), std::min(GetParam(), 7u));  // the reference follows every branch
    add_sphere(scene, {1.5, 1.6, 0.6}, 0.6, mirror(0.9));
    add_lamp(scene, {1.7, 3.2, -1.5}, 1, {4, 3, 5});
    scene.background = {0.3, 0.2, 0.1};
    scene.settings.integrator = Integrator::whitted;
    expect_agreement(scene, {.reference_samples = 400});
}

INSTANTIATE_TEST_SUITE_P(Of, DepthLimit, testing::Values(0u, 1u, 2u, 20u));

}  // namespace
}  // namespace orrery::test
