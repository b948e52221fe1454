// What contrasts promise is an expectation: it is computed here by going through every outcome there can be.
#include "film/contrasts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace orrery {
namespace {

/// A cell's sample is high with a chance, else low.
struct Cell {
    float low, high;
    double chance = 0.5;
    double variance() const { return std::pow(double{high} - low, 2) * chance * (1 - chance); }
    double third_cumulant() const { return std::pow(double{high} - low, 3) * chance * (1 - chance) * (1 - 2 * chance); }
};

/// Mean and variance of the sum over all outcomes, and the mean of what one pixel's contrasts say of that variance.
struct Expectation {
    double variance = 0, third_cumulant = 0;
    double estimated = 0, estimated_third_cumulant = 0;
};

Expectation over_all_outcomes(const std::vector<Cell>& samples, std::uint32_t columns, bool twice,
                              Contrasting contrasting = Contrasting::many) {
    Expectation result;
    for (const Cell& cell : samples) {
        result.variance += cell.variance();
        result.third_cumulant += cell.third_cumulant();
    }
    const std::size_t outcomes = std::size_t{1} << samples.size();
    std::vector<float> rgbx(4 * samples.size());
    for (std::size_t outcome = 0; outcome < outcomes; ++outcome) {
        Film film(1, 1, contrasting);
        double chance = 1;
        for (std::size_t s = 0; s < samples.size(); ++s) {
            const bool high = (outcome >> s & 1) != 0;
            chance *= high ? samples[s].chance : 1 - samples[s].chance;
            const float value = high ? samples[s].high : samples[s].low;
            rgbx[4 * s] = value;
            rgbx[4 * s + 1] = 2 * value;
            rgbx[4 * s + 2] = -value;
            rgbx[4 * s + 3] = std::numeric_limits<float>::quiet_NaN();
        }
        const auto count = static_cast<std::uint32_t>(samples.size());
        Contrasts contrasts;
        contrasts.begin(columns, twice);
        film.add(0, rgbx.data(), count);
        contrasts.add(film, 0, rgbx.data(), count);
        const PixelEstimate pixel = film.estimate(0);
        const double of_sum = static_cast<double>(count) * count;
        EXPECT_DOUBLE_EQ(pixel.variance.g, 4 * pixel.variance.r);
        EXPECT_DOUBLE_EQ(pixel.variance.b, pixel.variance.r);
        result.estimated += pixel.variance.r * of_sum * chance;
        const Spread& spread = film.spread(0);
        if (spread.steps > 0)
            result.estimated_third_cumulant +=
                double{spread.skews.r} * spread.contrasts / (2.0 * spread.steps) * chance;
    }
    return result;
}

TEST(Contrasts, OfRowsVisitedTwiceAreExactWhateverTheCells) {
    // Two cells each way, twice: row 0, row 0 again, row 1, row 1 again.
    const std::vector<Cell> samples = {{0, 1}, {5, 5}, {0, 1}, {5, 5}, {2, 9}, {-3, 0}, {2, 9}, {-3, 0}};
    const Expectation e = over_all_outcomes(samples, 2, true);
    EXPECT_NEAR(e.estimated, e.variance, 1e-12 * e.variance);
}

TEST(Contrasts, OfUniformSamplesAreExact) {
    for (const std::size_t count : {2u, 4u, 5u, 8u}) {  // of an odd number the last one has no partner
        const Expectation e = over_all_outcomes(std::vector<Cell>(count, Cell{1, 4}), 1, true);
        EXPECT_NEAR(e.estimated, e.variance, 1e-12 * e.variance) << count;
    }
}

TEST(Contrasts, TellHowSkewedSamplesAre) {
    for (const std::size_t count : {4u, 6u, 8u}) {
        const Expectation e = over_all_outcomes(std::vector<Cell>(count, Cell{1, 4, 0.1}), 1, true);
        EXPECT_NEAR(e.estimated_third_cumulant, e.third_cumulant, 1e-6 * e.third_cumulant) << count;
    }
    for (const bool twice : {false, true}) {
        const Expectation e = over_all_outcomes(std::vector<Cell>(16, Cell{0, 2, 0.2}), twice ? 2 : 4, twice);
        EXPECT_NEAR(e.estimated_third_cumulant, e.third_cumulant, 1e-6 * e.third_cumulant) << twice;
    }
}

// The cells of an edge have a variance and a mean between dark and bright, but no skewness.
TEST(Contrasts, DoNotTakeAnEdgeForSkewness) {
    const Cell dark{0, 0}, bright{8, 8}, half{0, 8};
    const Expectation e =
        over_all_outcomes({dark, half, bright, dark, half, bright, dark, half, bright, dark, half, bright}, 3, true);
    EXPECT_NEAR(e.estimated_third_cumulant, 0, 0.05 * std::pow(e.variance, 1.5));
}

TEST(Contrasts, OfTwoSequencesInTurnsAreExact) {
    for (const std::size_t count : {2u, 4u, 6u}) {
        const Expectation e = over_all_outcomes(std::vector<Cell>(count, Cell{1, 4}), 1, true, Contrasting::one);
        EXPECT_NEAR(e.estimated, e.variance, 1e-12 * e.variance) << count;
    }
}

// Samples of one sequence depend on each other, here as much as they can: all of them are low, or all high.
TEST(Contrasts, OfTwoSequencesKnowWhatTheirSamplesShare) {
    double estimated[2] = {0, 0};
    constexpr std::uint32_t each = 4;
    for (const unsigned outcome : {0u, 1u, 2u, 3u}) {
        std::vector<float> rgbx(std::size_t{4} * 2 * each);
        for (std::size_t s = 0; s < 2 * each; ++s) rgbx[4 * s] = (outcome >> s % 2 & 1u) != 0 ? 3.0f : 1.0f;
        for (const Contrasting contrasting : {Contrasting::many, Contrasting::one}) {
            Film film(1, 1, contrasting);
            Contrasts contrasts;
            contrasts.begin(1, true);
            film.add(0, rgbx.data(), 2 * each);
            contrasts.add(film, 0, rgbx.data(), 2 * each);
            const PixelEstimate pixel = film.estimate(0);
            estimated[contrasting == Contrasting::one ? 1 : 0] += pixel.variance.r / 4;
            EXPECT_EQ(pixel.degrees, contrasting == Contrasting::one ? 1 : each);
        }
    }
    // The mean of two numbers that are 1 or 3: variance 1 / 2.
    EXPECT_DOUBLE_EQ(estimated[1], 0.5);
    EXPECT_LT(estimated[0], 0.2) << "taken for independent";
}

/// f(x) + g(y) and noise that is the same in all cells.
std::vector<Cell> slope(std::uint32_t side) {
    std::vector<Cell> cells;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const auto mean = static_cast<float>(x * x + 10 * (y == 1));
            cells.push_back({mean - 0.5f, mean + 0.5f});
        }
    return cells;
}

