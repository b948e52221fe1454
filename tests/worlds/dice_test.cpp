// The dice: known numbers, and distributions by their moments.
#include "worlds/dice.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace orrery::worlds {
namespace {

constexpr int throws = 100'000;

/// The mean of `sample(dice)` over many dice of one throw each, as the worlds use them.
template <class Sample>
double mean_of(const Sample& sample) {
    double sum = 0;
    for (int i = 0; i < throws; ++i) {
        Dice dice(1, 2, static_cast<std::uint64_t>(i));
        sum += sample(dice);
    }
    return sum / throws;
}

TEST(DiceTest, AreTheSameWheneverAsked) {
    Dice a(1, 2, 3), b(1, 2, 3);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(a.bits(), b.bits());
    EXPECT_NE(Dice(1, 2, 3).bits(), Dice(2, 2, 3).bits());
    EXPECT_NE(Dice(1, 2, 3).bits(), Dice(1, 3, 3).bits());
    EXPECT_NE(Dice(1, 2, 3).bits(), Dice(1, 2, 4).bits());
}

// Each bound is five standard errors: sqrt(variance / throws) of the distribution named.
TEST(DiceTest, UniformIsUniform) {
    EXPECT_NEAR(mean_of([](Dice& d) { return d.uniform(); }), 0.5, 5 * std::sqrt(1 / 12.0 / throws));
    EXPECT_NEAR(mean_of([](Dice& d) { return d.uniform() < 0.1; }), 0.1, 5 * std::sqrt(0.09 / throws));
    EXPECT_NEAR(mean_of([](Dice& d) { return d.uniform() * d.uniform(); }), 0.25,
                5 * std::sqrt((1 / 9.0 - 1 / 16.0) / throws));
}

TEST(DiceTest, BellHasItsVariance) {
    // Variance 1/9; the fourth moment of the mean of three uniforms on [-1, 1] is (3/5 + 2) / 81.
    EXPECT_NEAR(mean_of([](Dice& d) { return d.bell(); }), 0, 5 * std::sqrt(1 / 9.0 / throws));
    EXPECT_NEAR(mean_of([](Dice& d) { return std::pow(d.bell(), 2); }), 1 / 9.0,
                5 * std::sqrt((2.6 / 81 - 1 / 81.0) / throws));
}

TEST(DiceTest, DirectionsAreUnitAndEven) {
    for (int i = 0; i < 1000; ++i) {
        Dice dice(5, 0, static_cast<std::uint64_t>(i));
        ASSERT_NEAR(glm::length(dice.direction()), 1, 1e-12);
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(mean_of([=](Dice& d) { return d.direction()[axis]; }), 0, 5 * std::sqrt(1 / 3.0 / throws));
        EXPECT_NEAR(mean_of([=](Dice& d) { return std::pow(d.direction()[axis], 2); }), 1 / 3.0,
                    5 * std::sqrt((1 / 5.0 - 1 / 9.0) / throws));
    }
}

TEST(DiceTest, BallIsFilledEvenly) {
    EXPECT_NEAR(mean_of([](Dice& d) { return glm::length(d.in_ball()) < 0.5; }), 1 / 8.0,
                5 * std::sqrt(7 / 64.0 / throws));
}

TEST(DiceTest, PowerLawHasItsTail) {
    // P(x > 2) on [1, 10] with exponent 3: (2^-2 - 10^-2) / (1 - 10^-2).
    const double expected = 0.24 / 0.99;
    EXPECT_NEAR(mean_of([](Dice& d) { return d.power_law(1, 10, 3) > 2; }), expected,
                5 * std::sqrt(expected * (1 - expected) / throws));
    for (int i = 0; i < 1000; ++i) {
        const double x = Dice(1, 0, static_cast<std::uint64_t>(i)).power_law(1, 10, 3);
        ASSERT_GE(x, 1);
        ASSERT_LE(x, 10 * (1 + 1e-12));
    }
}

}  // namespace
}  // namespace orrery::worlds
