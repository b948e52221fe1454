// Distributions against tables and closed forms; the chi-square test against its own claims.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "statistics/distributions.hpp"
#include "statistics/goodness_of_fit.hpp"
#include "statistics/moments.hpp"

namespace orrery::statistics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_relative(double value, double expected, double tolerance) {
    EXPECT_LE(std::abs(value - expected), tolerance * std::abs(expected)) << value << " instead of " << expected;
}

TEST(Moments, SurviveALargeOffset) {
    RunningMoments moments;
    EXPECT_EQ(moments.variance_of_mean(), 0);
    for (const double x : {4.0, 7.0, 13.0, 16.0}) moments.add(1e9 + x);
    EXPECT_EQ(moments.count(), 4u);
    EXPECT_DOUBLE_EQ(moments.mean(), 1e9 + 10);
    EXPECT_DOUBLE_EQ(moments.variance(), 30);
    EXPECT_DOUBLE_EQ(moments.variance_of_mean(), 7.5);
}

TEST(Normal, MatchesTables) {
    expect_relative(normal_upper_tail(6), 9.865876450376946e-10, 1e-13);
    expect_relative(normal_upper_quantile(0.025), 1.959963984540054, 1e-14);
    expect_relative(normal_upper_quantile(1e-15), 7.941345326170998, 1e-13);
    EXPECT_NEAR(normal_upper_quantile(0.5), 0, 1e-15);
    expect_relative(normal_upper_quantile(0.975), -1.959963984540054, 1e-14);
}

TEST(Normal, QuantileInvertsTheTailAsFarAsItGoes) {
    for (double tail = 0.4; tail > 1e-300; tail *= 1e-7) {
        expect_relative(normal_upper_tail(normal_upper_quantile(tail)), tail, 1e-11);
    }
}

TEST(Normal, FamilyThresholdSpendsAlphaOverAllTests) {
    expect_relative(family_threshold(0.05, 1), 1.959963984540054, 1e-13);
    for (const std::size_t tests : {2u, 51u, 1000000u}) {
        const double each = 2 * normal_upper_tail(family_threshold(1e-3, tests));
        expect_relative(-std::expm1(static_cast<double>(tests) * std::log1p(-each)), 1e-3, 1e-10);
    }
}

TEST(ChiSquare, MatchesTablesAndClosedForms) {
    expect_relative(chi_square_upper_tail(3.841458820694124, 1), 0.05, 1e-12);
    expect_relative(chi_square_upper_tail(18.307038053275146, 10), 0.05, 1e-12);
    expect_relative(chi_square_upper_tail(124.34211340400408, 100), 0.05, 1e-12);
    for (const double x : {0.01, 1.0, 3.9, 4.1, 50.0, 700.0}) {
        expect_relative(chi_square_upper_tail(x, 2), std::exp(-x / 2), 1e-13);
        expect_relative(chi_square_upper_tail(x, 1), std::erfc(std::sqrt(x / 2)), 1e-12);
    }
    EXPECT_EQ(chi_square_upper_tail(0, 5), 1);
}

TEST(Beta, MatchesClosedForms) {
    for (const double x : {0.0, 1e-3, 0.3, 0.5, 0.9, 1.0}) {
        EXPECT_NEAR(beta_regularised(1, 7, x), 1 - std::pow(1 - x, 7), 1e-14);
        EXPECT_NEAR(beta_regularised(2, 3, x), x * x * (6 - 8 * x + 3 * x * x), 1e-14);
    }
    for (const double a : {0.5, 3.0, 1000.0}) EXPECT_NEAR(beta_regularised(a, a, 0.5), 0.5, 1e-12);
}

TEST(Student, MatchesTablesAndClosedForms) {
    expect_relative(student_two_sided(2.364624251592785, 7), 0.05, 1e-12);
    expect_relative(student_two_sided(1.9623390808264078, 1000), 0.05, 1e-11);
    for (const double t : {0.1, 1.0, 5.0, 100.0}) {
        expect_relative(student_two_sided(t, 1), 2 / std::numbers::pi * std::atan(1 / t), 1e-12);
        expect_relative(student_two_sided(-t, 2), 1 - t / std::sqrt(2 + t * t), 1e-10);
    }
    expect_relative(student_two_sided(6, 0.9e7), student_two_sided(6, infinity), 1e-3);
}

