// Light of point lights over one smooth sphere, and nothing else: an image with it less the same image without, against
// the reference's brute force.
//
// Where rays are focused to a point, or neighbouring ones cross on a visible surface, a pixel's variance has no bound:
// these scenes stay away from the former.
#include <gtest/gtest.h>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

Image caustics_of(Scene scene, Isa isa) {
    Image image = render(scene, {.isa = isa}).image;
    scene.settings.caustics = false;
    const Image without = render(scene, {.isa = isa}).image;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        Rgb& p = image.pixels[i];
        const Rgb& less = without.pixels[i];
        p = {p.r - less.r, p.g - less.g, p.b - less.b};
    }
    return image;
}

struct Effort {
    std::uint32_t samples = 64, seeds = 8;
    std::uint32_t reference_samples = 200, directions = 40;
    double lamp_radius = 0.2;
};

const Variant usual{"as usual", [](RenderSettings&) {}};
const Variant sobol{"sobol", [](RenderSettings& s) { s.estimator = Estimator::sobol; }};

void expect_caustics(const Scene& scene, const std::vector<Variant>& variants = {usual, sobol},
                     const Effort& effort = {}) {
    const auto truth = reference::render(scene, {.samples = effort.reference_samples,
                                                 .block_size = 8,
                                                 .caustics_alone = true,
                                                 .caustic_directions = effort.directions,
                                                 .lamp_radius = effort.lamp_radius});
    EXPECT_GT(truth.mean()[0].mean, 0);
    for (const Variant& variant : variants) {
        Scene varied = scene;
        variant.apply(varied.settings);
        varied.settings.samples = effort.samples;
        std::vector<Image> images;
        for (std::uint32_t seed = 0; seed < effort.seeds; ++seed) {
            varied.settings.seed = 100 + seed;
            images.push_back(caustics_of(varied, variant.isa));
        }
        const auto comparison = statistics::compare(statistics::blocks_over_seeds(images, 8), truth, one_of_the_family);
        EXPECT_TRUE(comparison.agrees) << variant.name << ": " << comparison.message;
        record(comparison);
    }
}

const Material clay = diffuse({0.8, 0.6, 0.4});
const Material silver = tinted(mirror(0), {0.9, 0.7, 0.5});
Material crystal(double eta) { return tinted(glass(0, eta), {0.9, 0.8, 0.7}, {0.7, 0.8, 0.9}); }

/// A ball above a floor, and a light above both.
Scene over(const Material& ball, const Material& floor = clay, std::uint32_t depth = 4) {
    Scene scene = picture({0.5, 3, -6}, {-0.6, 0.1, 0.5}, 20, depth);
    add_sphere(scene, {0, -40, 0}, 40, floor);
    add_sphere(scene, {0, 1.7, 0}, 0.5, ball);
    add_point_light(scene, {2, 4, -1.5}, {50, 60, 70});
    return scene;
}

std::vector<Variant> all_variants(const Scene& scene) {
    std::vector<Variant> variants = path_variants(scene);
    variants.push_back({"double", [](RenderSettings& s) { s.precision = Precision::binary64; }});
    for (const Transport transport : {Transport::naive, Transport::nee})
        variants.push_back({"transport", [=](RenderSettings& s) { s.transport = transport; }});
    return variants;
}

TEST(PointCaustics, OffAMirror) { expect_caustics(over(silver), all_variants(over(silver))); }
TEST(PointCaustics, OverGlass) { expect_caustics(over(crystal(1.5)), all_variants(over(crystal(1.5)))); }
TEST(PointCaustics, OverABubble) { expect_caustics(over(crystal(0.7))); }
TEST(PointCaustics, OverDiamond) { expect_caustics(over(crystal(2.4))); }
TEST(PointCaustics, ThroughWhatBendsNothing) { expect_caustics(over(crystal(1))); }

TEST(PointCaustics, EndAtTheDepth) {
    for (const std::uint32_t depth : {2u, 3u}) expect_caustics(over(crystal(1.5), clay, depth));
    Scene scene = over(crystal(1.5), clay, 1);
    scene.settings.samples = 4;
    for (const Rgb& p : caustics_of(scene, best_isa()).pixels) EXPECT_EQ(p, Rgb{});
}

TEST(PointCaustics, OnGlossySurfaces) {
    expect_caustics(over(silver, tinted(glossy(0, 0.9), {0.9, 0.7, 0.5}), 2));
    expect_caustics(over(crystal(1.5), tinted(glossy(0, 0.9), {0.9, 0.7, 0.5}), 3));
}

