// The plan in words must say what the plan in bits does.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "plan/worlds.hpp"

namespace orrery::test {
namespace {

using enum MaterialKind;

const Decision& decision(const std::vector<Decision>& all, const std::string& part) {
    const auto found = std::ranges::find(all, part, &Decision::part);
    if (found == all.end()) throw std::logic_error("no decision on " + part);
    return *found;
}

std::vector<Scene> worlds() {
    std::vector<Scene> all = {empty_world(), world({diffuse}), world({glossy, glossy}), world({dielectric}),
                              world({diffuse, specular, glossy, dielectric, translucent})};
    for (std::size_t i = 0, plain = all.size(); i < plain; ++i) {
        all.push_back(all[i]);
        add_area_light(all.back());
        add_point_light(all.back());
        all.back().background = dvec3{1};
        all.back().camera.aperture = 0.1;
    }
    return all;
}

template <class Visit>
void for_each_plan(const Visit& visit) {
    for (const Scene& plain : worlds()) {
        for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted, Integrator::depth}) {
            for (const Transport transport : {Transport::naive, Transport::nee, Transport::mis}) {
                for (const bool roulette : {false, true}) {
                    for (const LightSampling sampling : {LightSampling::cone, LightSampling::exact}) {
                        Scene scene = plain;
                        scene.settings.integrator = integrator;
                        scene.settings.transport = transport;
                        scene.settings.roulette = roulette;
                        scene.settings.light_sampling = sampling;
                        visit(Plan(scene));
                    }
                }
            }
        }
    }
}

TEST(Decisions, NameEachPartOnceAndGiveAReason) {
    for_each_plan([](const Plan& plan) {
        std::set<std::string> parts;
        for (const Decision& d : plan.decisions()) {
            EXPECT_FALSE(d.part.empty());
            EXPECT_FALSE(d.reason.empty()) << d.part;
            EXPECT_TRUE(parts.insert(d.part).second) << d.part << " twice";
        }
    });
}

TEST(Decisions, SayWhatTheNeedsSay) {
    for_each_plan([](const Plan& plan) {
        const Needs& needs = plan.needs();
        const auto all = plan.decisions();
        EXPECT_EQ(decision(all, "intersect: tree").runs, plan.tables().spheres.tree.count != 0);
        EXPECT_EQ(decision(all, "generate: lens").runs, needs.lens);
        if (needs.integrator == Integrator::depth) {
            EXPECT_FALSE(decision(all, "shade, shadow, roulette").runs);
            return;
        }
        constexpr const char* kinds[] = {"diffuse", "specular", "glossy", "dielectric", "translucent"};
        for (std::uint32_t k = 0; k < 5; ++k)
            EXPECT_EQ(decision(all, std::string("shade: ") + kinds[k]).runs, (needs.scattering >> k & 1u) != 0);
        EXPECT_EQ(decision(all, "shade: sort").runs, needs.sort);
        EXPECT_EQ(decision(all, "shade: emission").runs, needs.emitters);
        EXPECT_EQ(decision(all, "shade: background").runs, needs.background);
        EXPECT_EQ(decision(all, "shadow: point lights").runs, needs.connect_point != 0);
        EXPECT_EQ(decision(all, "shadow: area lights").runs, needs.connect_area != 0);
        EXPECT_EQ(decision(all, "shadow: closed form").runs, needs.exact);
        EXPECT_EQ(decision(all, "shade: guide").runs, needs.guide);
        EXPECT_EQ(decision(all, "shadow: light choice").runs, needs.one_light);
        EXPECT_EQ(decision(all, "roulette: play").runs, needs.roulette);
        EXPECT_EQ(decision(all, "branches").runs, needs.branches);
    });
}

