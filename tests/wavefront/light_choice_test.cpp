// One light of several at a vertex: the expectation of all of them, whatever the rule, the transport and the light.
#include <gtest/gtest.h>

#include "wavefront/agreement.hpp"

namespace orrery::test {
namespace {

std::string name_of(LightChoice choice) {
    return choice == LightChoice::all ? "all" : choice == LightChoice::uniform ? "uniform" : "power";
}

/// Every rule with the transports that sample area lights, either way to sample them.
std::vector<Variant> choices(bool area_sampling = true) {
    std::vector<Variant> variants;
    for (const Transport transport : {Transport::mis, Transport::nee})
        for (const LightSampling sampling : {LightSampling::cone, LightSampling::area})
            for (const LightChoice choice : {LightChoice::all, LightChoice::uniform, LightChoice::power}) {
                if (sampling == LightSampling::area && (!area_sampling || choice == LightChoice::all)) continue;
                const std::string name = std::string(transport == Transport::mis ? "mis" : "nee") + ", " +
                                         (sampling == LightSampling::cone ? "cone" : "area") + ", " + name_of(choice);
                variants.push_back({name, [=](RenderSettings& s) {
                                        s.transport = transport;
                                        s.light_sampling = sampling;
                                        s.light_choice = choice;
                                    }});
            }
    return variants;
}

/// Points and lamps, of powers apart by thousands, near what they light and far from it.
Scene mixed(const Material& material) {
    Scene scene = still_life(material, 3);
    add_lamp(scene, {-1.8, 3, -1.5}, 0.4, {20, 15, 10});
    add_lamp(scene, {30, 40, -20}, 6, {30, 40, 50});
    add_lamp(scene, {0.6, 0.15, -1.6}, 0.1, {2, 5, 3});
    add_point_light(scene, {2, 4, -3}, {9, 8, 7});
    add_point_light(scene, {-1.5, 0.3, -1.3}, {0.02, 0.05, 0.1});
    return scene;
}

TEST(LightChoice, AgreesOnDiffuse) { expect_agreement_of(choices(), mixed(diffuse({0.7, 0.5, 0.3}))); }
TEST(LightChoice, AgreesOnGlossy) { expect_agreement_of(choices(), mixed(glossy(0.8, 0.4))); }
TEST(LightChoice, AgreesOnTranslucent) { expect_agreement_of(choices(), mixed(glass(0.9, 1.4, 0.3))); }

// From within a lamp both that one and those outside are sampled; from its outside, the others.
TEST(LightChoice, AgreesWithinALight) {
    Scene scene = still_life(diffuse({0.7, 0.5, 0.3}), 3);
    scene.primitives.clear();
    add_lamp(scene, {0, 0.7, 0}, 9, {0.3, 0.2, 0.1}, diffuse({0.4, 0.5, 0.6}));
    scene.primitives.back().material = 0;
    add_lamp(scene, {-1, 1, 0}, 0.8, {4, 3, 5}, diffuse({0.7, 0.5, 0.3}));
    add_lamp(scene, {1.5, 1.5, 0.5}, 0.3, {30, 20, 10}, glossy(0.8, 0.4));
    add_sphere(scene, {1.2, 0.2, -0.6}, 0.6, diffuse({0.3, 0.7, 0.6}));
    add_point_light(scene, {0, 3, -2}, {2, 3, 4});
    expect_agreement_of(choices(), scene);
}

// Through the tree, and on what else there is of machines and numbers.
TEST(LightChoice, AgreesInACrowd) {
    Scene scene = crowd();
    scene.settings.depth = 3;
    scene.settings.caustics = false;  // over its many mirrors they would take the reference minutes
    add_point_light(scene, {0, 3, -3}, {5, 6, 7});
    std::vector<Variant> variants = {{"all", [](RenderSettings&) {}}};
    for (const LightChoice choice : {LightChoice::uniform, LightChoice::power})
        variants.push_back({name_of(choice), [=](RenderSettings& s) { s.light_choice = choice; }});
    variants.push_back({"double", [](RenderSettings& s) {
                            s.light_choice = LightChoice::power;
                            s.precision = Precision::binary64;
                        }});
    variants.push_back({"sobol", [](RenderSettings& s) {
                            s.light_choice = LightChoice::power;
                            s.estimator = Estimator::sobol;
                        }});
    if (isa_supported(Isa::sse2))
        variants.push_back({"SSE2", [](RenderSettings& s) { s.light_choice = LightChoice::power; }, Isa::sse2});
    expect_agreement_of(variants, scene, {.samples = 144, .reference_samples = 400, .next_event = true});
}

TEST(LightChoice, AgreesAmongPointLights) {
    Scene scene = still_life(glossy(0.8, 0.4), 3);
    for (int i = 0; i < 7; ++i) add_point_light(scene, {i - 3.0, 2.5 + i % 3, -2.0 + i % 2}, dvec3{1.0 + i * i});
    std::vector<Variant> variants;
    for (const Transport transport : {Transport::mis, Transport::naive})
        for (const LightChoice choice : {LightChoice::all, LightChoice::uniform, LightChoice::power})
            variants.push_back({name_of(choice), [=](RenderSettings& s) {
                                    s.transport = transport;
                                    s.light_choice = choice;
                                }});
    expect_agreement_of(variants, scene);
}

// A light 10^60 times as dark as its neighbour, which is beneath the horizon of what it lights: nothing but the rule
// decides whether it is found.
TEST(LightChoice, FindsTheDarkBesideTheBright) {
    Scene scene = picture({0, 3, -3}, {0, 0, 0}, 30, 1);
    add_sphere(scene, {0, -40, 0}, 40, diffuse(dvec3{0.5}));
    add_point_light(scene, {0, 2, 0}, dvec3{1e-30});
    add_point_light(scene, {0, -90, 0}, dvec3{1e30});
    scene.settings.samples = 4096;
    scene.settings.estimator = Estimator::uniform;
    const auto mean = [&](LightChoice choice) {
        scene.settings.light_choice = choice;
        const Image image = image_of(scene);
        double sum = 0;
        for (const Rgb& pixel : image.pixels) sum += static_cast<double>(pixel.g);
        return sum;
    };
    const double all = mean(LightChoice::all);
    EXPECT_GT(all, 1e-30);
    EXPECT_NEAR(mean(LightChoice::uniform) / all, 1, 0.01);
    EXPECT_NEAR(mean(LightChoice::power) / all, 1, 0.03);
}

TEST(LightChoice, CastsOneShadowRayAtAVertex) {
    Scene scene = picture({0, 3, -3}, {0, 0, 0}, 30, 1);
    add_sphere(scene, {0, -40, 0}, 40, diffuse(dvec3{0.5}));
    for (int i = 0; i < 3; ++i) add_lamp(scene, {2.0 * i - 2, 6, 0}, 0.5, dvec3{1.0 + i});
    for (int i = 0; i < 2; ++i) add_point_light(scene, {0, 5, 3.0 * i}, dvec3{1.0 + i});
    scene.settings.samples = 16;
    scene.settings.light_sampling = LightSampling::cone;
    const std::uint64_t vertices = 256 * 16;
    EXPECT_EQ(render(scene).stats.shadow_rays, 5 * vertices);
    for (const LightChoice choice : {LightChoice::uniform, LightChoice::power}) {
        scene.settings.light_choice = choice;
        EXPECT_EQ(render(scene).stats.shadow_rays, vertices);
    }
}

// Where there is nothing to choose the image is the same, to the byte.
TEST(LightChoice, OfOneLightOrByWhittedIsAll) {
    Scene one = still_life(glossy(0.8, 0.4));
    add_lamp(one, {-1.8, 3, -1.5}, 0.4, {20, 15, 10});
    for (Scene scene : {one, everything(Integrator::whitted), everything(Integrator::depth)}) {
        const Image all = image_of(scene);
        for (const LightChoice choice : {LightChoice::uniform, LightChoice::power}) {
            scene.settings.light_choice = choice;
            EXPECT_EQ(image_of(scene).pixels, all.pixels);
        }
    }
}

}  // namespace
}  // namespace orrery::test
