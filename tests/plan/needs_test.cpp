// Needs: what a scene does not use is not run.
#include <gtest/gtest.h>

#include <ctime>

#include "plan/worlds.hpp"

namespace orrery::test {
namespace {

using kernels::Scattering;
using enum MaterialKind;

constexpr std::array<Scattering, 5> all_ways = {Scattering::diffuse, Scattering::specular, Scattering::glossy,
                                                Scattering::dielectric, Scattering::translucent};

TEST(Needs, NothingOfAnEmptyScene) {
    for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted, Integrator::depth}) {
        Scene scene = empty_world();
        scene.settings.integrator = integrator;
        const Needs needs = needs_of(scene);
        EXPECT_EQ(needs.integrator, integrator);
        EXPECT_EQ(needs.scattering, 0u);
        EXPECT_FALSE(needs.lens || needs.sort || needs.emitters || needs.background || needs.competing);
        EXPECT_FALSE(needs.scattering_pdf || needs.roulette_scale || needs.lobes || needs.branches);
        EXPECT_EQ(needs.connect_point | needs.connect_area, 0u);
    }
}

TEST(Needs, TheKernelsOfTheMaterialsThereAreAndNoOther) {
    for (std::size_t present = 0; present < all_kinds.size(); ++present) {
        const Needs needs = needs_of(world({all_kinds[present]}));
        for (std::size_t k = 0; k < all_kinds.size(); ++k) EXPECT_EQ(needs.scatters(all_ways[k]), k == present);
        EXPECT_EQ(needs.scattering, bit(all_ways[present]));
        EXPECT_FALSE(needs.branches);
    }
}

TEST(Needs, NoKernelForAMaterialThatNoPrimitiveCarries) {
    Scene scene = world({diffuse, dielectric});
    scene.primitives.pop_back();
    EXPECT_EQ(needs_of(scene).scattering, bit(Scattering::diffuse));
}

TEST(Needs, ASortWhereSurfacesScatterInMoreThanOneWay) {
    for (const MaterialKind kind : all_kinds) EXPECT_FALSE(needs_of(world({kind, kind, kind})).sort);
    EXPECT_TRUE(needs_of(world({diffuse, specular})).sort);
    EXPECT_TRUE(needs_of(world({diffuse, specular, glossy, dielectric, translucent})).sort);
    // Whitted's glossy surfaces are mirrors, and its translucent ones glass.
    for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted}) {
        for (Scene scene : {world({specular, glossy}), world({dielectric, translucent})}) {
            scene.settings.integrator = integrator;
            EXPECT_EQ(needs_of(scene).sort, integrator == Integrator::path_tracing);
        }
    }
}

TEST(Needs, CausticsWhereASmoothSphereStandsApartFromALamp) {
    const auto caustics = [](std::initializer_list<MaterialKind> kinds, double apart, auto change) {
        Scene scene = world(kinds);
        for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
            scene.primitives[i].centre = {apart * static_cast<double>(i), 0, 0};
            scene.primitives[i].radius = 1;
        }
        scene.primitives.back().emission = glm::dvec3{1};
        scene.settings.depth = 4;
        change(scene.settings);
        return needs_of(scene).caustics;
    };
    const auto as_is = [](RenderSettings&) {};
    EXPECT_TRUE(caustics({specular, diffuse}, 3, as_is));
    EXPECT_TRUE(caustics({dielectric, diffuse}, 3, as_is));
    EXPECT_FALSE(caustics({translucent, diffuse}, 3, as_is)) << "no smooth sphere";
    EXPECT_TRUE(caustics({glossy, diffuse}, 3, as_is));
    const auto by_cone = [](RenderSettings& s) { s.light_sampling = LightSampling::cone; };
    EXPECT_FALSE(caustics({glossy, diffuse}, 3, by_cone));
    EXPECT_TRUE(caustics({specular, diffuse}, 3, by_cone));
    EXPECT_FALSE(caustics({specular, diffuse}, 2, as_is)) << "they touch";
    EXPECT_FALSE(caustics({specular, diffuse}, 0.5, as_is)) << "one holds part of the other";
    EXPECT_FALSE(caustics({specular, diffuse}, 3, [](RenderSettings& s) { s.caustics = false; }));
    EXPECT_FALSE(caustics({specular, diffuse}, 3, [](RenderSettings& s) { s.transport = Transport::nee; }));
    EXPECT_FALSE(caustics({specular, diffuse}, 3, [](RenderSettings& s) { s.integrator = Integrator::whitted; }));
}