TEST(Decisions, CountWhatTheySpeakOf) {
    Scene scene = world({diffuse, glossy});
    add_area_light(scene);
    add_area_light(scene);
    add_point_light(scene);
    const auto all = Plan(scene).decisions();
    EXPECT_EQ(decision(all, "intersect: tree").reason, "4 spheres: one loop is faster below 64");
    EXPECT_EQ(decision(all, "shade: emission").reason, "2 emissive spheres");
    EXPECT_EQ(decision(all, "shadow: point lights").reason, "1 of them, from diffuse, glossy surfaces");
    EXPECT_EQ(decision(all, "shadow: area lights").reason,
              "2 of them, from diffuse, glossy surfaces, in place of scattering from outside them");
    scene.settings.light_sampling = LightSampling::cone;
    EXPECT_EQ(decision(Plan(scene).decisions(), "shadow: area lights").reason,
              "2 of them, from diffuse, glossy surfaces, weighed against scattering");
}

TEST(Decisions, TellWhyAreaLightsAreNotSampled) {
    const auto reason = [](const Scene& scene) {
        return decision(Plan(scene).decisions(), "shadow: area lights").reason;
    };
    Scene scene = world({diffuse});
    EXPECT_EQ(reason(scene), "there is none");
    add_area_light(scene);
    scene.settings.transport = Transport::naive;
    EXPECT_EQ(reason(scene), "naive transport finds them by scattering");
    Scene shiny = world({specular});
    add(shiny, specular).emission = dvec3{1};
    EXPECT_EQ(reason(shiny), "no surface samples them");
}

TEST(Decisions, TellWhereLightIsKnownInClosedForm) {
    Scene scene = world({diffuse});
    const auto reason = [&] { return decision(Plan(scene).decisions(), "shadow: closed form").reason; };
    scene.settings.light_sampling = LightSampling::cone;
    EXPECT_EQ(reason(), "light sampling is by cone");
    scene.settings.light_sampling = LightSampling::exact;
    EXPECT_EQ(reason(), "no area light is sampled");
    add_area_light(scene);
    EXPECT_EQ(reason(), "diffuse surfaces get their light without rays, but where several spheres take parts of it");
    Scene several = scene;
    add_area_light(several);
    several.settings.light_choice = LightChoice::power;
    EXPECT_EQ(decision(Plan(several).decisions(), "shadow: closed form").reason, "every vertex chooses its light");
    while (scene.primitives.size() < 64) add(scene, diffuse);
    EXPECT_EQ(reason(), "64 spheres: they are sooner met by rays");
    Scene rough = world({glossy});
    add(rough, glossy).emission = dvec3{1};
    rough.settings.light_sampling = LightSampling::exact;
    EXPECT_EQ(decision(Plan(rough).decisions(), "shadow: closed form").reason,
              "no diffuse surface samples area lights");
}

TEST(Decisions, TellHowLightsAreChosen) {
    Scene scene = world({diffuse});
    const auto reason = [&](LightChoice choice) {
        scene.settings.light_choice = choice;
        const Plan plan(scene);
        EXPECT_EQ(decision(plan.decisions(), "shadow: light choice").runs, plan.needs().one_light);
        return decision(plan.decisions(), "shadow: light choice").reason;
    };
    EXPECT_EQ(reason(LightChoice::power), "no light is sampled");
    add_area_light(scene);
    EXPECT_EQ(reason(LightChoice::power), "there is one light to sample");
    add_point_light(scene);
    EXPECT_EQ(reason(LightChoice::all), "all 2 lights from every vertex");
    EXPECT_EQ(reason(LightChoice::uniform), "one of 2 lights, all alike");
    EXPECT_EQ(reason(LightChoice::power), "one of 2 lights by power");
    scene.settings.integrator = Integrator::whitted;
    EXPECT_EQ(reason(LightChoice::power), "Whitted ray tracing takes all lights");
}

TEST(Decisions, TellFromWhereRouletteIsPlayed) {
    const auto reason = [](std::uint32_t depth, std::uint32_t from) {
        Scene scene = world({diffuse});
        scene.settings.depth = depth;
        scene.settings.roulette_from = from;
        return decision(Plan(scene).decisions(), "roulette: play").reason;
    };
    EXPECT_EQ(reason(5, 0), "paths of little throughput end early");
    EXPECT_EQ(reason(5, 2), "paths of little throughput end, if they have scattered more than 2 times");
    EXPECT_EQ(reason(5, 7), "no path scatters more than 7 times");
    EXPECT_EQ(reason(0, 0), "no path scatters");
}

}  // namespace
}  // namespace orrery::test
