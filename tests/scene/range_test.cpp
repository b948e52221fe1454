// Bounds, open and closed, as written and as float.
#include "scene/range.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace orrery::test {
namespace {

bool accepts(const Range& range, double value) { return !expectation(range, value).has_value(); }

TEST(RangeTest, OpenBoundsExcludeAndClosedInclude) {
    EXPECT_FALSE(accepts(range::field_of_view, 0));
    EXPECT_TRUE(accepts(range::field_of_view, 1e-6));
    EXPECT_TRUE(accepts(range::field_of_view, 179.9));
    EXPECT_FALSE(accepts(range::field_of_view, 180));
    EXPECT_TRUE(accepts(range::reflectance, 0));
    EXPECT_TRUE(accepts(range::reflectance, 1));
    EXPECT_FALSE(accepts(range::reflectance, 1.0000001));
    EXPECT_TRUE(accepts(range::roughness, 0));
    EXPECT_FALSE(accepts(range::roughness, 1));
}

TEST(RangeTest, SquaresOfLengthsFitSinglePrecision) {
    for (const double length : {range::length.smallest, range::length.largest}) {
        EXPECT_TRUE(accepts(range::length, length));
        const float square = static_cast<float>(length) * static_cast<float>(length);
        EXPECT_GT(square, std::numeric_limits<float>::min());
        EXPECT_LT(square, std::numeric_limits<float>::max() / 100);
    }
    EXPECT_FALSE(accepts(range::length, 0.5e-18));
    EXPECT_FALSE(accepts(range::length, 2e18));
    EXPECT_TRUE(accepts(range::length_or_zero, 0));
    EXPECT_FALSE(accepts(range::length_or_zero, 1e-19));
}

TEST(RangeTest, CoordinatesAreBoundedOnBothSides) {
    EXPECT_TRUE(accepts(range::coordinate, 0));
    EXPECT_TRUE(accepts(range::coordinate, -1e18));
    EXPECT_FALSE(accepts(range::coordinate, -1.1e18));
    EXPECT_TRUE(accepts(range::coordinate, 1e-300)) << "a coordinate that rounds to 0 is where 0 is";
}

TEST(RangeTest, NonFiniteNumbersFitNowhere) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
        for (const Range& range : {range::coordinate, range::length, range::ratio, range::radiance}) {
            EXPECT_FALSE(accepts(range, bad)) << bad;
        }
    }
}

TEST(RangeTest, DescriptionNamesTheContractsBounds) {
    EXPECT_EQ(describe(range::field_of_view), "a number > 0 and < 180");
    EXPECT_EQ(describe(range::reflectance), "a number >= 0 and <= 1");
    EXPECT_EQ(describe(range::length), "a number > 0");
    EXPECT_EQ(describe(range::coordinate), "a number");
}

}  // namespace
}  // namespace orrery::test
