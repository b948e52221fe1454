// Double: the same paths as float up to rounding, the same bytes wherever multiply-adds are fused, and right where
// float is not.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

Scene in_double(Scene scene) {
    scene.settings.precision = Precision::binary64;
    return scene;
}

/// Every stage, with and without a tree.
std::vector<Scene> scenes() {
    std::vector<Scene> all;
    for (const Integrator integrator : all_integrators) {
        all.push_back(everything(integrator));
        all.back().settings.width = 37;
        all.back().settings.height = 21;
        all.push_back(crowd(integrator));
    }
    all.push_back(all.front());
    all.back().settings.transport = Transport::nee;
    all.back().settings.light_sampling = LightSampling::area;
    all.back().settings.estimator = Estimator::uniform;
    return all;
}

class InDouble : public testing::TestWithParam<std::size_t> {
protected:
    Scene scene = scenes().at(GetParam());
};

TEST_P(InDouble, TheSameBytesForAnyWaveSizeThreadsAndInstructionSetThatFuses) {
    const Image expected = image_of(in_double(scene), {.threads = 1, .isa = Isa::scalar});
    for (const Isa isa : {Isa::scalar, Isa::avx2, Isa::avx512}) {
        if (!isa_supported(isa)) continue;
        for (const std::uint32_t wave : {0u, 26u})
            EXPECT_EQ(image_of(in_double(scene), {.isa = isa, .wave_size = wave}).pixels, expected.pixels)
                << isa_name(isa) << ", waves of " << wave;
    }
}

// The random numbers are the same to 24 bits, so a path differs by rounding until a decision (which lobe, hit or miss,
// survive or not) falls the other way. Few do in four samples of a dozen decisions, fewest where surfaces do not
// magnify differences; those that do fall to either side, so that the image's mean stays where it is.
TEST_P(InDouble, PixelsAreFloatsUpToRoundingAndAFewDecisions) {
    for (const Isa isa : supported_isas()) {
        const Image single = image_of(scene, {.isa = isa}), twofold = image_of(in_double(scene), {.isa = isa});
        std::size_t near = 0;
        double sum = 0, squares = 0, all = 0;
        for (std::size_t i = 0; i < single.pixels.size(); ++i) {
            const double a = single.pixels[i].g, b = twofold.pixels[i].g;
            if (std::abs(a - b) <= 1e-3 * (a + b)) ++near;
            sum += a - b, squares += (a - b) * (a - b), all += b;
        }
        const auto pixels = static_cast<double>(single.pixels.size());
        EXPECT_NE(single.pixels, twofold.pixels) << "it did run in double";
        EXPECT_GT(static_cast<double>(near), 0.95 * pixels) << isa_name(isa);
        EXPECT_LT(std::abs(sum), 4 * std::sqrt(squares) + 1e-5 * all) << isa_name(isa);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, InDouble, testing::Range<std::size_t>(0, 7));

constexpr std::uint32_t side = 48;  // of the image
const dvec3 right{0, 0, 1}, up{-0.8, 0.6, 0}, away{0.6, 0.8, 0};

/// A ball of radius 1 on a planet of radius 1e7, seen from straight above it: within a few units the planet is a plane
/// to 1e-6. The ball is not at the planet's top, where numbers happen to be round.
Scene ball_on_a_planet(Precision precision) {
    Scene scene = picture(30.0 * away, {0, 0, 0}, 20, 1);
    scene.settings.width = scene.settings.height = side;
    scene.settings.samples = 1;
    scene.settings.estimator = Estimator::uniform;
    scene.settings.precision = precision;
    add_sphere(scene, -1e7 * away, 1e7, diffuse(dvec3{0.5}));
    add_sphere(scene, away, 1, diffuse(dvec3{0.5}));
    add_point_light(scene, 8.0 * away + 3.0 * right, dvec3{100});
    return scene;
}

/// Share of the ground's pixels whose radiance is not what a plane and a ball give.
double wrong_share(Precision precision) {
    const Scene scene = ball_on_a_planet(precision);
    const Image image = image_of(scene);
    const dvec3 eye = scene.camera.position, light = scene.point_lights[0].position;
    const double half = std::tan(10 * std::numbers::pi / 180), step = 2 * half / side;
    std::size_t wrong = 0, ground = 0;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            // The ground a pixel may see lies between its corners.
            double low = 1e30, high = 0;
            bool of_ground = true, in_shadow = false, in_light = false;
            for (const double cx : {0.0, 1.0}) {
                for (const double cy : {0.0, 1.0}) {
                    const dvec3 at = 30 * ((x + cx) * step - half) * right + 30 * (half - (y + cy) * step) * up;
                    const auto meets_ball = [&](const dvec3& from) {
                        const dvec3 d = glm::normalize(at - from), f = away - from;
                        return glm::length(f - d * glm::dot(f, d)) < 1;
                    };
                    if (meets_ball(eye)) of_ground = false;
                    (meets_ball(light) ? in_shadow : in_light) = true;
                    const double d = glm::length(light - at);
                    const double radiance = 0.5 / std::numbers::pi * 100 * 8 / (d * d * d);
                    low = std::min(low, radiance), high = std::max(high, radiance);
                }
            }
            if (!of_ground || (in_shadow && in_light)) continue;
            ++ground;
            const double found = image.at(x, y).r;
            // Below the light the brightest point lies between the corners.
            if (in_shadow ? found != 0 : found < low * (1 - 1e-5) || found > high * (1 + 1e-3)) ++wrong;
        }
    }
    EXPECT_GT(ground, 1500u);
    return static_cast<double>(wrong) / static_cast<double>(ground);
}