TEST(Contrasts, OfRowsVisitedOnceIgnoreSlopesAndEdgesAlongTheGrid) {
    for (const std::uint32_t side : {2u, 3u, 4u}) {
        const Expectation e = over_all_outcomes(slope(side), side, false);
        EXPECT_NEAR(e.estimated, e.variance, 1e-12 * e.variance) << side;
    }
}

TEST(Contrasts, OfRowsVisitedOnceErrUpwardsAtObliqueEdges) {
    const Cell dark{0, 0}, bright{1, 1}, half{0, 1};
    const Expectation e = over_all_outcomes({dark, dark, half, dark, half, bright, half, bright, bright}, 3, false);
    EXPECT_GT(e.estimated, e.variance);
    EXPECT_LT(e.estimated, 3 * e.variance);
}

std::vector<float> noise(std::size_t samples) {
    std::mt19937 generator(1);
    std::vector<float> rgbx(4 * samples);
    for (float& value : rgbx) value = std::uniform_real_distribution<float>(0, 3)(generator);
    return rgbx;
}

struct Grid {
    std::uint32_t columns;
    bool twice;
    std::uint32_t samples;
    Contrasting contrasting = Contrasting::many;
};

TEST(Contrasts, AreTheSameHoweverTheSamplesArePortioned) {
    for (const auto& [columns, twice, samples, contrasting] : {Grid{1, true, 9},
                                                               {1, true, 40},
                                                               {2, false, 4},
                                                               {3, false, 9},
                                                               {6, false, 36},
                                                               {7, false, 49},
                                                               {4, true, 32},
                                                               {1, true, 40, Contrasting::one},
                                                               {1, true, 9, Contrasting::one}}) {
        const std::vector<float> rgbx = noise(samples);
        Spread whole;
        double variance = 0;
        for (std::uint32_t portion = samples; portion > 0; --portion) {
            Film film(2, 1, contrasting);
            Contrasts contrasts;
            contrasts.begin(columns, twice);
            for (const std::size_t pixel : {0u, 1u})
                for (std::uint32_t s = 0; s < samples; s += portion)
                    contrasts.add(film, pixel, rgbx.data() + 4 * s, std::min(portion, samples - s));
            if (portion == samples) {
                whole = film.spread(0);
                variance = film.estimate(0).variance.r;
            }
            for (const std::size_t pixel : {0u, 1u}) {
                EXPECT_EQ(film.spread(pixel).squares.r, whole.squares.r) << columns << ", portions of " << portion;
                EXPECT_EQ(film.spread(pixel).squares.b, whole.squares.b);
                EXPECT_EQ(film.spread(pixel).skews.g, whole.skews.g);
                EXPECT_EQ(film.spread(pixel).steps, whole.contrasts - 1);
                EXPECT_EQ(film.estimate(pixel).variance.r, variance);
                EXPECT_EQ(film.spread(pixel).members, whole.members);
                EXPECT_EQ(film.spread(pixel).contrasts, whole.contrasts);
            }
        }
        EXPECT_GE(whole.members, samples - 1);
    }
}