TEST(Needs, PointCausticsWhereThereAreAPointLightAndASmoothSphere) {
    const auto caustics = [](std::initializer_list<MaterialKind> kinds, bool light, auto change) {
        Scene scene = world(kinds);
        scene.point_lights.clear();
        if (light) scene.point_lights.push_back({"point", {0, 9, 0}, {1, 1, 1}});
        scene.settings.depth = 2;
        change(scene.settings);
        return needs_of(scene).point_caustics;
    };
    const auto as_is = [](RenderSettings&) {};
    EXPECT_TRUE(caustics({specular, diffuse}, true, as_is));
    EXPECT_TRUE(caustics({dielectric, translucent}, true, as_is));
    EXPECT_FALSE(caustics({specular, diffuse}, false, as_is));
    EXPECT_FALSE(caustics({glossy, translucent, diffuse}, true, as_is)) << "no smooth sphere";
    EXPECT_FALSE(caustics({specular, dielectric}, true, as_is)) << "no surface that scatters";
    EXPECT_FALSE(caustics({specular, diffuse}, true, [](RenderSettings& s) { s.caustics = false; }));
    EXPECT_FALSE(caustics({specular, diffuse}, true, [](RenderSettings& s) { s.depth = 1; }));
    EXPECT_FALSE(caustics({specular, diffuse}, true, [](RenderSettings& s) { s.integrator = Integrator::whitted; }));
    EXPECT_TRUE(caustics({specular, diffuse}, true, [](RenderSettings& s) { s.transport = Transport::naive; }));
}

TEST(Needs, CausticsOfManyBallsInTimeInProportion) {
    const auto seconds = [](std::size_t balls) {
        Scene scene = world({dielectric, diffuse});
        scene.primitives[1].emission = glm::dvec3{1};
        scene.primitives[1].centre = {0, 1e6, 0};
        const Primitive ball = scene.primitives[0];
        for (std::size_t i = 1; i < balls; ++i) {
            scene.primitives.push_back(ball);
            scene.primitives.back().centre.x += 3 * ball.radius * static_cast<double>(i);
        }
        const std::clock_t start = std::clock();
        EXPECT_LE(plan_caustics(scene, true).size(), 20u);  // five ways over four balls
        std::vector<std::uint32_t> all = smooth_spheres(scene);
        EXPECT_EQ(all.size(), balls);
        any_obstructed(scene, all);
        std::vector<float> column(scene.primitives.size());
        for (std::size_t i = 0; i < column.size(); ++i) column[i] = static_cast<float>(3 * i);
        kernels::SphereTable<float> spheres;
        spheres.cx = spheres.cy = spheres.cz = spheres.radius = column.data();
        EXPECT_GT(SphereChoice<float>(spheres, all).levels(), 10u);
        return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    };
    // Ten times as many would take a hundred times as long if each ball were held against all others.
    EXPECT_LT(seconds(40'000), 40 * seconds(4'000) + 0.05);
}

TEST(Needs, ALensWhereTheApertureIsOpen) {
    for (const Integrator integrator : {Integrator::path_tracing, Integrator::whitted, Integrator::depth}) {
        Scene scene = world({diffuse});
        scene.settings.integrator = integrator;
        EXPECT_FALSE(needs_of(scene).lens);
        scene.camera.aperture = 0.1;
        EXPECT_TRUE(needs_of(scene).lens);
    }
}

TEST(Needs, OfWhittedAreThoseOfUnperturbedDirections) {
    Scene scene = world({diffuse, glossy, translucent});
    scene.settings.integrator = Integrator::whitted;
    add_point_light(scene);
    add_area_light(scene);
    const Needs needs = needs_of(scene);
    EXPECT_EQ(needs.scattering, bit(Scattering::diffuse) | bit(Scattering::specular) | bit(Scattering::dielectric));
    EXPECT_TRUE(needs.branches && needs.sort && needs.emitters);
    EXPECT_EQ(needs.connect_point, bit(Scattering::diffuse)) << "direct light at diffuse hits";
    EXPECT_EQ(needs.connect_area, bit(Scattering::diffuse));
    EXPECT_FALSE(needs.roulette || needs.roulette_scale || needs.scattering_pdf || needs.competing || needs.lobes);

    scene = world({diffuse, glossy});
    scene.settings.integrator = Integrator::whitted;
    EXPECT_FALSE(needs_of(scene).branches) << "no glass";
}

