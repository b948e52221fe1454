// Surfaces listed twice: found however many there are and however they stand, told once, and no part of the plan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "plan/coincident.hpp"
#include "worlds.hpp"

namespace orrery::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double ulp = 0x1p-52, float_ulp = 0x1p-23;

std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(const std::vector<Twins>& twins) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> list;
    for (const Twins& t : twins) list.emplace_back(t.first, t.again);
    return list;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

double apart(const Primitive& a, const Primitive& b) {
    double most = std::abs(a.radius - b.radius);
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.centre[c] - b.centre[c]));
    return most / std::max({std::abs(b.centre.x), std::abs(b.centre.y), std::abs(b.centre.z), b.radius});
}

// Clusters a few tolerances wide, near and across powers of two, at zero and on both sides of it.
TEST(Coincidences, AreThoseOfComparingAllWithAll) {
    std::mt19937 dice(3);
    const auto uniform = [&] { return static_cast<double>(dice()) * 0x1p-31 - 1; };
    std::size_t found_same = 0, found_near = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const double near = std::ldexp(1.0, -10 - trial % 30), same = near / (1 + trial % 3);
        std::vector<Primitive> list;
        for (const dvec3& site : {dvec3{0, 0, 0}, {1, 0, 0}, {-2, 1e-3, 0}, {0.3, 1e3, -1}, {1e-9, 0, -1e-9}}) {
            const double radius = trial % 2 == 0 ? 1 : 1e-12;
            const double scale = std::max({std::abs(site.x), std::abs(site.y), std::abs(site.z), radius});
            for (int i = 0; i < 12; ++i) {
                const double spread = 3 * near * scale;
                list.push_back({"",
                                site + spread * dvec3{uniform(), uniform(), uniform()},
                                std::abs(radius + 0.3 * spread * uniform()),
                                0,
                                {}});
            }
        }
        std::ranges::shuffle(list, dice);
        Pairs expected;
        std::size_t expected_near = 0;
        std::vector<bool> kept(list.size(), true);
        for (std::uint32_t i = 0; i < list.size(); ++i) {
            std::size_t near_ones = 0;
            for (std::uint32_t j = 0; j < i && kept[i]; ++j) {
                if (!kept[j]) continue;
                const double by = apart(list[j], list[i]);
                if (by <= same) {
                    expected.emplace_back(j, i);
                    kept[i] = false;
                } else if (by <= near) {
                    ++near_ones;
                }
            }
            if (kept[i]) expected_near += near_ones;
        }
        const Coincidences found = coincidences(list, same, near);
        EXPECT_EQ(pairs(found.same), expected);
        EXPECT_EQ(found.near, expected_near);
        EXPECT_FALSE(found.too_many);
        EXPECT_LE(found.nearest.apart, near);
        found_same += expected.size(), found_near += expected_near;
    }
    EXPECT_GT(found_same, 100u);
    EXPECT_GT(found_near, 300u);
}

// b is near enough to a and c to b, but c not to a: c stays, whatever b's fate.
TEST(Coincidences, OfAChainTheOnesNearAKeptOneGo) {
    const auto at = [](double x) { return Primitive{"", {x, 0, 0}, 1, 0, {}}; };
    const double step = 6e-3, same = 1e-2;
    EXPECT_EQ(pairs(coincidences({at(0), at(step), at(2 * step), at(3 * step)}, same, same).same),
              (Pairs{{0, 1}, {2, 3}}));
    EXPECT_EQ(pairs(coincidences({at(0), at(-0.0)}, same, same).same), (Pairs{{0, 1}}));
    EXPECT_EQ(pairs(coincidences({at(step), at(0), at(2 * step)}, same, same).same), (Pairs{{0, 1}, {0, 2}}));
}

// A quarter of a million that share coordinates, a place, or all but the last: each sphere still meets few others.
TEST(Coincidences, AreFoundHoweverSpheresStand) {
    constexpr std::uint32_t many = 250000;
    const auto list = [](auto place) {
        std::vector<Primitive> all;
        for (std::uint32_t i = 0; i < many; ++i) all.push_back(place(i));
        return all;
    };
    const double same = 8 * 0x1p-53, near = 64 * 0x1p-24;
    const auto on_a_plane = list([](std::uint32_t i) {
        return Primitive{"", {1, double(i % 500), double(i / 500)}, 0.3, 0, {}};
    });
    EXPECT_EQ(coincidences(on_a_plane, same, near).same.size(), 0u);
    EXPECT_FALSE(coincidences(on_a_plane, same, near).too_many);
    const auto in_each_other = list([](std::uint32_t i) { return Primitive{"", {1, 2, 3}, 4 + 0.001 * i, 0, {}}; });
    EXPECT_EQ(coincidences(in_each_other, same, near).near, 0u);
    const auto one = list([](std::uint32_t) { return Primitive{"", {1, 2, 3}, 4, 0, {}}; });
    EXPECT_EQ(coincidences(one, same, near).same.size(), many - 1);
    auto twice = on_a_plane;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        twice.push_back(on_a_plane[i * 250]);
        twice.back().centre.y *= 1 + ulp;
    }
    EXPECT_EQ(coincidences(twice, same, near).same.size(), 1000u);
    EXPECT_TRUE(coincidences(list([](std::uint32_t i) {
                                 return Primitive{"", {1 + 1e-9 * i, 0, 0}, 1, 0, {}};
                             }),
                             1e-9, 1e-2)
                    .too_many)
        << "which would take forever";
}

