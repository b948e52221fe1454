// The stages that look for point lights over smooth spheres, one by one, on every instruction set: every sphere is
// asked as often as the vertex says it is, and what a path carries is what rays beside it say.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "kernels/stages.hpp"
#include "reference/optics.hpp"
#include "reference/random.hpp"
#include "reference/world.hpp"
#include "wavefront/scenes.hpp"
#include "wavefront/wave_storage.hpp"

namespace orrery::test {
namespace {

using reference::Random;

constexpr std::uint32_t vertices = 2048;

/// A vertex at the origin, on the first sphere.
Scene on_floor(const Material& floor) {
    Scene scene = picture({0, 5, -5}, {0, 0, 0}, 30, 8);
    add_sphere(scene, {0, -50, 0}, 50, floor);
    scene.settings.precision = Precision::binary64;
    return scene;
}

dvec3 above(Random& random, double low, double high) {
    const double turn = 2 * std::numbers::pi * random.uniform(), up = 0.1 + random.uniform();
    return (low + (high - low) * random.uniform()) * glm::normalize(dvec3{std::cos(turn), up, std::sin(turn)});
}

/// Rays that leave the vertex, all alike but for their numbers and lobes.
struct Vertices {
    explicit Vertices(const Plan& the_plan)
        : plan(the_plan), tables(plan.tables<double>()), q(plan.needs(), 8, vertices) {
        for (std::uint32_t i = 0; i < tables.spheres.count; ++i)
            if (tables.spheres.radius[i] == 50) floor = i;
        for (std::uint32_t i = 0; i < vertices; ++i) {
            q.rays.ox[i] = q.rays.oy[i] = q.rays.oz[i] = 0;
            q.rays.tr[i] = 0.5, q.rays.tg[i] = 0.25, q.rays.tb[i] = 1;
            q.rays.departed[i] = floor, q.rays.slot[i] = i, q.rays.pixel[i] = i, q.rays.sample[i] = 3;
            if (q.lobes.x != nullptr) q.lobes.x[i] = 0.6, q.lobes.y[i] = 0.8, q.lobes.z[i] = 0;
        }
    }
    kernels::CausticContext<double> context(std::uint32_t seed) const {
        return {tables.spheres, tables.materials, tables.lights(false), q.slots, tables.caustics, seed, 0};
    }

