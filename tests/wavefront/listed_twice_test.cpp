// A surface listed twice, and surfaces so close that a number type may not tell them apart: paths must not be caught
// between them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

constexpr double ulp = 0x1p-52, float_ulp = 0x1p-23;
const dvec3 place{0.3, -0.45, 0.7};

/// A ball that fills the image, before a background of 1.
Scene before_white(const Material& material) {
    Scene scene = picture(place - dvec3{0, 0, 4}, place, 10, 4000);
    scene.settings.samples = 64;
    scene.settings.estimator = Estimator::stratified;
    scene.settings.roulette = false;
    scene.background = dvec3{1};
    add_sphere(scene, place, 1, material);
    return scene;
}

/// The ball, moved and grown, listed behind it.
Scene twice(const Material& material, const dvec3& moved, double grown = 0) {
    Scene scene = before_white(material);
    scene.primitives.push_back(scene.primitives[0]);
    scene.primitives[1].centre += moved;
    scene.primitives[1].radius += grown;
    return scene;
}

void expect_all(Scene scene, Precision precision, float expected, double tolerance, double shift) {
    scene.settings.precision = precision;
    for (const Isa isa : supported_isas())
        for (const Rgb& pixel : image_of(scene, {.isa = isa}).pixels)
            ASSERT_NEAR(pixel.g, expected, tolerance) << isa_name(isa) << ", " << shift << " apart";
}

// What float takes for one surface, double for two, and what neither does: rho is what comes back in any case.
TEST(ListedTwice, ReturnsWhatOneSurfaceReturns) {
    const dvec3 along = glm::normalize(dvec3{2, -1, 1});
    for (const double shift :
         {0.0, ulp, 2 * ulp, 3 * ulp, 1e-13, 1e-10, 1e-8, float_ulp, 3 * float_ulp, 1e-6, 3e-6, 1e-4}) {
        for (const Scene& scene :
             {twice(diffuse(dvec3{0.5}), shift * along), twice(diffuse(dvec3{0.5}), -shift * along),
              twice(diffuse(dvec3{0.5}), dvec3{0}, shift), twice(diffuse(dvec3{0.5}), dvec3{0}, -shift)})
            expect_all(scene, Precision::automatic, 0.5f, 1e-6, shift);
        for (const Scene& scene : {twice(glass(1, 1.5), shift * along), twice(glass(1, 1.5), dvec3{0}, -shift)})
            expect_all(scene, Precision::automatic, 1, 1e-4, shift);
    }
    for (const double shift : {ulp, float_ulp, 3 * float_ulp}) {
        expect_all(twice(diffuse(dvec3{0.5}), shift * along), Precision::binary32, 0.5f, 1e-6, shift);
        expect_all(twice(glass(1, 1.5), shift * along), Precision::binary32, 1, 1e-4, shift);
    }
    for (const double shift : {ulp, 3 * ulp}) {
        expect_all(twice(diffuse(dvec3{0.5}), shift * along), Precision::binary64, 0.5f, 1e-6, shift);
        expect_all(twice(glass(1, 1.5), shift * along), Precision::binary64, 1, 1e-4, shift);
    }
}

// A thin shell of glass of another index does what it does however thin it is: twice the weight of two interfaces.
TEST(ListedTwice, AThinShellIsNone) {
    const auto shell = [](double thickness, double rho) {
        Scene scene = before_white(glass(rho, 1.5));
        add_sphere(scene, place, 1 - thickness, glass(rho, 1.0 / 1.5));  // hollow: air within
        return scene;
    };
    for (const double thickness : {1e-4, 1e-6, 1e-8, 1e-12})
        expect_all(shell(thickness, 1), Precision::automatic, 1, 1e-4, thickness);
    // The mean over the image, where every crossing costs a tenth.
    const auto mean = [&](double thickness) {
        double sum = 0;
        for (const Rgb& pixel : image_of(shell(thickness, 0.9)).pixels) sum += pixel.g;
        return sum / 256;
    };
    const double thick = mean(1e-4);
    for (const double thickness : {1e-6, 1e-8, 1e-12}) EXPECT_NEAR(mean(thickness), thick, 0.01 * thick) << thickness;
}

// The first listed has it all: material, light, and its place in every integrator.
TEST(ListedTwice, LightsAndDistancesAreTheFirsts) {
    for (const Integrator integrator : all_integrators) {
        for (const double shift : {0.0, 2 * ulp}) {
            for (const bool lamp_first : {false, true}) {
                Scene scene = picture({0, 0, -3}, {0, 0, 0}, 10, 3);
                scene.settings.integrator = integrator;
                add_lamp(scene, {0, 0, 0}, 1, dvec3{2}, diffuse(dvec3{0}));
                add_sphere(scene, {0, 0, 0}, 1, diffuse(dvec3{0.5}));
                add_point_light(scene, {0, 0, -4}, dvec3{3});
                if (!lamp_first) std::swap(scene.primitives[0], scene.primitives[1]);
                Scene alone = scene;
                alone.primitives.pop_back();
                scene.primitives[1].centre.x += shift;
                EXPECT_EQ(image_of(scene).pixels, image_of(alone).pixels) << name_of(integrator);
            }
        }
    }
}

}  // namespace
}  // namespace orrery::test
