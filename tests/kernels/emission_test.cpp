// Stage `shade`, first step: what rays run into, and its weight against light sampling.
#include "geometry.hpp"
#include "kernel_test.hpp"
#include "light_reference.hpp"
#include "numbers.hpp"
#include "owned.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::LightStrategy;
using kernels::no_sphere;

constexpr double infinity = std::numeric_limits<double>::infinity();

class EmissionTest : public KernelTest {
protected:
    /// Spheres apart from each other, two of three shining.
    const World world{{{glm::dvec3(0, 0, 0), 1, 0, 0},
                       {glm::dvec3(4, 0, 0), 0.5, 0, -1},
                       {glm::dvec3(0, 5, 0), 2, 0, 1},
                       {glm::dvec3(0, 0, 9), 0.01, 0, 2}},
                      {Surface{}},
                      {{1, 2, 3}, {0.5, 0, 7}, {100, 200, 50}}};

    struct Wave {
        Rays rays;
        Hits hits;
        Slots slots;
        std::uint32_t count;
    };
    /// Rays from outside and inside towards every sphere and past them, as `intersect` would leave them.
    static Wave wave_of(const World& world, std::uint32_t count, bool with_pdf = true) {
        const std::uint32_t capacity = kernels::round_up(count) + kernels::widest;
        Wave w{with_pdf ? Rays(capacity) : Rays(capacity, {"pdf"}), Hits(capacity), Slots(capacity), count};
        Numbers random(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t k = random.below(world.spheres.count);
            const bool inside = i % 3 == 0;
            const glm::dvec3 o = world.centre(k) + random.direction() * world.radius(k) *
                                                       (inside ? 0.9 * random.uniform() : random.scale(1.01, 30));
            const glm::dvec3 target = world.centre(k) + random.direction() * world.radius(k) * 0.95 * random.uniform();
            put_ray(*w.rays, i, o, target - o, no_sphere, random.colour());
            w.rays->slot[i] = count - 1 - i;  // slots in another order than rays
            const Roots at = roots(origin_of(*w.rays, i), direction_of(*w.rays, i), world.centre(k), world.radius(k));
            w.hits->id[i] = inside ? k | inside_bit : k;
            w.hits->t[i] = narrow(inside ? at.far : at.near);
            if (i % 5 == 4) w.hits->id[i] = no_sphere, w.hits->t[i] = narrow(infinity);
            if (with_pdf) w.rays->pdf[i] = narrow(i % 7 == 0 ? infinity : i % 7 == 1 ? 0 : random.scale(1e-3, 1e3));
            if (i % 11 == 10) put3(w.rays->tr, w.rays->tg, w.rays->tb, i, glm::dvec3(0));
        }
        for (std::uint32_t s = 0; s < 4 * count; ++s) w.slots->radiance[s] = narrow(random.uniform());
        return w;
    }

    void expect_agrees(const World& in, const Wave& w, LightStrategy strategy) const {
        Slots out = w.slots;
        Rays rays = w.rays;
        stages.emission(in.spheres, in.lights, in.background, strategy, *rays, *w.hits, w.count, *out, {});
        EXPECT_TRUE(rays.same_as(w.rays, -Rays::guard, rays.capacity() + Rays::guard)) << "rays are only read";
        EXPECT_TRUE(out.untouched_but(w.slots, 0, w.count));
        std::vector<glm::dvec3> wanted(w.count);
        for (std::uint32_t s = 0; s < w.count; ++s)
            wanted[s] = {w.slots->radiance[4 * s], w.slots->radiance[4 * s + 1], w.slots->radiance[4 * s + 2]};
        for (std::uint32_t i = 0; i < w.count; ++i) {
            const std::uint32_t id = w.hits->id[i] & no_sphere;
            const glm::dvec3 throughput = throughput_of(*rays, i);
            glm::dvec3& sum = wanted[rays->slot[i]];
            if (id == no_sphere) {
                sum += throughput * glm::dvec3(in.background.r, in.background.g, in.background.b);
            } else if (in.lights.count > 0 && (in.spheres.surface[id] & kernels::surface_emits) != 0) {
                double weight = 1;
                if (rays->pdf != nullptr && rays->pdf[i] < infinity) {
                    double density = light_density(strategy, origin_of(*rays, i), direction_of(*rays, i), in.centre(id),
                                                   in.radius(id));
                    if (in.lights.probability != nullptr) density *= in.lights.probability[in.spheres.light[id]];
                    weight = rays->pdf[i] / (rays->pdf[i] + density);
                }
                const std::uint32_t light = in.spheres.light[id];
                sum += weight * throughput * get3(in.lights.r, in.lights.g, in.lights.b, light);
            }
        }
        for (std::uint32_t s = 0; s < w.count; ++s)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(out->radiance[4 * s + static_cast<std::uint32_t>(c)], wanted[s][c],
                            2e-5 * (1e-2 + wanted[s][c]))
                    << "slot " << s;
        for (std::uint32_t s = 0; s < w.count; ++s)
            ASSERT_EQ(out->radiance[4 * s + 3], w.slots->radiance[4 * s + 3]) << "the unused fourth number";
        if (!exact()) return;
        Slots same = w.slots;
        scalar.emission(in.spheres, in.lights, in.background, strategy, *w.rays, *w.hits, w.count, *same, {});
        EXPECT_TRUE(out.same_as(same, 0, w.count));
    }
};

