// The stages that sample caustics, one by one, on every instruction set: where the samples go, how often, and that
// chance and purpose weigh the same.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "kernels/stages.hpp"
#include "plan/caustics.hpp"
#include "reference/optics.hpp"
#include "reference/random.hpp"
#include "reference/world.hpp"
#include "wavefront/scenes.hpp"
#include "wavefront/wave_storage.hpp"

namespace orrery::test {
namespace {

using reference::Random;

constexpr std::uint32_t floor_id = 0, ball_id = 1, lamp_id = 2;
constexpr std::uint32_t vertices = 2048;

/// A vertex on top of a floor, a ball and a lamp anywhere above it.
Scene random_scene(Random& random, const Material& of_ball) {
    Scene scene = picture({0, 5, -5}, {0, 0, 0}, 30, 8);
    add_sphere(scene, {0, -50, 0}, 50, diffuse({0.8, 0.7, 0.6}));
    const auto place = [&](double low, double high) {
        const double turn = 2 * std::numbers::pi * random.uniform(), up = 0.2 + random.uniform();
        return (low + (high - low) * random.uniform()) * glm::normalize(dvec3{std::cos(turn), up, std::sin(turn)});
    };
    const dvec3 at = place(1.5, 5);
    const double radius = (0.1 + 0.8 * random.uniform()) * 0.9 * glm::length(at);
    add_sphere(scene, at, radius, of_ball);
    dvec3 lamp;
    do lamp = place(2, 9);
    while (glm::length(lamp - at) < 1.3 * radius);
    add_lamp(scene, lamp, 0.9 * std::min(0.1 + random.uniform(), glm::length(lamp - at) - radius), {5, 4, 3});
    return scene;
}

/// The rays that leave the vertex, all alike but for their numbers.
void put_vertices(WaveStorage<double>& q) {
    for (std::uint32_t i = 0; i < vertices; ++i) {
        q.rays.ox[i] = q.rays.oz[i] = 0, q.rays.oy[i] = 0;
        q.rays.tr[i] = q.rays.tg[i] = q.rays.tb[i] = 1;
        q.rays.departed[i] = floor_id, q.rays.slot[i] = i, q.rays.pixel[i] = i, q.rays.sample[i] = 3;
    }
}

/// Sphere met, or nothing, by a path that leaves `from` and makes the events of `chords` chords at the ball; the
/// probability of those.
struct Followed {
    bool arrives = false;
    double probability = 1;
    double red = 1;  ///< what all events leave of red, their probability apart
};
/// Over a glossy ball, with `reach` > 0, it arrives where the mirrored direction passes within that of the lamp's
/// centre.
Followed follow(const Scene& scene, const dvec3& from, dvec3 direction, std::uint32_t chords, double reach) {
    reference::Ray ray{from, direction, floor_id};
    Followed result;
    const Primitive& lamp = scene.primitives[lamp_id];
    for (std::uint32_t event = 0; event <= chords; ++event) {
        const auto hit = reference::closest_hit(scene.primitives, ray);
        if (hit.sphere != ball_id || hit.inside != (event > 0)) return {};
        const Primitive& ball = scene.primitives[ball_id];
        const dvec3 point = reference::surface_point(ball, ray, hit.distance);
        const dvec3 normal = (hit.inside ? -1.0 : 1.0) * (point - ball.centre) / ball.radius;
        const auto lobes = reference::lobes_of(scene.materials[ball.material], ray.direction, normal, hit.inside);
        const bool transmits = chords > 0 && (event == 0 || event == chords);
        const auto& lobe = lobes[transmits ? 1 : 0];
        result.probability *= lobe.probability;
        result.red *= lobe.weight.r / lobe.probability;
        ray = {point, lobe.axis, ball_id};
    }
    const dvec3 to = lamp.centre - ray.origin;
    const double along = glm::dot(to, ray.direction);
    result.arrives = reach > 0 ? along > 0 && glm::dot(to, to) - along * along < reach * reach
                               : reference::closest_hit(scene.primitives, ray).sphere == lamp_id;
    return result;
}

class CausticStages : public testing::TestWithParam<Isa> {};

TEST_P(CausticStages, SampleEveryWayToTheLampAndWeighAsChanceDoes) {
    const auto& stages = kernels::stages_for<double>(GetParam());
    Random random(11, 0);
    double chi2 = 0, excess = 0;
    int tests = 0;
    std::uint32_t samples = 0, astray = 0, other_weight = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const Material balls[] = {mirror(0.9), glass(0.9, random.uniform() < 0.3 ? 0.8 : 1.5),
                                  glossy(0.9, 0.02 + 0.3 * random.uniform())};
        const bool rough = trial % 3 == 2;
        Scene scene = random_scene(random, balls[trial % 3]);
        scene.settings.precision = Precision::binary64;
        const Primitive &ball = scene.primitives[ball_id], &lamp = scene.primitives[lamp_id];
        const double roughness = scene.materials[ball.material].roughness;
        const double reach = rough ? blurred_radius(glm::length(lamp.centre - ball.centre), lamp.radius, roughness) : 0;
        const Plan plan(scene);
        const auto& tables = plan.tables<double>();
        WaveStorage<double> q(plan.needs(), 8, vertices);
        ASSERT_EQ(tables.caustics.groups, 1u);
        const auto& group = tables.caustics.group[0];
        const dvec3 from{0};
        kernels::CausticContext<double> context{
            tables.spheres, tables.materials, tables.lights(true), q.slots, tables.caustics, 5, 0};
        for (std::uint32_t c = group.first; c < group.first + group.count; ++c) {
            const auto& caustic = tables.caustics.entries[c];
            double found = 0, found2 = 0;
            constexpr int waves = 16;
            for (int wave = 0; wave < waves; ++wave) {
                put_vertices(q);
                context.seed = 100 * static_cast<std::uint32_t>(trial) + static_cast<std::uint32_t>(wave);
                const std::uint32_t picked = stages.pick_caustics[0](context, {0, vertices}, q.rays, q.picks);
                if (picked == 0) continue;
                const std::uint32_t count =
                    stages.connect_caustic[0](context, c, picked, q.rays, q.lobes, q.picks, q.shadows);
                std::vector<std::pair<std::uint32_t, double>> by_chance;
                for (std::uint32_t i = 0; i < count; ++i) {
                    const dvec3 d{q.shadows.dx[i], q.shadows.dy[i], q.shadows.dz[i]};
                    const double scattering = d.y / std::numbers::pi;
                    const Followed there = follow(scene, from, d, caustic.chords, reach);
                    ++samples;
                    if (!there.arrives) {  // also what the floor hides
                        ++astray;
                        continue;
                    }
                    const double weight = q.shadows.r[i] / (5 * there.red);
                    // weight = b / (b + p): the density p of the samples is left.
                    const double density = scattering * there.probability * (1 / weight - 1);
                    found += 1 / density, found2 += 1 / (density * density);
                    // The same path by chance.
                    const auto slot = q.shadows.slot[i];
                    q.slots.chains.state[slot] = rough ? kernels::chain_begun : kernels::chain_closed | caustic.chords;
                    q.slots.chains.ball[slot] = ball_id, q.slots.chains.departed[slot] = floor_id;
                    q.slots.chains.x[slot] = q.slots.chains.y[slot] = q.slots.chains.z[slot] = 0;
                    q.slots.chains.dx[slot] = d.x, q.slots.chains.dy[slot] = d.y, q.slots.chains.dz[slot] = d.z;
                    q.slots.chains.pdf[slot] = scattering * there.probability;
                    if (rough) {
                        by_chance.emplace_back(i, weight * q.shadows.r[i]);
                        continue;
                    }
                    kernels::RayQueue<double> ray = q.sorted_rays;
                    ray.tr[0] = ray.tg[0] = ray.tb[0] = 1, ray.slot[0] = slot;
                    kernels::HitQueue<double> hit = q.sorted_hits;
                    hit.id[0] = lamp_id;
                    kernels::PickQueue<double> place = q.picks;
                    double* const radiance = q.slots.radiance + 4 * slot;
                    radiance[0] = 0;
                    kernels::CausticContext<double> later = context;
                    later.bounce = caustic.chords + 2;
                    const auto first_pick = place.place[0];
                    place.place[0] = 0;
                    stages.caustic_emission(later, 1, ray, hit, place);
                    place.place[0] = first_pick;
                    if (std::abs(radiance[0] / 5 - weight) > 1e-5) ++other_weight;
                }
                if (!rough) continue;
                context.bounce = 2;
                stages.weigh_shadows(context, 0, count, q.shadows);
                context.bounce = 0;
                for (const auto& [i, expected] : by_chance)
                    if (std::abs(q.shadows.r[i] - expected) > 1e-5) ++other_weight;
            }
            // The solid angle of the lamp seen so, by directions all over the ball's cone.
            const double distance = glm::length(ball.centre), sine = ball.radius / distance;
            const double range = 1 - std::sqrt(1 - sine * sine);
            constexpr int directions = 100000;
            int hits = 0;
            for (int k = 0; k < directions; ++k) {
                const dvec3 d = random.in_cone(ball.centre, 1 - range);
                if (d.y > 0 && follow(scene, from, d, caustic.chords, reach).arrives) ++hits;
            }
            const double n = waves * vertices, share = static_cast<double>(hits) / directions;
            const double expected = 2 * std::numbers::pi * range * share;
            const double mean = found / n, variance = (found2 / n - mean * mean) / n;
            const double of_expected =
                std::pow(2 * std::numbers::pi * range, 2) * (share * (1 - share) + 1.0 / directions) / directions;
            if (hits < 50) continue;  // no normal distribution
            const double z = (mean - expected) / std::sqrt(variance + of_expected);
            chi2 += z * z, excess += z;
            ++tests;
        }
    }
    ASSERT_GT(tests, 30);
    ASSERT_GT(samples, 10000u);
    EXPECT_LT(astray, samples / 100) << "of " << samples;
    EXPECT_LT(other_weight, samples / 1000) << "of " << samples;
    // Of that many independent squares of normal numbers; 5 standard deviations.
    EXPECT_LT(chi2, tests + 5 * std::sqrt(2.0 * tests));
    EXPECT_LT(std::abs(excess), 4 * std::sqrt(1.0 * tests)) << "over " << tests;
    RecordProperty("excess", std::to_string(excess / std::sqrt(1.0 * tests)));
}

INSTANTIATE_TEST_SUITE_P(Isas, CausticStages, testing::ValuesIn(supported_isas()),
                         [](const testing::TestParamInfo<Isa>& of) { return std::string(isa_name(of.param)); });

}  // namespace
}  // namespace orrery::test