TEST(Contrasts, OfEqualSamplesAreExactlyZero) {
    std::vector<float> rgbx(4 * 49, 16777215.0f / 3.0f);
    Film film(1, 1);
    Contrasts contrasts;
    contrasts.begin(7, false);
    film.add(0, rgbx.data(), 49);
    contrasts.add(film, 0, rgbx.data(), 49);
    EXPECT_EQ(film.estimate(0).variance.r, 0.0);
    EXPECT_EQ(film.estimate(0).degrees, 16);
}

TEST(Contrasts, LeaveOutWhatIsNotFinite) {
    for (const bool twice : {false, true}) {
        std::vector<float> rgbx = noise(32);
        const auto spread_of = [&] {
            Film film(1, 1);
            Contrasts contrasts;
            contrasts.begin(4, twice);
            contrasts.add(film, 0, rgbx.data(), 16);
            return film.spread(0);
        };
        const Spread clean = spread_of();
        rgbx[4 * 6 + 1] = std::numeric_limits<float>::infinity();
        const Spread spread = spread_of();
        EXPECT_EQ(spread.contrasts, clean.contrasts - 1);
        EXPECT_EQ(spread.members, clean.members - (twice ? 2 : 4));
        EXPECT_LT(spread.squares.r, clean.squares.r);
        EXPECT_GT(spread.squares.r, 0);
        EXPECT_TRUE(std::isfinite(spread.squares.g));
    }
}

TEST(Contrasts, OfOneSampleTellNothing) {
    const std::vector<float> rgbx = noise(1);
    Film film(2, 1);
    Contrasts contrasts;
    contrasts.begin(1, false);
    film.add(0, rgbx.data(), 1);
    contrasts.add(film, 0, rgbx.data(), 1);
    EXPECT_TRUE(std::isinf(film.estimate(0).variance.r));
    EXPECT_EQ(film.estimate(0).mean.r, double{rgbx[0]});
    EXPECT_TRUE(std::isinf(film.estimate(1).variance.r)) << "no sample";
}

}  // namespace
}  // namespace orrery
