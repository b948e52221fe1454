// A scene built by hand may hold what no file may: then there is no plan.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "plan/worlds.hpp"

namespace orrery::test {
namespace {

using enum MaterialKind;

struct Fault {
    const char* name;
    void (*commit)(Scene&);
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

class Invalid : public testing::TestWithParam<Fault> {};

TEST_P(Invalid, SceneThrows) {
    Scene scene = world({diffuse, dielectric});
    add_area_light(scene);
    add_point_light(scene);
    EXPECT_NO_THROW(Plan{scene});
    GetParam().commit(scene);
    EXPECT_THROW(Plan{scene}, std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(
    Because, Invalid,
    testing::Values(Fault{"NoWidth", [](Scene& s) { s.settings.width = 0; }},
                    Fault{"NoHeight", [](Scene& s) { s.settings.height = 0; }},
                    Fault{"NoSamples", [](Scene& s) { s.settings.samples = 0; }},
                    Fault{"WhittedDeeperThan20",
                          [](Scene& s) {
                              s.settings.integrator = Integrator::whitted;
                              s.settings.depth = 21;
                          }},
                    Fault{"NoSuchMaterial", [](Scene& s) { s.primitives[0].material = 3; }},
                    Fault{"TargetAtThePosition", [](Scene& s) { s.camera.target = s.camera.position; }},
                    Fault{"NoFieldOfView", [](Scene& s) { s.camera.fov = 0; }},
                    Fault{"FieldOfViewOfHalfATurn", [](Scene& s) { s.camera.fov = 180; }},
                    Fault{"NoAspect", [](Scene& s) { s.camera.aspect = 0; }},
                    Fault{"NegativeAperture", [](Scene& s) { s.camera.aperture = -1; }},
                    Fault{"LensWithoutFocalDistance",
                          [](Scene& s) {
                              s.camera.aperture = 1;
                              s.camera.focal_distance = 0;
                          }},
                    Fault{"NoRadius", [](Scene& s) { s.primitives[0].radius = 0; }},
                    Fault{"NegativeRadius", [](Scene& s) { s.primitives[0].radius = -1; }},
                    Fault{"RadiusThatIsNoNumber", [](Scene& s) { s.primitives[0].radius = nan; }},
                    Fault{"RadiusTooSmallForFloat", [](Scene& s) { s.primitives[0].radius = 0.99e-18; }},
                    Fault{"CentreTooFarForFloat", [](Scene& s) { s.primitives[0].centre.z = -1.01e18; }},
                    Fault{"WiderThanAnImageMayBe", [](Scene& s) { s.settings.width = 65537; }},
                    Fault{"NoSuchTransport", [](Scene& s) { s.settings.transport = static_cast<Transport>(3); }},
                    Fault{"ApertureTooSmallForFloat", [](Scene& s) { s.camera.aperture = 1e-19; }},
                    Fault{"CameraFarther", [](Scene& s) { s.camera.position.x = 1e19; }},
                    Fault{"FlatterThanAnImagePlaneMayBe", [](Scene& s) { s.camera.aspect = 1e7; }},
                    Fault{"IndexOfRefractionBeyondReason", [](Scene& s) { s.materials[1].eta = 1e-7; }},
                    Fault{"RoughnessOfOne", [](Scene& s) { s.materials[0].roughness = 1; }},
                    Fault{"RoughnessThatRoundsToOne", [](Scene& s) { s.materials[0].roughness = 1 - 1e-9; }},
                    Fault{"GlossWithoutRoughness",
                          [](Scene& s) {
                              s.materials[0].kind = glossy;
                              s.materials[0].roughness = 0;
                          }},
                    Fault{"TranslucenceWithoutRoughness",
                          [](Scene& s) {
                              s.materials[1].kind = translucent;
                              s.materials[1].roughness = 0;
                          }},
                    Fault{"LightBrighterThanALampMayBe", [](Scene& s) { s.point_lights[0].intensity.g = 1.01e30; }},
                    Fault{"LightFarther", [](Scene& s) { s.point_lights[0].position.y = 1e19; }},
                    Fault{"NegativeBackground", [](Scene& s) { s.background.b = -1; }},
                    Fault{"CentreAtInfinity", [](Scene& s) { s.primitives[0].centre.y = inf; }},
                    Fault{"NoIndexOfRefraction", [](Scene& s) { s.materials[1].eta = 0; }},
                    Fault{"ReflectanceAboveOne", [](Scene& s) { s.materials[0].rho.g = 1.5; }},
                    Fault{"NegativeEmission", [](Scene& s) { s.primitives[2].emission = dvec3{-1}; }},
                    Fault{"InfiniteIntensity", [](Scene& s) { s.point_lights[0].intensity.r = inf; }}),
    [](const testing::TestParamInfo<Fault>& parameter) { return parameter.param.name; });

TEST(Valid, LimitsAreInside) {
    Scene scene = world({diffuse});
    scene.settings.integrator = Integrator::whitted;
    scene.settings.depth = 20;
    scene.settings.width = 65536;
    scene.camera.fov = 179.9;
    scene.materials[0].kind = glossy;
    scene.materials[0].roughness = 1e-6;
    scene.primitives[0].centre = {1e18, -1e18, 0};
    scene.primitives[0].radius = 1e-18;
    scene.background = dvec3{1e30};
    EXPECT_NO_THROW(Plan{scene});
}

}  // namespace
}  // namespace orrery::test