TEST(PointCaustics, OnTranslucentSurfaces) {
    const Material frosted = tinted(glass(0, 1.3, 0.9), {0.9, 0.8, 0.7}, {0.6, 0.8, 1});
    expect_caustics(over(silver, frosted, 2));
    // Ball and light within, seen through the surface.
    Scene scene = picture({0, 0.5, -9}, {0.2, 0, 0}, 20, 3);
    add_sphere(scene, {0, 0, 0}, 3, frosted);
    add_sphere(scene, {0.6, 0.2, 0}, 0.6, crystal(1.4));
    add_point_light(scene, {-1, 0.8, 0.5}, {50, 60, 70});
    expect_caustics(scene);
}

TEST(PointCaustics, StopAtWhatIsInTheWay) {
    Scene scene = over(crystal(1.5));
    add_sphere(scene, {0.8, 2.6, -0.6}, 0.25, clay);                // between ball and light
    add_sphere(scene, {-0.7, 0.6, 0.1}, 0.2, crystal(1.2));         // between floor and ball
    add_sphere(scene, {0.1, 1.8, 0.1}, 0.15, diffuse(dvec3{0.3}));  // within the ball
    add_sphere(scene, {0.4, 1.5, 0.3}, 0.3, silver);                // through its surface
    expect_caustics(scene, {usual, sobol}, {.reference_samples = 100, .directions = 100, .lamp_radius = 0.06});
}

TEST(PointCaustics, AreCutWithinTheBall) {
    Scene nested = over(crystal(1.5));
    add_sphere(nested, {0.1, 1.75, 0}, 0.25, clay);
    expect_caustics(nested);
    Scene crossed = over(crystal(1.5));
    add_sphere(crossed, {-0.3, 1.4, 0.2}, 0.35, clay);
    expect_caustics(crossed);
}

TEST(PointCaustics, ComeFromAboveTheHorizonAlone) {
    // Much of the small ball has the mirror beyond its own horizon, and much of the floor has it behind the small ball.
    Scene scene = picture({0.5, 2, -6}, {0, 0.6, 0}, 22, 3);
    add_sphere(scene, {0, -40, 0}, 40, clay);
    add_sphere(scene, {-0.3, 0.6, 0}, 0.6, diffuse({0.4, 0.6, 0.8}));
    add_sphere(scene, {0.9, 0.5, 0.4}, 0.5, silver);
    add_point_light(scene, {-1.5, 2.5, -3}, {50, 60, 70});
    expect_caustics(scene);
}

TEST(PointCaustics, FromSeveralLightsOrOneOfThem) {
    Scene scene = over(crystal(0.7), clay, 3);
    add_point_light(scene, {-3, 3, 0}, {20, 10, 30});
    add_point_light(scene, {0, 1.8, 0.1}, {20, 10, 30});  // within the ball
    add_lamp(scene, {-1, 6, 3}, 0.2, {30, 30, 30});
    std::vector<Variant> variants;
    for (const LightChoice choice : {LightChoice::all, LightChoice::uniform, LightChoice::power})
        for (const Estimator estimator : {Estimator::stratified, Estimator::sobol})
            variants.push_back({"choice " + std::to_string(static_cast<int>(choice)), [=](RenderSettings& s) {
                                    s.light_choice = choice;
                                    s.estimator = estimator;
                                    s.transport = Transport::nee;  // leaves the lamp's own caustics to chance
                                }});
    expect_caustics(scene, variants);
}

TEST(PointCaustics, AmongMany) {
    for (const int count : {12, 100}) {  // packets of rays, and the tree; each vertex asks one of half of them
        Scene scene = over(crystal(0.7), clay, 3);
        for (int i = 0; i < count; ++i) {
            const double angle = 2.4 * i, far = 0.8 + 0.03 * i;
            add_sphere(scene, {far * std::cos(angle) - 0.5, 0.1, far * std::sin(angle)}, 0.1, i % 2 ? clay : silver);
        }
        expect_caustics(scene, {usual}, {.samples = 256, .reference_samples = 20});
    }
}

TEST(PointCaustics, InARoom) {
    Scene scene = picture({0, 0, -2}, {0.5, -1, 2}, 40, 4);
    add_sphere(scene, {0, 0, 0}, 3, clay);
    add_sphere(scene, {0.5, -0.8, 1}, 0.6, crystal(1.5));
    add_point_light(scene, {-1, 1, 0}, {5, 6, 7});
    expect_caustics(scene);
}