TEST_P(EmissionTest, EmittersAreWeighedAgainstLightSampling) {
    for (const std::uint32_t count : awkward_counts)
        for (const auto strategy : {LightStrategy::area, LightStrategy::cone})
            expect_agrees(world, wave_of(world, count), strategy);
    expect_agrees(world, wave_of(world, 2001), LightStrategy::cone);
    expect_agrees(world, wave_of(world, 2001), LightStrategy::area);
}

// From outside light samples alone count, whatever the density of scattering; from within the two compete, as by area.
TEST_P(EmissionTest, ExactLightLeavesScatteringWhatIsWithinTheLight) {
    const World lamp({{glm::dvec3(0), 1, 0, 0}}, {Surface{}}, {{1, 2, 3}});
    const auto radiance = [&](LightStrategy strategy, bool within, double pdf) {
        const Rays rays(16);
        const Hits hits(16);
        const Slots slots(16);
        put_ray(*rays, 0, {within ? 0.5 : 3, 0, 0}, {-1, 0, 0});
        rays->pdf[0] = narrow(pdf);
        hits->id[0] = within ? inside_bit : 0;
        hits->t[0] = within ? 1.5f : 2;
        for (int c = 0; c < 3; ++c) slots->radiance[c] = 0;
        stages.emission(lamp.spheres, lamp.lights, lamp.background, strategy, *rays, *hits, 1, *slots, {});
        return slots->radiance[2];
    };
    for (const double pdf : {0.0, 0.25, 1e30}) {
        EXPECT_EQ(radiance(LightStrategy::exact, false, pdf), 0);
        EXPECT_EQ(radiance(LightStrategy::exact, true, pdf), radiance(LightStrategy::area, true, pdf));
    }
    EXPECT_GT(radiance(LightStrategy::exact, true, 0.25), 0.1);
    EXPECT_EQ(radiance(LightStrategy::exact, false, infinity), 3) << "no vertex has sampled it";
}

// Where vertices sample one light of several, a light competes in proportion to how often it is chosen.
TEST_P(EmissionTest, WhatIsChosenRarelyLeavesMoreToScattering) {
    World chosen({{glm::dvec3(0, 0, 0), 1, 0, 0},
                  {glm::dvec3(4, 0, 0), 0.5, 0, -1},
                  {glm::dvec3(0, 5, 0), 2, 0, 1},
                  {glm::dvec3(0, 0, 9), 0.01, 0, 2}},
                 {Surface{}}, {{1, 2, 3}, {0.5, 0, 7}, {100, 200, 50}});
    std::vector<float> probability(3 + kernels::widest, std::numeric_limits<float>::quiet_NaN());
    probability[0] = 0.625f, probability[1] = 0.25f, probability[2] = 0.125f;
    chosen.lights.probability = probability.data();
    for (const std::uint32_t count : awkward_counts)
        for (const auto strategy : {LightStrategy::area, LightStrategy::cone})
            expect_agrees(chosen, wave_of(chosen, count), strategy);
    expect_agrees(chosen, wave_of(chosen, 2001), LightStrategy::cone);
}

TEST_P(EmissionTest, WithoutCompetitionEmissionCountsWhole) {
    for (const std::uint32_t count : awkward_counts)
        expect_agrees(world, wave_of(world, count, false), LightStrategy::cone);
}

