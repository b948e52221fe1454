// Which light a vertex samples where it samples one of several: the alias table, the weights, and the kernels' columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "plan/alias_table.hpp"
#include "plan/worlds.hpp"

namespace orrery::test {
namespace {

using enum MaterialKind;

constexpr double whole = 1 << AliasTable::bits;

/// What drawing a cell and then comparing with its share gives each item.
std::vector<double> drawn_from(const AliasTable& table, std::size_t items) {
    std::vector<double> drawn(items, 0.0);
    const auto cells = static_cast<double>(table.cells.size());
    for (std::size_t c = 0; c < table.cells.size(); ++c) {
        if (table.cells[c].share > 0) drawn.at(c) += table.cells[c].share / whole / cells;
        if (table.cells[c].share < whole) drawn.at(table.cells[c].other) += (1 - table.cells[c].share / whole) / cells;
    }
    return drawn;
}

std::vector<double> normalised(std::vector<double> weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& weight : weights) weight /= sum;
    return weights;
}

std::vector<std::vector<double>> all_weights() {
    std::vector<std::vector<double>> all = {{1},
                                            {1, 1},
                                            {3, 1},
                                            {1, 0},
                                            {0, 0, 1, 0},
                                            {1, 2, 3, 4},
                                            {1e30, 1, 1e-30},
                                            {1e-300, 2e-300, 1e-300},
                                            {1e300, 1e300, 1e300}};
    std::mt19937_64 random(1);
    for (const std::size_t items : {5u, 17u, 64u, 1000u, 10'000u}) {
        all.emplace_back(items, 1.0);
        auto& some = all.emplace_back();
        for (std::size_t i = 0; i < items; ++i)
            some.push_back(random() % 7 == 0 ? 0 : std::exp2(static_cast<double>(random() % 60)));
    }
    return all;
}

// Not nearly: what is divided by the probability must be drawn with it.
TEST(AliasTable, DrawsWithExactlyTheProbabilitiesItTells) {
    for (const auto& weights : all_weights()) {
        const AliasTable table = alias_table(weights);
        ASSERT_EQ(table.probability.size(), weights.size());
        ASSERT_GE(table.cells.size(), weights.size());
        ASSERT_TRUE(std::has_single_bit(table.cells.size()));
        const auto drawn = drawn_from(table, weights.size());
        for (std::size_t i = 0; i < weights.size(); ++i) ASSERT_EQ(drawn[i], table.probability[i]) << i;
        ASSERT_EQ(std::accumulate(drawn.begin(), drawn.end(), 0.0), 1.0);
    }
}

TEST(AliasTable, ProbabilitiesAreTheWeightsToAPlaceOfTheNumbers) {
    for (const auto& weights : all_weights()) {
        const AliasTable table = alias_table(weights);
        const auto wanted = normalised(weights);
        const double place = 1 / whole / static_cast<double>(table.cells.size());
        const auto greatest = std::ranges::max(wanted);
        for (std::size_t i = 0; i < weights.size(); ++i) {
            EXPECT_EQ(table.probability[i] > 0, weights[i] > 0) << "what shines is found";
            const bool takes_the_rest = wanted[i] == greatest;
            EXPECT_NEAR(table.probability[i], wanted[i],
                        takes_the_rest ? place * static_cast<double>(weights.size()) : place);
        }
    }
}

TEST(AliasTable, HasOneItemAtLeast) {
    EXPECT_THROW(alias_table({}), std::invalid_argument);
    EXPECT_EQ(alias_table(std::vector<double>{7}).cells.size(), 1u);
}

/// Two point lights and two lamps, and some that are switched off.
Scene lights() {
    Scene scene = world({diffuse, glossy});
    scene.settings.light_choice = LightChoice::power;
    add_point_light(scene, {1, 2, 3});
    add_point_light(scene, {0, 0, 0});
    add_area_light(scene, {1, 0, 0});
    scene.primitives.back().radius = 2;
    add_area_light(scene, {0, 0, 0});
    add_area_light(scene, {0, 5, 1});
    scene.primitives.back().radius = 0.5;
    add_point_light(scene, {0, 0, 4});
    return scene;
}

// Point lights emit 4 pi I, spheres pi L from each of 4 pi r^2.
TEST(LightWeights, ArePowersWithAQuarterForAllAlike) {
    constexpr double pi = std::numbers::pi;
    const std::vector<double> powers = {4 * pi * 6, 4 * pi * 4, 4 * pi * 4 * pi * 1, pi * pi * 6};
    const auto wanted = normalised(powers);
    const auto weights = light_weights(lights(), LightChoice::power, true);
    ASSERT_EQ(weights.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(weights[i], 0.75 * wanted[i] + 0.0625, 1e-12);
    for (const double weight : light_weights(lights(), LightChoice::uniform, true)) EXPECT_EQ(weight, 0.25);
    const auto points = light_weights(lights(), LightChoice::power, false);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NEAR(points[0], 0.75 * 0.6 + 0.125, 1e-12);
}

TEST(LightWeights, FindTheDarkestBesideTheBrightest) {
    Scene scene = empty_world();
    for (const double power : {1e-300, 1e30, 1.7e308, 1e308, 1e-30}) add_point_light(scene, dvec3{power});
    const auto weights = light_weights(scene, LightChoice::power, true);
    for (const double weight : weights) EXPECT_GT(weight, 0.0499);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 1e-12);
    scene.point_lights.clear();
    add_point_light(scene, dvec3{5e-324});
    add_area_light(scene, dvec3{5e-324});
    scene.primitives.back().radius = 1e-3;
    for (const double weight : light_weights(scene, LightChoice::power, true)) EXPECT_GT(weight, 0.124);
}

template <class Real>
void expect_columns(const Plan& plan) {
    const auto& tables = plan.tables<Real>();
    const kernels::LightTable<Real>& table = tables.lights(true);
    ASSERT_EQ(table.count, 4u);
    ASSERT_EQ(table.cells, 4u);
    const auto wanted = light_weights(plan.scene(), plan.settings().light_choice, true);
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(1 / static_cast<double>(table.inverse_probability[i]), wanted[i], 1e-6);
        EXPECT_GE(table.share[i], 0);
        EXPECT_LE(table.share[i], 1);
        EXPECT_LT(table.other[i], 4u);
        EXPECT_NEAR(table.probability[i] * table.inverse_probability[i], 1, 1e-6);
    }
}

TEST(ChosenLights, HaveProbabilitiesInColumns) {
    Scene scene = lights();
    for (const LightChoice rule : {LightChoice::uniform, LightChoice::power}) {
        scene.settings.light_choice = rule;
        scene.settings.precision = Precision::binary32;
        expect_columns<float>(Plan(scene));
        scene.settings.precision = Precision::binary64;
        expect_columns<double>(Plan(scene));
    }
}

TEST(ChosenLights, AreThoseThatAVertexSamples) {
    const auto cells = [](const Scene& scene, bool area) { return Plan(scene).tables().lights(area).cells; };
    Scene scene = lights();
    scene.settings.transport = Transport::mis;
    EXPECT_EQ(cells(scene, true), 4u);
    EXPECT_EQ(cells(scene, false), 0u) << "every vertex samples area lights";
    scene.settings.transport = Transport::nee;
    EXPECT_EQ(cells(scene, true), 4u);
    EXPECT_EQ(cells(scene, false), 2u) << "glossy vertices leave area lights to their rays";
    scene.settings.transport = Transport::naive;
    EXPECT_EQ(cells(scene, true), 0u);
    EXPECT_EQ(cells(scene, false), 2u);
    EXPECT_EQ(Plan(scene).tables().lights(true).probability, nullptr) << "nothing competes";
    scene.settings.light_choice = LightChoice::all;
    EXPECT_EQ(cells(scene, false), 0u);
}

TEST(Needs, OneLightWhereAVertexHasSeveralToChooseFrom) {
    Scene scene = lights();
    EXPECT_TRUE(needs_of(scene).one_light);
    scene.settings.light_choice = LightChoice::all;
    EXPECT_FALSE(needs_of(scene).one_light);
    scene.settings.light_choice = LightChoice::uniform;
    for (const Integrator integrator : {Integrator::whitted, Integrator::depth}) {
        scene.settings.integrator = integrator;
        EXPECT_FALSE(needs_of(scene).one_light);
    }
    Scene one = world({diffuse});
    one.settings.light_choice = LightChoice::power;
    EXPECT_FALSE(needs_of(one).one_light);
    add_area_light(one);
    EXPECT_FALSE(needs_of(one).one_light);
    add_point_light(one);
    EXPECT_TRUE(needs_of(one).one_light);
    one.settings.transport = Transport::naive;
    EXPECT_FALSE(needs_of(one).one_light) << "it samples the point light alone";
}

}  // namespace
}  // namespace orrery::test