TEST(Needs, OfDepthAreTheFirstHits) {
    Scene scene = world({diffuse, glossy, translucent});
    add_point_light(scene);
    add_area_light(scene);
    scene.background = dvec3{1};
    scene.settings.integrator = Integrator::depth;
    const Needs needs = needs_of(scene);
    EXPECT_EQ(needs.scattering, 0u);
    EXPECT_EQ(needs.connect_point | needs.connect_area, 0u);
    EXPECT_FALSE(needs.sort || needs.emitters || needs.background || needs.competing || needs.scattering_pdf);
    EXPECT_FALSE(needs.roulette_scale || needs.lobes || needs.roulette || needs.branches);
}

TEST(Needs, LightsThatShine) {
    Scene scene = world({diffuse});
    scene.background = dvec3{0};
    add_area_light(scene, dvec3{0});
    add_point_light(scene, dvec3{0});
    Needs needs = needs_of(scene);
    EXPECT_FALSE(needs.emitters || needs.background) << "switched off";
    EXPECT_EQ(needs.connect_point | needs.connect_area, 0u);
    EXPECT_EQ(Plan(scene).tables().lights(true).count, 0u);

    scene.background = {0, 0, 0.1};  // one channel is enough
    add_area_light(scene, {0, 0.1, 0});
    add_point_light(scene, {0.1, 0, 0});
    needs = needs_of(scene);
    EXPECT_TRUE(needs.emitters && needs.background);
    EXPECT_NE(needs.connect_point, 0u);
    EXPECT_NE(needs.connect_area, 0u);
    EXPECT_EQ(Plan(scene).tables().lights(true).points, 1u);
    EXPECT_EQ(Plan(scene).tables().lights(true).count, 2u);
}

TEST(Needs, PointLightsSampledFromEverySurfaceButTheSmooth) {
    constexpr std::uint32_t rough = bit(Scattering::diffuse) | bit(Scattering::glossy) | bit(Scattering::translucent);
    for (const Transport transport : {Transport::naive, Transport::nee, Transport::mis}) {
        Scene scene = world({diffuse, specular, glossy, dielectric, translucent});
        scene.settings.transport = transport;
        add_point_light(scene);
        const Needs needs = needs_of(scene);
        EXPECT_EQ(needs.connect_point, rough) << "no path can run into one, naive ones included";
        EXPECT_EQ(needs.connect_area, 0u);
        EXPECT_FALSE(needs.scattering_pdf || needs.competing) << "nothing else finds them";
        EXPECT_TRUE(needs.lobes);
    }
    Scene smooth = world({specular, dielectric});
    add_point_light(smooth);
    EXPECT_EQ(needs_of(smooth).connect_point, 0u);
    EXPECT_FALSE(needs_of(smooth).lobes);
}

TEST(Needs, AreaLightsSampledAsTheTransportSays) {
    constexpr std::uint32_t rough = bit(Scattering::diffuse) | bit(Scattering::glossy) | bit(Scattering::translucent);
    Scene scene = world({diffuse, specular, glossy, dielectric, translucent});
    add_area_light(scene);
    scene.settings.transport = Transport::naive;
    Needs needs = needs_of(scene);
    EXPECT_EQ(needs.connect_area, 0u);
    EXPECT_FALSE(needs.scattering_pdf || needs.competing || needs.lobes);

    scene.settings.transport = Transport::nee;
    needs = needs_of(scene);
    EXPECT_EQ(needs.connect_area, bit(Scattering::diffuse));
    EXPECT_TRUE(needs.scattering_pdf) << "emission behind diffuse vertices must not count twice";
    EXPECT_FALSE(needs.competing || needs.lobes);

    scene.settings.transport = Transport::mis;
    needs = needs_of(scene);
    EXPECT_EQ(needs.connect_area, rough);
    EXPECT_TRUE(needs.scattering_pdf && needs.competing && needs.lobes);
}