// Where geometry degenerates, samples stay finite and every instruction set that fuses computes the same.
TEST(PointCaustics, AreFiniteInExtremes) {
    struct Extreme {
        const char* name;
        std::function<void(Scene&)> add;
    };
    const dvec3 at{0, 1.7, 0};
    const auto light = [](Scene& s, const dvec3& position) { add_point_light(s, position, {50, 60, 70}); };
    const std::vector<Extreme> extremes = {
        {"light on the surface",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(1.5)), light(s, {0.5, 1.7, 0});
         }},
        {"light next to it",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, silver), light(s, {0, 2.2 + 1e-6, 0});
         }},
        {"light at the centre", [&](Scene& s) { add_sphere(s, at, 0.5, crystal(1.5)), light(s, at); }},
        {"ball on the floor",
         [&](Scene& s) {
             add_sphere(s, {0, 0.5, 0}, 0.5, crystal(1.5)), light(s, {0, 4, 0});
         }},
        {"ball through the floor",
         [&](Scene& s) {
             add_sphere(s, {0, 0.2, 0}, 0.5, crystal(1.5)), light(s, {2, 4, 0});
         }},
        {"vertices all over a ball that it touches",
         [&](Scene& s) {
             add_sphere(s, {0, 0.5, 0}, 0.5, clay), add_sphere(s, {0, 1.5, 0}, 0.5, crystal(1.5)), light(s, {2, 4, 0});
         }},
        {"diffuse within glass",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(1.5)), add_sphere(s, at, 0.5 - 1e-7, clay), light(s, {2, 4, 0});
         }},
        {"nested, overlapping",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(1.5)), add_sphere(s, at, 0.3, crystal(0.8)),
                 add_sphere(s, at + dvec3{0.4, 0, 0}, 0.4, silver), light(s, {2, 4, 0});
         }},
        {"everything within glass",
         [&](Scene& s) {
             add_sphere(s, {0, -40, 0}, 80, crystal(1.5)), add_sphere(s, at, 0.5, silver), light(s, {2, 4, 0});
         }},
        {"eta 1",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(1)), light(s, {0, 4, 0});
         }},
        {"eta 1 and a little",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(1 + 1e-7)), light(s, {0, 4, 0});
         }},
        {"eta small",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(0.01)), light(s, {2, 4, 0});
         }},
        {"eta large",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(100)), light(s, {2, 4, 0});
         }},
        {"light in the focus of parallel light",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(2)), light(s, {0, 2.2001, 0});
         }},
        {"radii of 1 to 1e6",
         [&](Scene& s) {
             for (int k = 0; k < 4; ++k)
                 add_sphere(s, {0.2 * k, 0.01, 0.1 * k}, 0.5 * std::pow(10, -2 * k), crystal(1.5));
             light(s, {2, 4, 0});
         }},
        {"far away",
         [&](Scene& s) {
             add_sphere(s, {0, 1e5, 0}, 0.5, silver), light(s, {0, 1e5 + 1, 0});
         }},
        {"a thousand lights",
         [&](Scene& s) {
             add_sphere(s, at, 0.5, crystal(1.5));
             for (int k = 0; k < 1000; ++k) add_point_light(s, {std::cos(k), 3, std::sin(k)}, dvec3{0.05});
             s.settings.samples = 1;
         }},
    };
    for (const auto& [name, add] : extremes) {
        for (const Precision precision : {Precision::binary32, Precision::binary64}) {
            Scene scene = picture({0.5, 3, -6}, {-0.2, 0.5, 0.5}, 20, 4);
            add_sphere(scene, {0, -40, 0}, 40, clay);
            scene.settings.samples = 16;
            scene.settings.precision = precision;
            add(scene);
            const RenderResult result = render(scene, {});
            EXPECT_EQ(result.stats.dropped_samples, 0u) << name;
            double sum = 0;
            for (const Rgb& p : result.image.pixels) sum += p.r + p.g + p.b;
            EXPECT_TRUE(std::isfinite(sum)) << name;
            if (!isa_supported(Isa::avx2)) continue;
            EXPECT_EQ(render(scene, {.isa = Isa::avx2}).image.pixels, render(scene, {.wave_size = 33}).image.pixels)
                << name;
        }
    }
}

}  // namespace
}  // namespace orrery::test