TEST(LargeGround, ABallCastsACleanShadowInDouble) {
    EXPECT_EQ(wrong_share(Precision::binary64), 0);
    EXPECT_EQ(wrong_share(Precision::automatic), 0);
    EXPECT_GT(wrong_share(Precision::binary32), 0.1) << "or float needs no warning here";
}

/// A floor lit by what a lamp shows of itself through a ceiling: it pokes `depth` out of the ceiling's ball, which is
/// around it or below, as the lamp hangs in its rind or stands on it. The lit cap's rim is a circle of radius a at
/// height h; its light on the floor below is a^2 / (a^2 + h^2) of that of a whole sky, whatever the cap's shape.
Scene lamp_through_a_ceiling(double ceiling, double lamp, double depth, bool around, double height, const dvec3& top) {
    const long double lamp_at = height + lamp - depth, ceiling_at = around ? height + ceiling : height - ceiling;
    const long double rim =
        ((ceiling_at - lamp_at) * (ceiling_at + lamp_at) - (1.0L * ceiling - lamp) * (ceiling + lamp)) /
        (2 * (ceiling_at - lamp_at));
    const long double a2 = (lamp - (rim - lamp_at)) * (lamp + (rim - lamp_at));
    Scene scene = picture(0.3 * height * (top + dvec3{0.6, 0, 0.1}), {0, 0, 0}, 1e-3, 1);
    scene.settings.samples = 4096;
    add_sphere(scene, -30.0 * top, 30, diffuse(dvec3{1}));
    add_sphere(scene, static_cast<double>(ceiling_at) * top, ceiling, diffuse(dvec3{0}));
    add_lamp(scene, static_cast<double>(lamp_at) * top, lamp, dvec3{static_cast<double>((a2 + rim * rim) / a2)},
             diffuse(dvec3{0}));
    return scene;
}

TEST(Lamp, ShinesThroughACeilingAsItIs) {
    struct Case {
        double ceiling, lamp, depth, height = 10.2;
    };
    for (const Case& c : {Case{1e5, 600, 0.5},
                          {1e5, 600, 0.27},
                          {1e5, 600, 0.02},
                          {1e6, 600, 0.1},
                          {1e6, 600, 0.02},
                          {1e4, 60, 0.01, 1.5},
                          {1e3, 5, 1e-3, 0.3},
                          {1e7, 600, 0.3},
                          {500, 20, 0.05, 2.1},
                          {30, 3, 0.2, 1.3}}) {
        for (const bool around : {true, false}) {
            for (const dvec3& top : {dvec3{0, 1, 0}, glm::normalize(dvec3{1, 2, -0.7})}) {
                const Image image = image_of(lamp_through_a_ceiling(c.ceiling, c.lamp, c.depth, around, c.height, top));
                double mean = 0;
                for (const Rgb& pixel : image.pixels) mean += pixel.g / 256;
                EXPECT_NEAR(mean, 1, 0.01) << c.ceiling << ", " << c.lamp << ", " << c.depth << ", " << around;
            }
        }
    }
}

// A quarter above the planet, whose centre is 1e7 away: in float the difference of the two is 0 or 1.
TEST(LargeGround, DistancesAreDoubles) {
    Scene scene = ball_on_a_planet(Precision::binary64);
    scene.settings.integrator = Integrator::depth;
    scene.primitives.pop_back();
    scene.camera.position = 0.25 * away;
    scene.camera.fov = 1e-3;
    const Image image = image_of(scene);
    for (const Rgb& pixel : image.pixels) EXPECT_NEAR(pixel.r, 1 / 1.25, 1e-7);
}

}  // namespace
}  // namespace orrery::test
