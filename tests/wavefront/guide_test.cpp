// Bounces guided to spots: the same light, with less noise.
//
// A screen hides the lamp from the floor, which is all the camera sees: its light comes from the balls and walls that
// the lamp shines on, so that every picture is indirect light alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "image/compare.hpp"
#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

struct Case {
    const char* name;
    void (*build)(Scene&);
};

const Material chalk = diffuse({0.8, 0.7, 0.6}), clay = diffuse({0.9, 0.5, 0.4});
const dvec3 place{-1.5, 2.6, 0};  // of the lamp

/// A floor in the shadow of a screen; no lamp yet.
Scene screened(double floor = 100) {
    Scene scene = picture({0.6, 4.5, -6}, {0.6, 0, 0}, 16, 4);
    add_sphere(scene, {0, -floor, 0}, floor, chalk);
    add_sphere(scene, {-1.1, 1.9, 0}, 0.65, diffuse(dvec3{0}));  // the screen
    return scene;
}

void area(Scene& s) { add_lamp(s, place, 0.25, {46, 37, 28}, diffuse(dvec3{0})); }
void point(Scene& s) { add_point_light(s, place, {9, 8, 7}); }
void ball(Scene& s) { add_sphere(s, place + dvec3{0, 1.2, 0}, 0.9, clay); }

const std::vector<Case> cases = {
    {"Area", [](Scene& s) { ball(s), area(s); }},
    {"Point", [](Scene& s) { ball(s), point(s); }},
    {"AreaAndPoint",
     [](Scene& s) {
         ball(s), area(s);
         add_point_light(s, place + dvec3{0, 0.1, 0.2}, {5, 9, 5});
     }},
    {"LampTouchesABall",
     [](Scene& s) {
         add_lamp(s, place, 0.3, {40, 30, 20}, diffuse(dvec3{0}));
         add_sphere(s, place + dvec3{0, 1.2, 0}, 0.9, clay);
     }},
    {"Walls",
     [](Scene& s) {
         area(s);
         add_sphere(s, {-502.2, 0, 0}, 500, clay);
         add_sphere(s, {0, 0, 501.5}, 500, tinted(chalk, {0.3, 0.8, 0.4}));
     }},
    {"SpotOnTheFloor",
     [](Scene& s) {
         add_sphere(s, {0.9, 0.4, 0}, 0.4, clay);
         add_point_light(s, {1, 1.1, 0.2}, {1, 1, 1});
     }},
    {"ManySpots",
     [](Scene& s) {
         area(s);
         for (int i = 0; i < 9; ++i)
             add_sphere(s, place + dvec3{0.7 * std::cos(0.7 * i), 0.6 + 0.05 * i, 0.7 * std::sin(0.7 * i)}, 0.3, clay);
     }},
    {"InABall",
     [](Scene& s) {
         ball(s), area(s);
         add_sphere(s, {0, 0, 0}, 12, tinted(chalk, {0.4, 0.5, 0.8}));
     }},
    {"AmongEveryMaterial",
     [](Scene& s) {
         ball(s), area(s);
         add_sphere(s, {0.8, 0.3, 0.4}, 0.3, glass(0.9, 1.5));
         add_sphere(s, {-0.1, 0.9, 1.6}, 0.8, mirror(0.9));
         add_sphere(s, {1.6, 0.8, 1.8}, 0.8, glossy(0.9, 0.2));
         s.background = {0.02, 0.03, 0.05};
     }},
};

Variant variant(const char* name, Guide guide, Transport transport = Transport::mis,
                Estimator estimator = Estimator::stratified, Isa isa = best_isa(),
                Precision precision = Precision::binary32) {
    return {name,
            [=](RenderSettings& s) {
                s.guide = guide, s.transport = transport, s.estimator = estimator, s.precision = precision;
                s.roulette_from = 2;
            },
            isa};
}

class Guided : public testing::TestWithParam<Case> {};

TEST_P(Guided, IsTheSameLight) {
    using enum Transport;
    const auto stratified = Estimator::stratified;
    Scene scene = screened();
    GetParam().build(scene);
    std::vector<Variant> variants = {variant("unguided", Guide::off), variant("guided", Guide::on),
                                     variant("sobol", Guide::on, mis, Estimator::sobol), variant("nee", Guide::on, nee),
                                     variant("double", Guide::on, mis, stratified, best_isa(), Precision::binary64)};
    // Where scattering and light samples are weighed against each other.
    for (const LightSampling sampling : {LightSampling::cone, LightSampling::area}) {
        Variant weighed = variant("weighed", Guide::on);
        weighed.apply = [sampling, apply = weighed.apply](RenderSettings& s) {
            apply(s);
            s.light_sampling = sampling, s.light_choice = LightChoice::power;
        };
        variants.push_back(weighed);
    }
    if (isa_supported(Isa::sse2)) variants.push_back(variant("SSE2", Guide::on, mis, stratified, Isa::sse2));
    expect_agreement_of(variants, scene, {.samples = 1024, .seeds = 4, .reference_samples = 1000});
}

INSTANTIATE_TEST_SUITE_P(Scenes, Guided, testing::ValuesIn(cases),
                         [](const testing::TestParamInfo<Case>& of) { return of.param.name; });

// Where single precision is hardest on it: balls that are small from where their light goes, and walls.
TEST(GuidedMean, IsThatOfUnguided) {
    for (const char* name : {"ManySpots", "Walls", "AmongEveryMaterial"}) {
        Scene scene = screened();
        std::ranges::find(cases, std::string_view(name), &Case::name)->build(scene);
        const auto blocks = [&](Guide guide) {
            return blocks_of(scene, variant("", guide), {.samples = 1 << 13, .seeds = 8, .block_size = 16});
        };
        const auto comparison = statistics::compare(blocks(Guide::on), blocks(Guide::off), one_of_the_family);
        EXPECT_TRUE(comparison.agrees) << name << ": " << comparison.message;
        record(comparison);
    }
}

TEST(GuidedNaive, TakesPointLightsAlone) {
    Scene scene = screened();
    ball(scene), point(scene);
    add_lamp(scene, {-2.5, 3, 1}, 0.8, {2, 4, 6});
    expect_agreement_of({variant("unguided", Guide::off, Transport::naive),
                         variant("guided", Guide::on, Transport::naive), variant("mis", Guide::on)},
                        scene, {.samples = 4096, .seeds = 4, .reference_samples = 1000});
}

// A lamp close to a wall, as in most rooms: the same picture for less than half of the samples, and the plan sees it.
TEST(GuidedNoise, FallsByMuch) {
    Scene scene = picture({0.6, 4.5, -6}, {0.6, 0, 0}, 16, 4);
    add_sphere(scene, {0, -100, 0}, 100, chalk);
    add_sphere(scene, {-502.2, 0, 0}, 500, clay);
    add_lamp(scene, {-1.9, 1.5, 0}, 0.1, {200, 160, 120}, diffuse(dvec3{0}));
    const auto image = [&](Guide guide, std::uint32_t count, std::uint32_t seed) {
        scene.settings.guide = guide, scene.settings.samples = count, scene.settings.seed = seed;
        return render(Plan(scene), {}).image;
    };
    const Image truth = image(Guide::off, 1 << 14, 1);
    EXPECT_GT(compare(image(Guide::off, 256, 2), truth).mrse, 2 * compare(image(Guide::automatic, 256, 2), truth).mrse);
}

}  // namespace
}  // namespace orrery::test
