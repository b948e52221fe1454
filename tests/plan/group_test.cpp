// Groups of spheres: every sphere once, inside its bound, and no hit lost or changed by passing a group.
#include "plan/group.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "kernels/stages.hpp"
#include "plan/plan.hpp"

namespace orrery {
namespace {

/// Beads, balls and a ground: sizes over four decades, some overlapping.
std::vector<Primitive> crowd(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-10, 10), size(-2, 0.3);
    std::vector<Primitive> primitives(count);
    for (Primitive& p : primitives) {
        p.centre = {place(random), place(random), place(random)};
        p.radius = std::pow(10.0, size(random));
    }
    primitives.front().centre = {0, -1000, 0};
    primitives.front().radius = 990;
    return primitives;
}

TEST(Group, HoldsEverySphereOnceWithinItsBound) {
    const auto primitives = crowd(1000, 1);
    const Grouping grouping = group_spheres(primitives);
    EXPECT_EQ(std::set<std::uint32_t>(grouping.order.begin(), grouping.order.end()).size(), primitives.size());
    ASSERT_FALSE(grouping.end.empty());
    EXPECT_EQ(grouping.end.back(), primitives.size());
    EXPECT_LT(grouping.ungrouped, 200u);
    std::uint32_t place = grouping.ungrouped;
    for (std::size_t g = 0; g < grouping.end.size(); ++g) {
        EXPECT_LT(place, grouping.end[g]);
        for (; place < grouping.end[g]; ++place) {
            const Primitive& p = primitives[grouping.order[place]];
            const glm::dvec3 centre(grouping.cx[g], grouping.cy[g], grouping.cz[g]);
            EXPECT_LT(glm::distance(centre, p.centre) + p.radius, std::sqrt(static_cast<double>(grouping.radius2[g])));
        }
    }
}

TEST(Group, LeavesTheLargestAlone) {
    const Grouping grouping = group_spheres(crowd(1000, 2));
    const auto alone = std::set<std::uint32_t>(grouping.order.begin(), grouping.order.begin() + grouping.ungrouped);
    EXPECT_TRUE(alone.contains(0u)) << "the ground";
}

TEST(Group, LeavesFewSpheresInTheirOrder) {
    const Grouping grouping = group_spheres(crowd(group_crossover - 1, 3));
    EXPECT_TRUE(grouping.end.empty());
    EXPECT_EQ(grouping.ungrouped, group_crossover - 1);
    for (std::uint32_t i = 0; i < grouping.order.size(); ++i) EXPECT_EQ(grouping.order[i], i);
}

/// The same rays against the same table with and without its groups.
TEST(Group, ChangesNoHitAndNoOcclusion) {
    constexpr std::uint32_t count = 20000;
    Scene scene;
    scene.materials.resize(1);
    scene.primitives = crowd(500, 4);
    scene.settings.width = scene.settings.height = 1;
    const Plan plan(scene);
    ASSERT_GT(plan.spheres().groups.count, 10u);
    auto linear = plan.spheres();
    linear.groups = {};

    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    std::array<std::vector<float>, 8> columns;
    for (auto& column : columns) column.resize(count + kernels::widest);
    for (std::uint32_t i = 0; i < count; ++i) {
        // Half the rays graze: they aim at the rim of a sphere, where a bound too tight would show first.
        const glm::vec3 o = glm::vec3(normal(random), normal(random), normal(random)) * 12.0f;
        glm::vec3 d(normal(random), normal(random), normal(random));
        if (i % 2 == 0) {
            const Primitive& target = scene.primitives[1 + random() % 499];
            const glm::vec3 to = glm::vec3(target.centre) - o;
            const glm::vec3 side = glm::normalize(glm::cross(to, d));
            d = to + side * static_cast<float>(target.radius);
        }
        d = glm::normalize(d);
        const float values[] = {o.x, o.y, o.z, d.x, d.y, d.z, 0, i % 3 == 0 ? 8.0f : 1e30f};
        for (std::size_t c = 0; c < 8; ++c) columns[c][i] = values[c];
    }
    const kernels::SegmentColumns<float> segments{columns[0].data(), columns[1].data(), columns[2].data(),
                                                  columns[3].data(), columns[4].data(), columns[5].data(),
                                                  columns[6].data(), columns[7].data()};
    for (const Isa isa : all_isas) {
        if (!isa_supported(isa)) continue;
        const auto& stages = kernels::stages_for(isa);
        std::array<std::vector<float>, 2> t;
        std::array<std::vector<std::uint32_t>, 2> id, occluded;
        for (int with : {0, 1}) {
            const auto w = static_cast<std::size_t>(with);
            t[w].resize(count + kernels::widest);
            id[w].resize(count + kernels::widest);
            occluded[w].resize(count + kernels::widest);
            const auto& table = with == 1 ? plan.spheres() : linear;
            stages.intersects(table, segments, count, {t[w].data(), id[w].data()});
            stages.is_occluded(table, segments, count, occluded[w].data());
        }
        std::uint32_t hits = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            ASSERT_EQ(id[0][i], id[1][i]) << isa_name(isa) << " ray " << i;
            ASSERT_EQ(t[0][i], t[1][i]) << isa_name(isa) << " ray " << i;
            ASSERT_EQ(occluded[0][i], occluded[1][i]) << isa_name(isa) << " ray " << i;
            hits += id[0][i] != kernels::no_sphere ? 1u : 0u;
        }
        EXPECT_GT(hits, count / 4);
        EXPECT_LT(hits, count);
    }
}

}  // namespace
}  // namespace orrery
