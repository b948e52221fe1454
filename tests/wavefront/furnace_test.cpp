// The white furnace: surroundings so uniform that every path, however random, must bring back the same.
#include <gtest/gtest.h>

#include <cmath>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

// A dozen roundings of float per event, and cosines of rays that graze.
double tolerance(std::uint32_t events) { return 3e-6 * (1 + events); }

void expect_every_pixel(const Image& image, const dvec3& expected, double relative, const std::string& what) {
    double worst = 0;
    for (const Rgb& p : image.pixels) {
        const dvec3 value{p.r, p.g, p.b};
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(value[c] / expected[c] - 1));
    }
    EXPECT_LE(worst, relative) << what;
}

// Inside a sphere of emission 1 and albedo a, 1 + a + ... + a^D = (1 - a^(D+1)) / (1 - a) comes back along every path.
// Light samples are as exact: from a point of a sphere, cosines and distance to another point cancel, and the density
// of the cosine lobe is that of sampling the area, so that either technique of mis always weighs one half.
TEST(Furnace, SumsTheSeriesOfReflectionsUpToDepth) {
    const dvec3 albedo{0.5, 0.25, 0.9};
    for (const std::uint32_t depth : {0u, 1u, 2u, 7u, 100u}) {
        dvec3 series{0};
        for (int c = 0; c < 3; ++c) series[c] = (1 - std::pow(albedo[c], depth + 1)) / (1 - albedo[c]);
        Scene scene = picture({0.3, 0.2, -0.4}, {0.1, 0.9, 0.3}, 90, depth);
        add_lamp(scene, {0.1, -0.1, 0}, 1.5, dvec3{1}, diffuse(albedo));
        scene.settings.samples = 16;
        for (Variant& variant : path_variants(scene)) {
            variant.apply(scene.settings);
            scene.settings.roulette = false;
            expect_every_pixel(image_of(scene, {.isa = variant.isa}), series, tolerance(depth),
                               variant.name + " to depth " + std::to_string(depth));
        }
    }
}

TEST(Furnace, SumsTheSeriesUnderRouletteOnAverage) {
    const dvec3 albedo{0.5, 0.25, 0.9};
    Scene scene = picture({0.3, 0.2, -0.4}, {0.1, 0.9, 0.3}, 90, 60);
    add_lamp(scene, {0.1, -0.1, 0}, 1.5, dvec3{1}, diffuse(albedo));
    for (const Variant& variant : path_variants(scene)) {
        if (variant.name.find("no roulette") != std::string::npos) continue;
        const auto mean = blocks_of(scene, variant, {}).mean();
        for (std::size_t c = 0; c < 3; ++c) {
            const double a = albedo[static_cast<int>(c)];
            const auto score = statistics::score(mean[c], {(1 - std::pow(a, 61)) / (1 - a)}, 1e-5);
            EXPECT_LE(std::abs(score.z), 5) << variant.name << ", channel " << c;
        }
    }
}

// Energy is neither made nor lost: a ball of rho = 1, of whatever material, before a background of 1 cannot be seen.
// Paths in glass scale radiance down going in and up going out; all that have left again bring exactly 1.
class Invisible : public testing::TestWithParam<Material> {
protected:
    static Scene scene() {
        Scene ball = picture({0, 0.4, -3}, {0, 0, 0}, 45, 4000);
        add_sphere(ball, {0, 0, 0}, 1, GetParam());
        ball.background = dvec3{1};
        ball.settings.samples = 64;
        return ball;
    }
};

TEST_P(Invisible, BeforeAWhiteBackground) {
    for (const bool roulette : {true, false}) {
        for (const Isa isa : supported_isas()) {
            Scene ball = scene();
            ball.settings.roulette = roulette;
            expect_every_pixel(image_of(ball, {.isa = isa}), dvec3{1}, 2e-5, std::string(isa_name(isa)));
        }
    }
}

TEST_P(Invisible, InACrowdOfItsLike) {
    Scene balls = scene();
    for (int i = 0; i < 12; ++i)
        add_sphere(balls, {1.1 * (i % 4) - 1.7, 0.9 * (i / 4) - 0.9, 0.7 * (i % 3)}, 0.5 + 0.03 * i, GetParam());
    balls.settings.samples = 16;
    expect_every_pixel(image_of(balls), dvec3{1}, 2e-4, "overlapping");
}

