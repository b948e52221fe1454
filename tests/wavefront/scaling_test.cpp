// There is no length in the program: a world 2^k times as large gives the same bytes, and what is nearest is seen at
// every length a file may hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

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
            for (const int k : {-50, -41, -20, -7, -1, 1, 2, 13, 20, 41, 43}) {
                EXPECT_EQ(image_of(scaled(c.scene, k), {.isa = isa}).pixels, expected.pixels)
                    << c.name << ", " << isa_name(isa) << ", k = " << k;
            }
        }
    }
}

TEST(Scaling, ByPowersOfTwoChangesNoByteInDoubleEither) {
    Scene scene = everything();
    scene.settings.precision = Precision::binary64;
    const Image expected = image_of(scene);
    for (const int k : {-50, -3, 41, 43}) EXPECT_EQ(image_of(scaled(scene, k)).pixels, expected.pixels) << "k = " << k;
}

// DEPTH does measure a length: what scales is the distance, not the image.
TEST(Scaling, ScalesDistances) {
    const Scene scene = everything(Integrator::depth);
    const Image expected = image_of(scene);
    for (const int k : {-50, -20, -3, 1, 20, 43}) {
        const Image image = image_of(scaled(scene, k));
        const double s = std::ldexp(1.0, k);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const double distance = s * (1 / double{expected.pixels[i].r} - 1);
            EXPECT_NEAR(image.pixels[i].r, 1 / (1 + distance), 1e-6 / (1 + distance)) << "k = " << k;
        }
    }
}

/// Black spheres along a line of sight from the origin, between the lengths `low` and `high`, each of a radiance of its
/// own. Some hold the eye.
Scene row_of_lamps(std::mt19937& dice, std::size_t count, double low, double high) {
    const auto uniform = [&] { return static_cast<double>(dice()) * 0x1p-32; };
    const dvec3 ahead = glm::normalize(dvec3{uniform() - 0.5, uniform() - 0.5, uniform() - 0.5});
    const dvec3 aside = glm::normalize(glm::cross(ahead, dvec3{0.3, 0.5, 0.8}));
    // Sixty-four pixels, so that the cone of coherent rays has its part; all look the same way.
    Scene scene = picture({0, 0, 0}, ahead, 1e-6, 0);
    scene.settings.width = scene.settings.height = 8;
    scene.settings.samples = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double distance = low * std::pow(high / low, uniform());
        const bool around = uniform() < 0.2;
        const double radius = distance * (around ? 1.1 + uniform() : 0.02 + 0.9 * uniform());
        const double off = around ? uniform() * distance : 0.5 * std::min(radius, distance) * uniform();
        add_lamp(scene, distance * ahead + off * aside, radius, dvec3{1.0 + static_cast<double>(i)},
                 diffuse({0, 0, 0}));
    }
    return scene;
}

/// Where the line of sight meets the sphere first.
long double distance_to(const Primitive& p, const dvec3& ahead) {
    long double b = 0, f2 = 0;
    for (int c = 0; c < 3; ++c) {
        b += static_cast<long double>(p.centre[c]) * ahead[c];
        f2 += static_cast<long double>(p.centre[c]) * p.centre[c];
    }
    const long double r2 = static_cast<long double>(p.radius) * p.radius, root = std::sqrt(b * b - f2 + r2);
    return f2 > r2 ? b - root : b + root;
}

/// The radiance of the nearest; 0 where two are too close to call.
float nearest(const Scene& scene) {
    std::vector<std::pair<long double, float>> found;
    for (const Primitive& p : scene.primitives)
        found.emplace_back(distance_to(p, scene.camera.target), static_cast<float>(p.emission->r));
    std::ranges::sort(found);
    return found.size() > 1 && found[1].first < 1.001 * found[0].first ? 0 : found[0].second;
}

