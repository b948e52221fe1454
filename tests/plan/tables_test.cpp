// What the kernels read: one column per attribute, readable to a whole vector behind the last entry.
#include <gtest/gtest.h>

#include "kernels/queues.hpp"
#include "plan/worlds.hpp"

namespace orrery::test {
namespace {

using kernels::Scattering;
using enum MaterialKind;

Scattering way_of(const Plan& plan, std::size_t sphere) {
    return static_cast<Scattering>(plan.tables().spheres.surface[sphere] >> kernels::surface_material_bits &
                                   kernels::surface_kind_mask);
}

bool emits(const Plan& plan, std::size_t sphere) {
    return (plan.tables().spheres.surface[sphere] & kernels::surface_emits) != 0;
}

TEST(SphereTable, HoldsPrimitivesInTheirOrder) {
    Scene scene = world({glossy, diffuse, glossy});
    scene.primitives[2] = {"", {1, 2, 3}, 4, 0, {}};
    const Plan plan(scene);
    const auto& s = plan.tables().spheres;
    ASSERT_EQ(s.count, 3u);
    EXPECT_EQ(of_scene(plan, dvec3{s.cx[2], s.cy[2], s.cz[2]}), (dvec3{1, 2, 3}));
    EXPECT_EQ(of_scene(plan, s.radius[2]), 4);
    EXPECT_EQ(s.surface[0] & kernels::surface_material_mask, 0u);
    EXPECT_EQ(s.surface[1] & kernels::surface_material_mask, 1u);
    EXPECT_EQ(s.surface[2] & kernels::surface_material_mask, 0u) << "two spheres may share a material";
}

// Many spheres stand in their tree's order, and everything that speaks of a sphere by its place goes with them.
TEST(SphereTable, HoldsManyPrimitivesInTheirTreesOrder) {
    Scene scene = world({diffuse, specular});
    for (int i = 0; scene.primitives.size() < 200; ++i) {
        add_area_light(scene, dvec3{0.5 + i});
        Primitive& p = scene.primitives.back();
        p.centre = {(i * 37) % 101, (i * 53) % 97, (i * 71) % 89};
        p.radius = 1.0 / 256 * (i + 1);  // tells them apart
        p.material = static_cast<std::uint32_t>(i) % 2;
        if (i % 3 != 0) p.emission.reset();
    }
    const Plan plan(scene);
    const auto& s = plan.tables().spheres;
    ASSERT_EQ(s.count, 200u);
    ASSERT_GT(s.tree.count, 0u);
    std::uint32_t moved = 0, lights = 0;
    for (std::uint32_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& p = scene.primitives[i];
        std::uint32_t k = 0;
        while (k < s.count && (of_scene(plan, s.radius[k]) != p.radius ||
                               of_scene(plan, dvec3{s.cx[k], s.cy[k], s.cz[k]}) != p.centre))
            ++k;
        ASSERT_LT(k, s.count) << "primitive " << i << " is lost";
        moved += k != i;
        EXPECT_EQ(s.surface[k] & kernels::surface_material_mask, p.material);
        ASSERT_EQ(emits(plan, k), p.emission.has_value());
        if (!p.emission) continue;
        const auto& all = plan.tables().lights(true);
        EXPECT_EQ(all.sphere[s.light[k]], k);
        EXPECT_EQ(all.r[s.light[k]], p.emission->r);
        EXPECT_EQ(all.radius[s.light[k]], s.radius[k]);
        EXPECT_EQ(s.light[k], lights++) << "lights stand in the scene's order";
    }
    EXPECT_GT(moved, 100u);
}

TEST(SphereTable, SaysHowSurfacesScatter) {
    Scene scene = world({diffuse, specular, glossy, dielectric, translucent});
    {
        const Plan plan(scene);
        for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(way_of(plan, k), static_cast<Scattering>(k));
    }
    scene.settings.integrator = Integrator::whitted;  // follows the unperturbed direction
    const Plan plan(scene);
    EXPECT_EQ(way_of(plan, 2), Scattering::specular);
    EXPECT_EQ(way_of(plan, 4), Scattering::dielectric);
}

TEST(Lights, AreTheSpheresThatEmitAndThePoints) {
    Scene scene = world({diffuse});
    add_area_light(scene, {0, 0, 0});
    add_area_light(scene, {1, 2, 3});
    add_area_light(scene, {4, 5, 6});
    add_point_light(scene, dvec3{0});
    add_point_light(scene, {7, 8, 9});
    const Plan plan(scene);
    EXPECT_FALSE(emits(plan, 0));
    EXPECT_FALSE(emits(plan, 1)) << "switched off";
    const auto& lights = plan.tables().lights(true);
    ASSERT_EQ(lights.points, 1u);
    ASSERT_EQ(lights.count, 3u);
    EXPECT_EQ(lights.cells, 0u) << "vertices sample them all";
    const auto place = [&](std::uint32_t i) { return of_scene(plan, dvec3{lights.px[i], lights.py[i], lights.pz[i]}); };
    const auto colour = [&](std::uint32_t i) { return dvec3{lights.r[i], lights.g[i], lights.b[i]}; };
    EXPECT_EQ(place(0), (dvec3{0, 5, 0}));
    EXPECT_EQ(of_scene(plan, of_scene(plan, colour(0))), (dvec3{7, 8, 9})) << "W/sr";
    EXPECT_EQ(lights.radius[0], 0);
    EXPECT_EQ(lights.sphere[0], kernels::no_sphere);
    for (std::uint32_t i = 1; i < 3; ++i) {
        const std::uint32_t sphere = i + 1;
        EXPECT_TRUE(emits(plan, sphere));
        EXPECT_EQ(plan.tables().spheres.light[sphere], i);
        EXPECT_EQ(lights.sphere[i], sphere);
        EXPECT_EQ(place(i), scene.primitives[sphere].centre);
        EXPECT_EQ(of_scene(plan, lights.radius[i]), 1);
        EXPECT_EQ(colour(i), *scene.primitives[sphere].emission);
    }
    EXPECT_EQ(plan.tables().lights(false).count, 1u) << "the point light alone";
}

TEST(MaterialTable, HoldsEveryNumber) {
    Scene scene = world({translucent});
    scene.materials[0] = {"", translucent, {0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, 1.7, 0.8};
    const Plan plan(scene);
    const auto& m = plan.tables().materials;
    EXPECT_EQ(m.count, 1u);
    EXPECT_EQ(m.rho_r[0], 0.1f);
    EXPECT_EQ(m.rho_g[0], 0.2f);
    EXPECT_EQ(m.rho_b[0], 0.3f);
    EXPECT_EQ(m.tau_r[0], 0.4f);
    EXPECT_EQ(m.tau_g[0], 0.5f);
    EXPECT_EQ(m.tau_b[0], 0.6f);
    EXPECT_EQ(m.eta[0], 1.7f);
    EXPECT_EQ(m.roughness[0], 0.8f);
}

TEST(Background, IsThatOfTheScene) {
    Scene scene = empty_world();
    EXPECT_FALSE(Plan(scene).tables().background.shines());
    scene.background = {0.25, 0, 4};
    const Plan plan(scene);
    EXPECT_TRUE(plan.tables().background.shines());
    EXPECT_EQ(plan.tables().background.r, 0.25f);
    EXPECT_EQ(plan.tables().background.b, 4.0f);
}

// Under AddressSanitizer this is the test that columns are padded, an empty scene's too.
TEST(Tables, CanBeReadAWholeVectorBehindTheEnd) {
    for (const Scene& scene : {empty_world(), world({diffuse, dielectric})}) {
        const Plan plan(scene);
        const auto& s = plan.tables().spheres;
        const auto& m = plan.tables().materials;
        const auto& e = plan.tables().lights(true);
        float sum = 0;
        std::uint32_t words = 0;
        for (std::uint32_t i = 0; i < kernels::widest; ++i) {
            for (const float* column : {s.cx, s.cy, s.cz, s.radius}) sum += column[s.count + i];
            for (const float* column : {m.rho_r, m.rho_g, m.rho_b, m.tau_r, m.tau_g, m.tau_b, m.eta, m.roughness})
                sum += column[m.count + i];
            for (const float* column : {e.px, e.py, e.pz, e.radius, e.r, e.g, e.b}) sum += column[e.count + i];
            words |= s.surface[s.count + i] | s.light[s.count + i] | e.sphere[e.count + i];
        }
        EXPECT_EQ(sum, 0);
        EXPECT_EQ(words, 0u);
    }
}

}  // namespace
}  // namespace orrery::test
