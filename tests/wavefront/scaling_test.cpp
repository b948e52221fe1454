// There is no length in the program: a world 2^k times as large gives the same bytes.
#include <gtest/gtest.h>

#include <cmath>

#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

struct Case {
    const char* name;
    Scene scene;
};

std::vector<Case> cases() {
    std::vector<Case> all = {{"PT", everything()}, {"WRT", everything(Integrator::whitted)}};
    all.push_back({"PT, nee, area, uniform, pinhole", everything()});
    RenderSettings& nee = all.back().scene.settings;
    nee.transport = Transport::nee;
    nee.light_sampling = LightSampling::area;
    nee.estimator = Estimator::uniform;
    nee.roulette = false;
    all.back().scene.camera.aperture = 0;
    all.push_back({"PT, naive", everything()});
    all.back().scene.settings.transport = Transport::naive;
    all.push_back({"PT, a crowd", crowd()});
    // Sizes from a bead to a planet, and the camera between them.
    Scene wide = picture({0, 0.01, -0.05}, {0, 0.005, 0}, 60, 6);
    add_sphere(wide, {0, -1e5, 0}, 1e5, diffuse(dvec3{0.7}));
    add_sphere(wide, {0, 0.005, 0}, 0.005, glass(1, 1.5));
    add_sphere(wide, {0.02, 0.008, 0.01}, 0.008, glossy(0.9, 0.3));
    add_lamp(wide, {3e4, 4e4, 1e4}, 1e4, dvec3{10});
    wide.background = dvec3{0.1};
    wide.settings.samples = 4;
    all.push_back({"PT, bead and planet", wide});
    return all;
}

TEST(Scaling, ByPowersOfTwoChangesNoByte) {
    for (const Case& c : cases()) {
        for (const Isa isa : supported_isas()) {
            const Image expected = image_of(c.scene, {.isa = isa});
            for (int k = -20; k <= 20; ++k) {
                EXPECT_EQ(image_of(scaled(c.scene, k), {.isa = isa}).pixels, expected.pixels)
                    << c.name << ", " << isa_name(isa) << ", k = " << k;
            }
        }
    }
}

// DEPTH does measure a length: what scales is the distance, not the image.
TEST(Scaling, ScalesDistances) {
    const Scene scene = everything(Integrator::depth);
    const Image expected = image_of(scene);
    for (const int k : {-20, -3, 1, 20}) {
        const Image image = image_of(scaled(scene, k));
        const double s = std::ldexp(1.0, k);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const double distance = s * (1 / double{expected.pixels[i].r} - 1);
            EXPECT_NEAR(image.pixels[i].r, 1 / (1 + distance), 1e-6 / (1 + distance)) << "k = " << k;
        }
    }
}

}  // namespace
}  // namespace orrery::test
