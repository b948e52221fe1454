// Who gets how many samples: by hand, and against every allocation near it.
#include "wavefront/allocation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace orrery {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

double error_of(const std::vector<Region>& regions, const std::vector<double>& samples) {
    double sum = 0;
    for (std::size_t i = 0; i < regions.size(); ++i) sum += regions[i].scatter / samples[i];
    return sum;
}

TEST(Allocation, FollowsTheRootOfTheScatterPerPixel) {
    // Per pixel 1, 4 and 25; by hand: n = s * (100 * 1 + 50 * 2 + 10 * 5) / target.
    const std::vector<Region> regions = {{100, 0, 100}, {50, 0, 200}, {10, 0, 250}};
    const auto samples = allocate(regions, 0.5, unlimited);
    EXPECT_NEAR(samples[0], 500, 1e-6);
    EXPECT_NEAR(samples[1], 1000, 1e-6);
    EXPECT_NEAR(samples[2], 2500, 1e-6);
    EXPECT_NEAR(error_of(regions, samples), 0.5, 1e-9);
    EXPECT_NEAR(total_samples(regions, samples), 125'000, 1e-3);
}

TEST(Allocation, TakesNothingBackAndSparesTheOthersForIt) {
    const std::vector<Region> regions = {{10, 900, 10}, {10, 10, 10}, {10, 10, 90}};
    const auto samples = allocate(regions, 1, unlimited);
    EXPECT_EQ(samples[0], 900);
    EXPECT_NEAR(samples[2], 3 * samples[1], 1e-6);
    EXPECT_NEAR(error_of(regions, samples), 1, 1e-9);
    // No samples moved between the other two make the error smaller.
    const double best = error_of(regions, samples);
    for (const double moved : {-1.0, -0.01, 0.01, 1.0})
        EXPECT_GE(error_of(regions, {samples[0], samples[1] + moved, samples[2] - moved}), best);
}

TEST(Allocation, StopsAtTheLimit) {
    const std::vector<Region> regions = {{100, 8, 100}, {50, 8, 200}};
    const auto samples = allocate(regions, 1e-9, 3000);
    EXPECT_NEAR(total_samples(regions, samples), 3000, 1e-6);
    EXPECT_NEAR(samples[1], 2 * samples[0], 1e-6);
    EXPECT_EQ(allocate(regions, 1e9, 3000), (std::vector<double>{8, 8})) << "there already";
    EXPECT_EQ(allocate(regions, 1e-9, 100), (std::vector<double>{8, 8})) << "beyond the limit already";
}

// A path that meets the brightest lamp there may be scatters by 1e60.
TEST(Allocation, IsTheSameForScatterOfAnySize) {
    const std::vector<Region> regions = {{10, 4, 10}, {10, 10, 10}, {10, 10, 90}};
    for (const double size : {1e-60, 1e-20, 1e20, 1e60}) {
        std::vector<Region> other = regions;
        for (Region& region : other) region.scatter *= size;
        for (const double limit : {unlimited, 400.0}) {
            const auto wanted = allocate(regions, 1, limit), samples = allocate(other, size, limit);
            for (std::size_t i = 0; i < regions.size(); ++i)
                EXPECT_NEAR(samples[i], wanted[i], 1e-9 * wanted[i]) << "region " << i << ", scatter times " << size;
        }
    }
}

TEST(Allocation, LeavesRegionsWithoutScatterAlone) {
    const std::vector<Region> regions = {{100, 8, 0}, {50, 8, 200}};
    EXPECT_EQ(allocate(regions, 0.1, unlimited)[0], 8);
}

}  // namespace
}  // namespace orrery