TEST(Student, NormalEquivalentHasTheSameTail) {
    EXPECT_NEAR(normal_equivalent(2.364624251592785, 7), 1.959963984540054, 1e-10);
    EXPECT_NEAR(normal_equivalent(-3, infinity), -3, 1e-10);
    EXPECT_EQ(normal_equivalent(0, 5), 0);
    EXPECT_GT(normal_equivalent(infinity, infinity), 37);
    EXPECT_LT(normal_equivalent(-1e200, infinity), -37);
}

TEST(GoodnessOfFit, MendelsPeas) {
    const std::array<std::uint64_t, 4> observed{315, 108, 101, 32};
    const std::array<double, 4> expected{312.75, 104.25, 104.25, 34.75};
    const GoodnessOfFit fit = chi_square_test(observed, expected);
    EXPECT_NEAR(fit.statistic, 0.470024, 1e-6);
    EXPECT_EQ(fit.degrees, 3);
    EXPECT_NEAR(fit.p_value, 0.9254259, 1e-6);
}

TEST(GoodnessOfFit, PoolsCellsThatExpectLittle) {
    // 1 + 2 + 3 pool to 6; the rest stand alone.
    const std::array<std::uint64_t, 5> observed{10, 4, 1, 1, 14};
    const std::array<double, 5> expected{12, 3, 1, 2, 12};
    const GoodnessOfFit fit = chi_square_test(observed, expected);
    EXPECT_EQ(fit.degrees, 2);
    EXPECT_DOUBLE_EQ(fit.statistic, 4.0 / 12 + 4.0 / 12);
}

TEST(GoodnessOfFit, EverythingPooledDecidesNothing) {
    const std::array<std::uint64_t, 3> observed{2, 1, 3};
    const std::array<double, 3> expected{2, 2, 2};
    EXPECT_EQ(chi_square_test(observed, expected, 100).p_value, 1);
}

TEST(GoodnessOfFit, CountsWhereNothingMayBeAreFatal) {
    const std::array<std::uint64_t, 3> observed{500, 499, 1};
    const std::array<double, 3> expected{500, 500, 0};
    EXPECT_EQ(chi_square_test(observed, expected).p_value, 0);
}

TEST(GoodnessOfFit, RefusesADensityThatDoesNotIntegrateToOne) {
    const std::array<std::uint64_t, 2> observed{500, 500};
    const std::array<double, 2> half{495, 495};
    EXPECT_THROW(chi_square_test(observed, half), std::invalid_argument);
}

// p-values of a density tilted by `tilt`, tested as if it were uniform.
std::vector<double> p_values(double tilt, int repetitions) {
    constexpr std::size_t cells = 20, draws = 2000;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform;
    const std::vector<double> expected(cells, static_cast<double>(draws) / cells);
    std::vector<double> result;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        std::vector<std::uint64_t> observed(cells);
        for (std::size_t i = 0; i < draws; ++i) {
            const double u = uniform(random);
            const double x = u + tilt * u * (1 - u);  // density 1 - tilt + 2 tilt x, to first order
            ++observed[std::min(cells - 1, static_cast<std::size_t>(x * cells))];
        }
        result.push_back(chi_square_test(observed, expected).p_value);
    }
    return result;
}

TEST(GoodnessOfFit, FalseAlarmsAsOftenAsClaimedAndAPlainBiasFound) {
    const auto below = [](const std::vector<double>& values, double p) {
        return static_cast<double>(std::ranges::count_if(values, [p](double v) { return v < p; })) /
               static_cast<double>(values.size());
    };
    const std::vector<double> fair = p_values(0, 2000);
    EXPECT_NEAR(below(fair, 0.05), 0.05, 4 * std::sqrt(0.05 * 0.95 / 2000));
    EXPECT_NEAR(below(fair, 0.5), 0.5, 4 * std::sqrt(0.5 * 0.5 / 2000));
    // A tilt of 0.5 shifts the statistic by n tilt^2 / 3 = 167, six of its standard deviations past the threshold.
    EXPECT_EQ(below(p_values(0.5, 50), 1e-3), 1);
}

}  // namespace
}  // namespace orrery::statistics