TEST(Needs, ClosedFormsWhereDiffuseSurfacesSampleAllAreaLights) {
    Scene scene = world({diffuse, glossy});
    add_area_light(scene);
    scene.settings.light_sampling = LightSampling::exact;
    const auto with = [&](Transport transport, Integrator integrator = Integrator::path_tracing) {
        scene.settings.transport = transport;
        scene.settings.integrator = integrator;
        return needs_of(scene).exact;
    };
    EXPECT_TRUE(with(Transport::mis) && with(Transport::nee) && with(Transport::mis, Integrator::whitted));
    EXPECT_FALSE(with(Transport::naive) || with(Transport::mis, Integrator::depth));
    scene.settings.integrator = Integrator::path_tracing;
    for (const LightSampling other : {LightSampling::area, LightSampling::cone}) {
        scene.settings.light_sampling = other;
        EXPECT_FALSE(with(Transport::mis));
    }
}

// What a path runs into last need not be looked at where it cannot count.
TEST(Needs, LightsAloneWhereScatteringFindsNothing) {
    Scene scene = world({diffuse, glossy});
    add_area_light(scene);
    const auto lights_only = [&](Transport transport, LightSampling sampling) {
        scene.settings.transport = transport;
        scene.settings.light_sampling = sampling;
        return needs_of(scene).lights_only;
    };
    using enum LightSampling;
    EXPECT_TRUE(lights_only(Transport::nee, cone) && lights_only(Transport::nee, exact));
    EXPECT_FALSE(lights_only(Transport::naive, exact) || lights_only(Transport::mis, cone));
    EXPECT_TRUE(lights_only(Transport::mis, exact));
    const Scene apart = scene;
    scene.background = dvec3{1};
    EXPECT_FALSE(lights_only(Transport::mis, exact)) << "the sky";
    scene = apart;
    scene.primitives[2].centre = scene.primitives[0].centre + dvec3{1.5, 0, 0};
    EXPECT_FALSE(lights_only(Transport::mis, exact)) << "a surface within the light";
    scene.primitives[2].centre = scene.primitives[0].centre;
    scene.primitives[2].radius = 0.5;
    EXPECT_TRUE(lights_only(Transport::mis, exact)) << "the light is within another sphere";
    scene = apart;
    scene.camera.position = scene.primitives[2].centre;
    EXPECT_FALSE(lights_only(Transport::mis, exact)) << "the camera within the light";
    scene = world({diffuse, glossy});
    add(scene, dielectric).emission = dvec3{1};
    EXPECT_FALSE(lights_only(Transport::mis, exact)) << "a light of glass";
}

TEST(Needs, NoCompetitionWhereNoSurfaceSamplesLights) {
    for (const Transport transport : {Transport::nee, Transport::mis}) {
        Scene scene = world({specular, dielectric});
        add(scene, specular).emission = dvec3{1};
        scene.settings.transport = transport;
        const Needs needs = needs_of(scene);
        EXPECT_TRUE(needs.emitters);
        EXPECT_EQ(needs.connect_area, 0u);
        EXPECT_FALSE(needs.scattering_pdf);
    }
    Scene shiny = world({glossy});
    add(shiny, glossy).emission = dvec3{1};
    shiny.settings.transport = Transport::nee;
    EXPECT_FALSE(needs_of(shiny).scattering_pdf) << "nee leaves area lights to the perturbed ray";
}

TEST(Needs, RouletteWhereItIsOnAndPathsScatter) {
    Scene scene = world({diffuse, dielectric});
    EXPECT_TRUE(needs_of(scene).roulette);
    EXPECT_TRUE(needs_of(scene).roulette_scale);
    scene.settings.depth = 0;
    EXPECT_FALSE(needs_of(scene).roulette || needs_of(scene).roulette_scale);
    scene.settings.depth = 5;
    scene.settings.roulette_from = 4;
    EXPECT_TRUE(needs_of(scene).roulette && needs_of(scene).roulette_scale);
    scene.settings.roulette_from = 5;
    EXPECT_FALSE(needs_of(scene).roulette || needs_of(scene).roulette_scale)
        << "the game would begin behind the last event";
    scene.settings.roulette_from = 0;
    scene.settings.roulette = false;
    EXPECT_FALSE(needs_of(scene).roulette || needs_of(scene).roulette_scale);
    EXPECT_FALSE(needs_of(world({diffuse, glossy, specular})).roulette_scale) << "nothing scales radiance";
    EXPECT_TRUE(needs_of(world({translucent})).roulette_scale);
}

}  // namespace
}  // namespace orrery::test
