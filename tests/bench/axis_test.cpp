#include <gmock/gmock.h>

#include "bench/report/plot.hpp"

namespace orrery::bench {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

void expect_ticks(const Axis& axis, const std::vector<double>& ticks) {
    EXPECT_THAT(axis.ticks(), Pointwise(DoubleNear(1e-9), ticks));
}

TEST(Axis, TicksOfALogarithmicAxisAreRoundAndCoverTheData) {
    expect_ticks(Axis(3, 70, true), {2, 5, 10, 20, 50, 100});
    expect_ticks(Axis(0.05, 0.3, true), {0.05, 0.1, 0.2, 0.5});
    expect_ticks(Axis(10, 1000, true), {10, 20, 50, 100, 200, 500, 1000});
}

TEST(Axis, TicksOfALinearAxisBeginAtZeroAndAreFew) {
    expect_ticks(Axis(0, 97, false), {0, 20, 40, 60, 80, 100});
    expect_ticks(Axis(0, 0.6, false), {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6});
    for (double high = 1e-3; high < 1e9; high *= 1.37) {
        const Axis axis(0, high, false);
        EXPECT_GE(axis.ticks().back(), high * (1 - 1e-9)) << high;
        EXPECT_LE(axis.ticks().size(), 8u) << high;
        EXPECT_GE(axis.ticks().size(), 3u) << high;
    }
}

TEST(Axis, OneValueStillHasALength) {
    const Axis axis(10, 10, true);
    EXPECT_LT(axis.place(10), axis.place(20));
}

TEST(Axis, PlacesGoFromEndToEnd) {
    const Axis logarithmic(2, 200, true);
    EXPECT_NEAR(logarithmic.place(2), 0, 1e-12);
    EXPECT_NEAR(logarithmic.place(20), 0.5, 1e-12);
    EXPECT_NEAR(logarithmic.place(200), 1, 1e-12);
    const Axis linear(0, 80, false);
    EXPECT_NEAR(linear.place(0), 0, 1e-12);
    EXPECT_NEAR(linear.place(40), 0.5, 1e-12);
}

TEST(ShortNumber, HasThreeDigitsAndAUnit) {
    EXPECT_EQ(short_number(8), "8");
    EXPECT_EQ(short_number(0.25), "0.25");
    EXPECT_EQ(short_number(999.2), "999");
    EXPECT_EQ(short_number(999.9), "1k");
    EXPECT_EQ(short_number(65536), "65.5k");
    EXPECT_EQ(short_number(1048576), "1.05M");
    EXPECT_EQ(short_number(2.5e9), "2.5G");
}

/// How often `part` occurs.
std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

TEST(Plots, DrawEveryPointAndEscapeNames) {
    const std::string svg =
        svg_of(LinePlot{"a < b", "x", "y", {{"one", {{1, 2}, {10, 20}, {100, 5}}}, {"two & three", {{1, 1}}}}});
    EXPECT_EQ(count(svg, "<circle"), 4u);
    EXPECT_EQ(count(svg, "<path"), 2u);
    EXPECT_EQ(count(svg, "a &lt; b"), 1u);
    EXPECT_EQ(count(svg, "two &amp; three"), 1u);
    EXPECT_EQ(count(svg, "nan"), 0u);
}

TEST(Plots, LeaveOutBarsThatWereNotMeasured) {
    const std::string svg = svg_of(BarPlot{"t", "y", {"a", "b"}, {"g", "h"}, {{1, 0}, {3, 4}}, true});
    EXPECT_EQ(count(svg, "<rect"), 3u);
    EXPECT_EQ(count(svg_of(BarPlot{"t", "y", {"a"}, {}, {}}), "<rect"), 0u);
    EXPECT_EQ(count(svg_of(LinePlot{"t", "x", "y", {}}), "nan"), 0u);
}

}  // namespace
}  // namespace orrery::bench