Scene two(double shift, double thicker = 0) {
    Scene scene = world({MaterialKind::diffuse, MaterialKind::specular});
    scene.primitives[0].centre = {0.3, -0.7, 1};
    scene.primitives[1].centre = {0.3 + shift, -0.7, 1};
    scene.primitives[1].radius = 1 + thicker;
    return scene;
}

Precision precision_of(Scene scene) {
    scene.settings.precision = Precision::automatic;
    return Plan(std::move(scene)).settings().precision;
}

TEST(ListedTwice, IsOneSurfaceUpToRoundingsOfTheNumberTypeInUse) {
    struct Case {
        double shift;
        std::size_t in_float, in_double;
    };
    for (const Case& c : {Case{0, 1, 1},
                          {ulp, 1, 1},
                          {3 * ulp, 1, 1},
                          {-3 * ulp, 1, 1},
                          {9 * ulp, 1, 2},
                          {float_ulp, 1, 2},
                          {3 * float_ulp, 1, 2},
                          {9 * float_ulp, 2, 2},
                          {0.1, 2, 2}}) {
        for (Scene scene : {two(c.shift), two(0, c.shift)}) {
            scene.settings.precision = Precision::binary32;
            EXPECT_EQ(Plan(scene).tables<float>().spheres.count, c.in_float) << c.shift;
            scene.settings.precision = Precision::binary64;
            EXPECT_EQ(Plan(scene).tables<double>().spheres.count, c.in_double) << c.shift;
            scene.settings.precision = Precision::automatic;
            EXPECT_EQ(Plan(scene).scene().primitives.size(), c.in_double) << c.shift;
            EXPECT_EQ(Plan(scene).scene().primitives[0].material, 0u) << "the first wins";
        }
    }
}

TEST(ListedTwice, AutomaticTakesDoubleForWhatFloatCannotTellApart) {
    EXPECT_EQ(precision_of(two(0)), Precision::binary32);
    EXPECT_EQ(precision_of(two(2 * ulp)), Precision::binary32);
    for (const double shift : {1e-14, 1e-12, 1e-8, 3e-7, 3e-6}) {
        EXPECT_EQ(precision_of(two(shift)), Precision::binary64) << shift;
        EXPECT_EQ(precision_of(two(0, shift)), Precision::binary64) << shift;
    }
    EXPECT_EQ(precision_of(two(0.1)), Precision::binary32);
}

TEST(ListedTwice, IsToldOnceWithItsNumber) {
    Scene scene = two(0);
    EXPECT_EQ(Plan(scene).warnings().size(), 1u);
    EXPECT_EQ(Plan(scene).warnings()[0].where, "/scene/primitives/1");
    EXPECT_EQ(
        Plan(scene).warnings()[0].message,
        "found the same sphere as /scene/primitives/0, expected each once; the first listed wins and this one is no "
        "part of the image");
    for (std::size_t i = 0; i < 385; ++i) scene.primitives.push_back(scene.primitives[i % 2]);
    scene.primitives.back().centre.x += ulp;
    scene.primitives[100].emission = dvec3{1};
    scene.primitives[200].emission = dvec3{0};
    const Plan plan(scene);
    ASSERT_EQ(plan.warnings().size(), 1u);
    EXPECT_THAT(plan.warnings()[0].message, AllOf(HasSubstr("nor are 385 more"), HasSubstr("light of 1 of them")));
    EXPECT_EQ(plan.scene().primitives.size(), 1u);
    EXPECT_FALSE(plan.needs().emitters) << "the light goes with the surface";
}

TEST(ListedTwice, NearlyIsToldToo) {
    for (const auto& [precision, shift, type] :
         {std::tuple{Precision::binary32, 2e-6, "float"}, {Precision::binary64, 3e-15, "double"}}) {
        Scene scene = two(shift);
        scene.settings.precision = precision;
        const Plan plan(scene);
        ASSERT_EQ(plan.warnings().size(), 1u);
        EXPECT_THAT(plan.warnings()[0].message, HasSubstr(std::string("too little for ") + type));
        EXPECT_EQ(plan.scene().primitives.size(), 2u);
    }
    EXPECT_TRUE(Plan(two(0.1)).warnings().empty());
}

}  // namespace
}  // namespace orrery::test
