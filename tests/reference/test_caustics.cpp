// Point lights over one smooth sphere, where the irradiance has a closed form: on an axis by the matrices of paraxial
// optics, in a mirror so large that it is plane, through glass of index 1; and which chains count.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <numbers>

#include "reference/small_scenes.hpp"

namespace orrery::reference {
namespace {

using glm::dvec3;
using std::numbers::pi;

/// One point of a speck so small that no path ever comes back to it, with this normal, seen from straight above.
Scene speck(const dvec3& point, const dvec3& normal, const Material& material, std::uint32_t depth) {
    const double radius = 1e-4;
    Scene scene = looking(point + 0.25 * normal, point, depth);
    add_sphere(scene, point - radius * normal, radius, material);
    return scene;
}

void add_point(Scene& scene, const dvec3& position, double intensity) {
    scene.point_lights.push_back({"light", position, dvec3{intensity}});
}

/// `thousands` of samples of a thousand directions each.
statistics::Estimate found(const Scene& scene, std::uint32_t thousands = 2, double lamp_radius = 0.1) {
    return estimate(scene, {.samples = thousands * 1000, .caustic_directions = 1000, .lamp_radius = lamp_radius});
}

/// Within four standard errors, which are less than so much of the truth.
void expect_mean(const statistics::Estimate& value, double truth, double precision) {
    EXPECT_LT(value.standard_error(), precision * truth);
    EXPECT_LT(std::abs(deviation(value, truth)), 4) << value.mean << " instead of " << truth;
}

// Of a ray near the axis: its height, and its angle with the axis along the unfolded path.
glm::dmat2 travel(double length) { return {1, 0, length, 1}; }
glm::dmat2 mirrored(double curvature) { return {1, 2 * curvature, 0, 1}; }  // curvature > 0: convex
glm::dmat2 refracted(double curvature, double n) { return {1, (1 / n - 1) * curvature, 0, 1 / n}; }

/// Light that leaves a point into the solid angle w arrives on an area of w height^2, where the matrix of the path
/// makes heights of angles.
double irradiance(const glm::dmat2& path) { return 1 / (path[1][0] * path[1][0]); }

TEST(Caustic, OnTheAxisIsThatOfParaxialOptics) {
    const double to_light = 5, to_speck = 8, radius = 1;  // from the centre
    const double before = to_light - radius, after = to_speck - radius, rho_r = 0.9, rho_t = 0.8, k = 1 / radius;
    for (const double eta : {3.0, 0.5}) {
        const double f = std::pow((eta - 1) / (eta + 1), 2), t = rho_t * (1 - f);
        const glm::dmat2 in = refracted(k, eta) * travel(before), out = travel(after) * refracted(-k, 1 / eta);
        const double off = rho_r * f * irradiance(travel(after) * mirrored(k) * travel(before));
        const double through = t * t * irradiance(out * travel(2 * radius) * in);
        const double back =
            t * t * rho_r * f * irradiance(out * travel(2 * radius) * mirrored(-k) * travel(2 * radius) * in);
        Material ball = glass(rho_r, eta);
        ball.rho_t = dvec3{rho_t};
        const auto seen = [&](double light, std::uint32_t depth) {
            Scene scene = speck({0, 0, -to_speck}, {0, 0, 1}, diffuse(dvec3{0.5}), depth);
            add_sphere(scene, {0, 0, 0}, radius, ball);
            add_point(scene, {0, 0, light}, pi / 0.5);
            return scene;
        };
        const double open = 1 / std::pow(to_speck - to_light, 2);
        EXPECT_NEAR(found(seen(-to_light, 1), 1).mean, open, 1e-6);
        expect_mean(found(seen(-to_light, 2), 1), open + off, 1e-4);
        expect_mean(found(seen(-to_light, 4), 3), open + off + back, 1e-4);
        EXPECT_EQ(found(seen(to_light, 2), 1).mean, 0);
        expect_mean(found(seen(to_light, 3), 4, 0.2), through, 0.02);
    }
}

TEST(Caustic, OffALargeMirrorComesFromTheImageOfTheLight) {
    const dvec3 normal = glm::normalize(dvec3{0.6, -0.3, 0.2}), image{2, -1, 0}, point{0, 1, 0};
    Scene scene = speck(point, normal, diffuse(dvec3{0.5}), 2);
    add_sphere(scene, {0, -1e5, 0}, 1e5, mirror(0.7));
    add_point(scene, {2, 1, 0}, 10);
    const auto received = [&](const dvec3& from) {
        const double d = glm::length(from - point);
        return 0.5 / pi * 10 * glm::dot(from - point, normal) / (d * d * d);
    };
    expect_mean(found(scene, 10, 0.2), received({2, 1, 0}) + 0.7 * received(image), 0.02);
}

// Glass of index 1 reflects nothing and bends nothing: behind it is what would be there without it.
Material air() {
    Material material = glass(1, 1);
    material.rho = dvec3{0};
    return material;
}
void add_air(Scene& scene, const dvec3& centre, double radius) { add_sphere(scene, centre, radius, air()); }

TEST(Caustic, ThroughGlassOfIndexOneIsTheDirectLight) {
    const dvec3 normal = glm::normalize(dvec3{0.5, 0.4, 1});
    for (const Material& material : {diffuse(dvec3{0.5}), glossy(0.5, 0.9), glass(1, 1.2, 0.9)}) {
        const auto seen = [&](std::uint32_t depth) {
            Scene scene = speck({0, 0, 0}, normal, material, depth);
            add_point(scene, {0, 0, 4}, 10);
            return scene;
        };
        const double direct = estimate(seen(1)).mean;
        EXPECT_GT(direct, 0);
        Scene behind = seen(3);
        add_air(behind, {0.3, 0.2, 2}, 0.7);
        expect_mean(found(behind, 1), direct, 0.03);
        behind.settings.depth = 2;
        EXPECT_EQ(found(behind, 1).mean, 0);
    }
}

// Light from the side through glass of index 1, as if there were none.
struct Side {
    explicit Side(std::uint32_t depth) : scene(speck({0, 0, 0}, {0, 0, 1}, diffuse(dvec3{0.5}), depth)) {
        add_point(scene, {3, 0, 4}, 10);
        add_air(scene, {1.5, 0, 2}, 0.5);
    }
    Scene scene;
    double direct = 0.5 / pi * 10 * 0.8 / 25;
};

TEST(Caustic, CountsTheEventsBeforeItsVertex) {
    for (std::uint32_t depth = 1; depth <= 6; ++depth) {  // eye, air in and out, speck, air in and out: five
        Side side(depth);
        add_air(side.scene, {0, 0, 0.12}, 0.05);
        if (depth < 5) {
            EXPECT_EQ(found(side.scene, 1).mean, 0) << depth;
        } else {
            expect_mean(found(side.scene, 1), side.direct, 0.03);
        }
    }
}

TEST(Caustic, IsBlockedByAnySphereOnItsWayAndByNoneBeyond) {
    const auto with = [](const dvec3& centre, double radius, const Material& material) {
        Side side(3);
        add_sphere(side.scene, centre, radius, material);
        return found(side.scene, 1);
    };
    const Material black = diffuse(dvec3{0});
    const dvec3 before{0.6, 0, 0.8}, within{1.5, 0, 2}, behind{2.4, 0, 3.2}, beyond{3.6, 0, 4.8};
    for (const dvec3& in_the_way : {before, within, behind}) {
        EXPECT_EQ(with(in_the_way, 0.3, black).mean, 0) << in_the_way.x;
        EXPECT_EQ(with(in_the_way, 0.3, air()).mean, 0) << "a second sphere at " << in_the_way.x;
    }
    for (const dvec3& aside : {beyond, dvec3{1.5, 2, 2}}) expect_mean(with(aside, 0.5, black), Side(3).direct, 0.03);
}

TEST(Caustic, NeedsASmoothSphereWithVertexAndLightOutside) {
    const auto gain = [](std::uint32_t depth, const dvec3& centre, double radius, const Material& material) {
        Side side(depth);
        side.scene.primitives.pop_back();
        add_sphere(side.scene, centre, radius, material);
        return found(side.scene, 1).mean - estimate(side.scene, {.samples = 1000, .caustics = false}).mean;
    };
    EXPECT_GT(gain(3, {1.5, 0, 2}, 0.5, air()), 0);
    EXPECT_EQ(gain(3, {1.5, 0, 2}, 0.5, glass(1, 1, 0.1)), 0) << "rough";
    EXPECT_EQ(gain(3, {3, 0, 4}, 0.5, air()), 0) << "light within";
    EXPECT_EQ(gain(3, {0, 0, 0}, 2, air()), 0) << "vertex within";
    EXPECT_GT(gain(4, {-2, 0, 3}, 1, mirror(1)), 0);
    EXPECT_EQ(gain(4, {-2, 0, 3}, 1, glossy(1, 0.01)), 0) << "gloss is no mirror";
}

TEST(Caustic, IsNoPartOfWhittedRayTracingOrOfOptionsWithoutIt) {
    Side side(5);
    EXPECT_EQ(estimate(side.scene, {.samples = 1000, .caustics = false, .caustic_directions = 1000}).mean, 0);
    side.scene.settings.integrator = Integrator::whitted;
    EXPECT_EQ(found(side.scene).mean, 0);
}

}  // namespace
}  // namespace orrery::reference