    const Plan& plan;
    const Tables<double>& tables;
    WaveStorage<double> q;
    std::uint32_t floor = 0;
};

class PointCausticStages : public testing::TestWithParam<Isa> {};

TEST_P(PointCausticStages, AskEverySphereAsOftenAsTheySay) {
    const auto& stages = kernels::stages_for<double>(GetParam());
    Random random(21, 0);
    double chi2 = 0, excess = 0;
    int tests = 0;
    for (const std::uint32_t balls : {1u, 2u, 3u, 37u, 300u}) {
        Scene scene = on_floor(diffuse({0.8, 0.7, 0.6}));
        add_point_light(scene, {0, 30, 0}, {1, 1, 1});
        for (std::uint32_t b = 0; b < balls; ++b) {
            const dvec3 at = above(random, 1.5, 8);
            const double radius = std::pow(10, -1 - 2 * random.uniform());
            add_sphere(scene, at, radius, b % 3 == 0 ? mirror(0.9) : glass(0.9, 1.5));
        }
        const Plan plan(scene);
        Vertices v(plan);
        ASSERT_EQ(v.tables.caustics.over_points.levels, static_cast<std::uint32_t>(std::ceil(std::log2(balls))));
        std::map<std::uint32_t, std::pair<double, double>> sums;  // of 1 / probability, and of its square
        constexpr std::uint32_t waves = 800;
        for (std::uint32_t wave = 0; wave < waves; ++wave) {
            const auto context = v.context(1000 * balls + wave);
            const std::uint32_t picked = stages.pick_point_caustics[0](context, {0, vertices}, v.q.rays, v.q.picks);
            for (std::uint32_t i = 0; i < picked; ++i) {
                auto& [sum, square] = sums[static_cast<std::uint32_t>(v.q.picks.caustic[i])];
                const double weight = 1 / v.q.picks.probability[i];
                sum += weight, square += weight * weight;
            }
        }
        const double n = waves * vertices;
        double all = 0, variance = 0;
        for (const auto& [ball, s] : sums) {
            EXPECT_NE(ball, v.floor);
            all += s.first, variance += s.second;
            if (s.second / s.first > n / 100) continue;  // asked too seldom for a normal distribution
            const double z = (s.first - n) / std::sqrt(s.second - n);
            if (s.second - n > 1) chi2 += z * z, excess += z, ++tests;
        }
        EXPECT_NEAR(all / n, balls, 5 * std::sqrt(variance) / n + 0.01) << balls;
    }
    ASSERT_GT(tests, 60);
    EXPECT_LT(std::abs(chi2 - tests), 5 * std::sqrt(2.0 * tests)) << "over " << tests;
    EXPECT_LT(std::abs(excess), 4 * std::sqrt(1.0 * tests)) << "over " << tests;
}

/// What leaves the ball of a ray from the origin, after the events of so many chords, and their probability.
struct Leaving {
    reference::Ray ray;
    double probability = 0;
};
Leaving over(const Scene& scene, std::size_t ball_id, const dvec3& direction, std::uint32_t chords) {
    const Primitive& ball = scene.primitives[ball_id];
    reference::Ray ray{dvec3{0}, glm::normalize(direction)};
    double probability = 1;
    for (std::uint32_t event = 0; event <= chords; ++event) {
        const auto hit = reference::closest_hit({ball}, ray);
        if (hit.sphere != 0 || hit.inside != (event > 0)) return {};
        const dvec3 point = reference::surface_point(ball, ray, hit.distance);
        const dvec3 normal = (hit.inside ? -1.0 : 1.0) * (point - ball.centre) / ball.radius;
        const auto lobes = reference::lobes_of(scene.materials[ball.material], ray.direction, normal, hit.inside);
        const auto& lobe = lobes[chords > 0 && (event == 0 || event == chords) ? 1 : 0];
        probability *= lobe.probability;
        ray = {point, lobe.axis, 0};
    }
    return {ray, probability};
}

TEST_P(PointCausticStages, CarryWhatRaysBesideThemSay) {
    const auto& stages = kernels::stages_for<double>(GetParam());
    const auto& plain = kernels::stages_for<double>(Isa::scalar);
    Random random(22, 0);
    std::uint32_t paths = 0, rough = 0, by_chords[3] = {};
    for (int trial = 0; trial < 120; ++trial) {
        const bool frosted = trial % 4 == 1, glossier = trial % 4 == 2;
        Scene scene = on_floor(frosted ? glass(0.8, 1.3, 0.9) : glossier ? glossy(0.8, 0.9) : diffuse({0.8, 0.7, 0.6}));
        const dvec3 at = above(random, 1.5, 5);
        const double radius = (0.1 + 0.6 * random.uniform()) * glm::length(at);
        const double etas[] = {1.5, 0.7, 2.4, 1};
        add_sphere(scene, at, radius,
                   trial % 5 == 0 ? tinted(mirror(0), {0.9, 0.7, 0.5})
                                  : tinted(glass(0, etas[static_cast<int>(4 * random.uniform())]), {0.9, 0.8, 0.7},
                                           {0.6, 0.8, 1}));
        dvec3 light;
        do light = above(random, 1, 9);
        while (glm::length(light - at) < 1.1 * radius);
        add_point_light(scene, light, {5, 4, 3});
        const Plan plan(scene);
        Vertices v(plan);
        const auto context = v.context(static_cast<std::uint32_t>(trial));
        const std::size_t response = frosted || glossier ? 1 : 0;
        std::uint32_t picked = stages.pick_point_caustics[response](context, {0, vertices}, v.q.rays, v.q.picks);
        if (picked == 0) continue;
        picked = std::min(picked, 40u);
        const Material& material = scene.materials[scene.primitives[1].material];
        for (std::uint32_t chords = 0; chords <= kernels::most_point_chords; ++chords) {
            const auto connect = [&](const auto& by) {
                return by.connect_point_caustic[response](context, chords, 0, {0, picked}, v.q.rays, v.q.lobes,
                                                          v.q.picks, v.q.shadows);
            };
            const std::uint32_t expected = connect(plain), count = connect(stages);
            EXPECT_EQ(count, expected) << trial << ", " << chords;
            for (std::uint32_t i = 0; i < count && i < 5; ++i) {
                const dvec3 d{v.q.shadows.dx[i], v.q.shadows.dy[i], v.q.shadows.dz[i]};
                const auto there = over(scene, 1, d, chords);
                ASSERT_GT(there.probability, 0);
                const dvec3 apart = light - there.ray.origin;
                const dvec3 miss = apart - glm::dot(apart, there.ray.direction) * there.ray.direction;
                // Solid angle per area at the light, by neighbouring rays.
                const dvec3 u = glm::normalize(glm::cross(d, dvec3{0.3, 0.5, 0.8})), w = glm::cross(d, u);
                const auto meets = [&](const dvec3& direction) {
                    const auto ray = over(scene, 1, direction, chords).ray;
                    const double t = glm::dot(light - ray.origin, there.ray.direction) /
                                     glm::dot(ray.direction, there.ray.direction);
                    return ray.origin + t * ray.direction;
                };
                constexpr double h = 1e-6;
                const dvec3 by_u = (meets(d + h * u) - meets(d - h * u)) / (2 * h),
                            by_w = (meets(d + h * w) - meets(d - h * w)) / (2 * h);
                const double spread = 1 / glm::length(glm::cross(by_u, by_w));
                EXPECT_LT(glm::length(miss), 1e-7 * (1 + 1 / std::sqrt(spread)) * glm::length(apart))
                    << trial << ", " << chords;
                double density = d.y / std::numbers::pi;
                if (response == 1) density = reference::lobe_density({1, dvec3{1}, {0.6, 0.8, 0}, {0, 1, 0}}, 0.9, d);
                const double probability = v.q.picks.probability[0];  // that of all vertices
                dvec3 truth = dvec3{0.5 * 5, 0.25 * 4, 3} * density * there.probability * spread / probability;
                if (chords != 1) truth *= material.rho;
                if (chords > 0) truth *= material.rho_t * material.rho_t;
                const dvec3 carried{v.q.shadows.r[i], v.q.shadows.g[i], v.q.shadows.b[i]};
                ++paths, ++by_chords[chords];
                if (!(glm::length(carried - truth) < 1e-4 * glm::length(truth))) ++rough;
            }
        }
    }
    for (const std::uint32_t some : by_chords) EXPECT_GT(some, 50u);
    EXPECT_LE(rough, paths / 300) << "of " << paths;  // next to folds
}

INSTANTIATE_TEST_SUITE_P(Isas, PointCausticStages, testing::ValuesIn(supported_isas()),
                         [](const testing::TestParamInfo<Isa>& of) { return std::string(isa_name(of.param)); });

}  // namespace
}  // namespace orrery::test