// The same with the white made by a lamp all around, so that light sampling has its part: only the mean is exact. Of a
// sharp lobe light samples find so little, and so rarely, that a block may have seen none of it: hence the rounding.
TEST_P(Invisible, InsideAWhiteLamp) {
    Scene ball = scene();
    ball.background = dvec3{0};
    ball.settings.roulette = false;
    add_lamp(ball, {0.5, 0.2, -1}, 5, dvec3{1}, diffuse(dvec3{0}));
    statistics::BlockImage white{16, 16, 8, std::vector<statistics::RgbEstimate>(4)};
    for (auto& block : white.blocks) block = {{{1, 0}, {1, 0}, {1, 0}}};
    for (const Variant& variant : path_variants(ball)) {
        auto options = one_of_the_family;
        options.rounding = 2e-4;
        const auto comparison = statistics::compare(blocks_of(ball, variant, {.samples = 64}), white, options);
        EXPECT_TRUE(comparison.agrees) << variant.name << ": " << comparison.message;
        record(comparison);
    }
}

std::string name_of_material(const testing::TestParamInfo<Material>& parameter) {
    const Material& m = parameter.param;
    const auto percent = [](double x) { return std::to_string(std::lround(100 * x)); };
    return m.id + percent(m.eta) + "Roughness" + percent(m.roughness);
}

INSTANTIATE_TEST_SUITE_P(Of, Invisible,
                         testing::Values(diffuse(dvec3{1}), mirror(1), glossy(1, 0.02), glossy(1, 0.3), glossy(1, 0.7),
                                         glossy(1, 0.99), glass(1, 1.5), glass(1, 2.4), glass(1, 1), glass(1, 0.7),
                                         glass(1, 1.5, 0.05), glass(1, 1.5, 0.4), glass(1, 0.7, 0.2),
                                         glass(1, 2.4, 0.9)),
                         name_of_material);

// Radiance inside a medium of index eta is eta^2 of that outside. (The camera is near the middle: further out total
// reflection would keep light from ever getting to it.)
TEST(Furnace, IsBrighterInsideGlassByTheSquareOfTheIndex) {
    for (const Material& material : {glass(1, 1.5), glass(1, 0.7), glass(1, 2.4), glass(1, 1.5, 0.1)}) {
        Scene ball = picture({0.1, 0.2, -0.1}, {0, 0, 1}, 90, 4000);
        add_sphere(ball, {0, 0, 0}, 1, material);
        ball.background = dvec3{1};
        ball.settings.samples = 64;
        expect_every_pixel(image_of(ball), dvec3{material.eta * material.eta}, 2e-5, std::to_string(material.eta));
    }
}

// Less than all comes back from less than white, in the right measure: one event on a convex body, then the sky.
TEST(Furnace, ReturnsTheReflectedFractionOfTheBackground) {
    for (const Material& material :
         {diffuse({0.7, 0.5, 0.2}), tinted(mirror(0), {0.7, 0.5, 0.2}), tinted(glossy(0, 0.1), {0.7, 0.5, 0.2}),
          tinted(glossy(0, 0.95), {0.7, 0.5, 0.2})}) {
        Scene scene = picture({0, 0, -3}, {0, 0, 0}, 20, 1);  // the ball fills the image
        add_sphere(scene, {0, 0, 0}, 1, material);
        scene.background = {2, 3, 4};
        scene.settings.roulette = false;
        expect_every_pixel(image_of(scene), {1.4, 1.5, 0.8}, 1e-6, "depth 1");
        scene.settings.depth = 0;
        EXPECT_EQ(image_of(scene).pixels, std::vector<Rgb>(256));
    }
}

// Whitted follows both branches, and drops those below 1e-5; away from the rim, where reflection is weak, these are
// few.
TEST(Furnace, WhittedGlassKeepsItsEnergy) {
    Scene scene = picture({0, 0, -3}, {0, 0, 0}, 20, 20);
    add_sphere(scene, {0, 0, 0}, 1, glass(1, 1.5));
    scene.background = dvec3{1};
    scene.settings.integrator = Integrator::whitted;
    scene.settings.samples = 16;
    expect_every_pixel(image_of(scene), dvec3{1}, 3e-5, "a glass ball");
}

}  // namespace
}  // namespace orrery::test