// Two, a dozen (a loop, and a cone before it), many (a tree), in whatever order they are listed.
TEST(Scaling, WhatIsNearestIsSeenAtEveryLength) {
    std::mt19937 dice(5);
    struct Span {
        double low, high;
    };
    const Span spans[] = {{1e-16, 1e-15}, {1e-16, 1e-9}, {1e-3, 1e3},   {1e6, 4.5e12}, {1, 1e14},
                          {1e12, 1e13},   {1e15, 4e17},  {1e-16, 4e17}, {1e-16, 1},    {4e16, 4e17}};
    int judged = 0;
    for (const Span& span : spans) {
        for (const std::size_t count : {2u, 12u, 90u}) {
            for (int trial = 0; trial < 6; ++trial) {
                Scene scene = row_of_lamps(dice, count, span.low, span.high);
                const float expected = nearest(scene);
                if (expected == 0) continue;
                for (const Isa isa : supported_isas()) {
                    for (const Precision precision : {Precision::binary32, Precision::binary64, Precision::automatic}) {
                        if (precision == Precision::binary32 && out_of_float_range(scene, length_unit(scene))) continue;
                        scene.settings.precision = precision;
                        std::ranges::shuffle(scene.primitives, dice);
                        ++judged;
                        EXPECT_EQ(image_of(scene, {.isa = isa}).pixels,
                                  std::vector<Rgb>(64, {expected, expected, expected}))
                            << count << " spheres from " << span.low << " to " << span.high << ", " << isa_name(isa)
                            << ", precision " << static_cast<int>(precision);
                    }
                }
            }
        }
    }
    EXPECT_GT(judged, 1000);
}

// In metres: the Sun, Neptune, a moon beyond it and one this side, whose shadow falls on it.
TEST(Scaling, TheSunShinesOnNeptune) {
    const double distance = 4.5e12, sun = 7e8, neptune = 2.5e7;
    const dvec3 out = glm::normalize(dvec3{2, 1, 3}), aside = glm::normalize(glm::cross(out, dvec3{0, 1, 0}));
    const dvec3 planet = distance * out, day = planet - neptune * out;
    for (const bool eclipse : {false, true}) {
        Scene scene = picture(day - 3e8 * out + 1e8 * aside, day, 1e-3, 1);
        add_lamp(scene, {0, 0, 0}, sun, dvec3{1e9}, diffuse(dvec3{0}));
        add_sphere(scene, planet, neptune, diffuse(dvec3{0.5}));
        add_sphere(scene, planet + 3e8 * out, 1e6, diffuse(dvec3{0.5}));
        add_sphere(scene, day - 4e8 * out + (eclipse ? 0.0 : 5e6) * aside, 1e6, diffuse(dvec3{0.5}));
        std::ranges::reverse(scene.primitives);
        scene.settings.precision = Precision::automatic;  // float is good to the size of a moon there
        // The disc of the Sun on the zenith.
        const double expected = eclipse ? 0 : 0.5 * 1e9 * std::pow(sun / (distance - neptune), 2);
        for (const Isa isa : supported_isas())
            for (const Rgb& pixel : image_of(scene, {.isa = isa}).pixels)
                EXPECT_NEAR(pixel.r, expected, 1e-3 * expected);
    }
}

// Light from a virus's distance, and from a star's.
TEST(Scaling, PointLightsAreExactAtEveryLength) {
    for (const double length : {1e-17, 1e-9, 1.0, 1e9, 1e14}) {
        Scene scene = picture(length * dvec3{0, 5, -5}, {0, 0, 0}, 1e-4, 1);
        add_sphere(scene, length * dvec3{0, -10, 0}, 10 * length, diffuse(dvec3{0.5}));
        add_point_light(scene, length * dvec3{0, 2, 0}, dvec3{3 * length * length});
        for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted}) {
            scene.settings.integrator = integrator;
            for (const Rgb& pixel : image_of(scene).pixels)
                EXPECT_NEAR(pixel.r, 0.5 / std::numbers::pi * 3 / 4, 1e-4) << length;
        }
    }
}

}  // namespace
}  // namespace orrery::test