TEST_P(EmissionTest, MissesCarryTheBackground) {
    World with_background({{glm::dvec3(0, 0, 0), 1, 0, 0}, {glm::dvec3(4, 0, 0), 0.5}}, {Surface{}}, {{1, 2, 3}});
    with_background.background.r = 0.25f;
    with_background.background.g = 0.5f;
    with_background.background.b = 4;
    for (const std::uint32_t count : awkward_counts)
        expect_agrees(with_background, wave_of(with_background, count), LightStrategy::cone);
    with_background.lights.count = 0;
    with_background.background = {0, 0, 4};  // one channel is enough
    expect_agrees(with_background, wave_of(with_background, 125), LightStrategy::cone);
}

// Along the surface of its own light a ray meets it at t = 0, where the density of light sampling is 0 / 0, and the
// density of scattering may be 0 as well.
TEST_P(EmissionTest, WhatNoDensityTellsWeighsNothing) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const World lamp({{glm::dvec3(0), 1, 0, 0}}, {Surface{}}, {{1, 2, 3}});
    const auto radiance = [&](LightStrategy strategy, const glm::dvec3& direction, double pdf) {
        const Rays rays(16);
        const Hits hits(16);
        const Slots slots(16);
        put_ray(*rays, 0, {1, 0, 0}, direction, inside_bit);
        rays->pdf[0] = narrow(pdf);
        hits->id[0] = inside_bit;
        hits->t[0] = 0;
        slots->radiance[0] = slots->radiance[1] = slots->radiance[2] = 0;
        stages.emission(lamp.spheres, lamp.lights, lamp.background, strategy, *rays, *hits, 1, *slots, {});
        return slots->radiance[2];
    };
    for (const auto strategy : {LightStrategy::area, LightStrategy::cone}) {
        const glm::dvec3 aside{0, 1, 0}, back{-1, 0, 0};
        EXPECT_EQ(radiance(strategy, aside, 0.25), 0) << "0 / 0 against a number";
        EXPECT_EQ(radiance(strategy, aside, 0), 0);
        EXPECT_EQ(radiance(strategy, back, 0), 0) << "two densities of 0";
        EXPECT_EQ(radiance(strategy, aside, infinity), 3) << "what no light sample competes with counts whole";
        EXPECT_TRUE(std::isnan(radiance(strategy, back, none))) << "for the film to count";
    }
}

// What is no number reaches the film, whichever channel it is in.
TEST_P(EmissionTest, NoNumberIsLostWhicheverChannelItIsIn) {
    World shining({{glm::dvec3(0), 1, 0, 0}}, {Surface{}}, {{1, 2, 3}});
    shining.background.r = shining.background.g = shining.background.b = 1;
    for (const bool missed : {false, true})
        for (std::uint32_t channel = 0; channel < 3; ++channel) {
            glm::dvec3 throughput(0);
            throughput[static_cast<int>(channel)] = std::numeric_limits<double>::quiet_NaN();
            const Rays rays(16, {"pdf"});
            const Hits hits(16);
            const Slots slots(16);
            put_ray(*rays, 0, {3, 0, 0}, {-1, 0, 0}, no_sphere, throughput);
            hits->id[0] = missed ? no_sphere : 0;
            hits->t[0] = missed ? narrow(infinity) : 2;
            for (std::uint32_t c = 0; c < 4; ++c) slots->radiance[c] = 0;
            stages.emission(shining.spheres, shining.lights, shining.background, LightStrategy::cone, *rays, *hits, 1,
                            *slots, {});
            EXPECT_TRUE(std::isnan(slots->radiance[channel])) << "channel " << channel << (missed ? ", missed" : "");
        }
}

TEST_P(EmissionTest, ADarkWorldAddsNothing) {
    const World dark({{glm::dvec3(0, 0, 0), 1}});
    const Wave w = wave_of(dark, 125);
    Slots out = w.slots;
    stages.emission(dark.spheres, dark.lights, dark.background, LightStrategy::cone, *w.rays, *w.hits, 125, *out, {});
    EXPECT_TRUE(out.same_as(w.slots, -Slots::guard, out.capacity() + Slots::guard));
}

TEST_P(EmissionTest, DeadRaysAddNothing) {
    Wave w = wave_of(world, 125);
    for (std::uint32_t i = 0; i < 125; ++i) put3(w.rays->tr, w.rays->tg, w.rays->tb, i, glm::dvec3(0));
    Slots out = w.slots;
    stages.emission(world.spheres, world.lights, world.background, LightStrategy::cone, *w.rays, *w.hits, 125, *out,
                    {});
    EXPECT_TRUE(out.same_as(w.slots, -Slots::guard, out.capacity() + Slots::guard));
}

INSTANTIATE_TEST_SUITE_P(Isas, EmissionTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
