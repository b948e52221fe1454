#include "image/tonemap.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace orrery {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float largest = std::numeric_limits<float>::max();
constexpr float smallest = std::numeric_limits<float>::denorm_min();

Image row(std::vector<Rgb> pixels) {
    const auto width = static_cast<std::uint32_t>(pixels.size());
    return {width, 1, std::move(pixels)};
}

/// One grey value through a mapper.
float grey(float value, ToneMap mapper) {
    const Rgb mapped = tone_mapped(row({{value, value, value}}), mapper).pixels[0];
    EXPECT_EQ(mapped.r, mapped.g);
    EXPECT_EQ(mapped.r, mapped.b);
    return mapped.r;
}

TEST(Sigmoid, IsIOverOnePlusI) {
    EXPECT_EQ(grey(0, ToneMap::sigmoid), 0.0f);
    EXPECT_EQ(grey(1, ToneMap::sigmoid), 0.5f);
    EXPECT_EQ(grey(3, ToneMap::sigmoid), 0.75f);
    EXPECT_EQ(grey(0.25f, ToneMap::sigmoid), 0.2f);
}

TEST(Sigmoid, KeepsSmallValuesAndReachesOneForHugeOnes) {
    EXPECT_EQ(grey(1e-20f, ToneMap::sigmoid), 1e-20f);
    EXPECT_EQ(grey(smallest, ToneMap::sigmoid), smallest);
    EXPECT_EQ(grey(1e30f, ToneMap::sigmoid), 1.0f);
    EXPECT_EQ(grey(largest, ToneMap::sigmoid), 1.0f);
    EXPECT_EQ(grey(inf, ToneMap::sigmoid), 1.0f);
}

TEST(Sigmoid, TreatsChannelsApart) {
    EXPECT_EQ(tone_mapped(row({{0, 1, 3}}), ToneMap::sigmoid).pixels[0], (Rgb{0, 0.5f, 0.75f}));
}

// Table 1 of IEC 61966-2-1 has no such values; these are its formula's in decimal arithmetic.
TEST(Srgb, IsWhatScreensUndo) {
    EXPECT_EQ(grey(0, ToneMap::srgb), 0.0f);
    EXPECT_NEAR(grey(0.002f, ToneMap::srgb), 0.02584f, 1e-7);
    EXPECT_NEAR(grey(0.18f, ToneMap::srgb), 0.461356129f, 1e-6);
    EXPECT_NEAR(grey(0.5f, ToneMap::srgb), 0.735356983f, 1e-6);
    EXPECT_EQ(grey(1, ToneMap::srgb), 1.0f);
    for (const float bright : {1.5f, largest, inf}) EXPECT_EQ(grey(bright, ToneMap::srgb), 1.0f);
    for (const float dark : {-1.0f, nan}) EXPECT_EQ(grey(dark, ToneMap::srgb), 0.0f);
}

TEST(Exposure, DoublesRadianceBeforeItIsMapped) {
    const auto exposed = [](float value, const Look& look) {
        return tone_mapped(row({{value, 0, 0}}), look).pixels[0].r;
    };
    EXPECT_EQ(exposed(1.5f, {ToneMap::sigmoid, 1}), 0.75f);
    EXPECT_EQ(exposed(0.5f, {ToneMap::none, -2}), 0.125f);
    EXPECT_EQ(exposed(0.25f, {ToneMap::srgb, 1}), grey(0.5f, ToneMap::srgb));
    EXPECT_EQ(exposed(0.25f, {ToneMap::linear, 3}), 1.0f);
    EXPECT_EQ(exposed(largest, {ToneMap::sigmoid, 100}), 1.0f);
    EXPECT_EQ(exposed(0.3f, {ToneMap::none, 0}), 0.3f);
}

TEST(Linear, DividesEachChannelByItsOwnMaximum) {
    const Image mapped = tone_mapped(row({{1, 10, 0.5f}, {4, 5, 0.25f}, {2, 0, 0}}), ToneMap::linear);
    EXPECT_EQ(mapped.pixels, (std::vector<Rgb>{{0.25f, 1, 1}, {1, 0.5f, 0.5f}, {0.5f, 0, 0}}));
}

TEST(Linear, LeavesABlackChannelBlack) {
    const Image mapped = tone_mapped(row({{0, 2, 0}, {0, 1, 0}}), ToneMap::linear);
    EXPECT_EQ(mapped.pixels, (std::vector<Rgb>{{0, 1, 0}, {0, 0.5f, 0}}));
}

TEST(Linear, TakesTheMaximumOverAllRows) {
    const Image mapped = tone_mapped({1, 2, {{2, 8, 1}, {4, 2, 1}}}, ToneMap::linear);
    EXPECT_EQ(mapped.width, 1u);
    EXPECT_EQ(mapped.height, 2u);
    EXPECT_EQ(mapped.pixels, (std::vector<Rgb>{{0.5f, 1, 1}, {1, 0.25f, 1}}));
}

TEST(Linear, ReachesOneWhateverTheScale) {
    for (const float scale : {smallest, 1e-30f, 0.3f, 1e30f, largest}) EXPECT_EQ(grey(scale, ToneMap::linear), 1.0f);
    const Image mapped = tone_mapped(row({{inf, largest, smallest}, {largest, 0, 0}}), ToneMap::linear);
    EXPECT_EQ(mapped.pixels, (std::vector<Rgb>{{1, 1, 1}, {1, 0, 0}}));
}

TEST(NoToneMap, ClampsToTheUnitInterval) {
    EXPECT_EQ(grey(0, ToneMap::none), 0.0f);
    EXPECT_EQ(grey(0.3f, ToneMap::none), 0.3f);
    EXPECT_EQ(grey(1, ToneMap::none), 1.0f);
    EXPECT_EQ(grey(1.0000001f, ToneMap::none), 1.0f);
    EXPECT_EQ(grey(inf, ToneMap::none), 1.0f);
}

TEST(AnyToneMap, MakesNegativeAndNotANumberBlack) {
    for (const ToneMap mapper : {ToneMap::sigmoid, ToneMap::linear, ToneMap::none}) {
        for (const float value : {-1.0f, -0.0f, -largest, -inf, nan}) EXPECT_EQ(grey(value, mapper), 0.0f);
        const Image mapped = tone_mapped(row({{nan, -3, 1}, {1, 1, nan}}), mapper);
        EXPECT_EQ(mapped.pixels[0].r, 0.0f);
        EXPECT_EQ(mapped.pixels[0].g, 0.0f);
        EXPECT_EQ(mapped.pixels[0].b, mapped.pixels[1].r);
        EXPECT_EQ(mapped.pixels[1].b, 0.0f);
    }
}

}  // namespace
}  // namespace orrery
