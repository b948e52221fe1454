#include "image/tonemap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace orrery {
namespace {

TEST(Quantise, GivesEveryByteBack) {
    for (int byte = 0; byte < 256; ++byte) EXPECT_EQ(quantised(static_cast<float>(byte) / 255.0f), byte);
}

// Between two bytes the border is (2k + 1) / 510: the last float below it goes down, the first not below it goes up.
// Long double knows 255 x exactly and so does the test.
TEST(Quantise, RoundsEveryNeighbourhoodOfABorderExactly) {
    for (int byte = 0; byte < 255; ++byte) {
        float x = static_cast<float>((2 * byte + 1) / 510.0);
        for (int i = 0; i < 4; ++i) x = std::nextafter(x, 0.0f);
        for (int i = 0; i < 9; ++i, x = std::nextafter(x, 1.0f))
            EXPECT_EQ(quantised(x), std::lround(255.0L * static_cast<long double>(x))) << x;
    }
}

TEST(Quantise, RoundsTheHalfUp) {
    EXPECT_EQ(quantised(0.5f), 128);  // 127.5, the one border a float can hold
    EXPECT_EQ(quantised(std::nextafter(0.5f, 0.0f)), 127);
}

TEST(Quantise, ClampsWhatIsOutside) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(quantised(-0.0f), 0);
    EXPECT_EQ(quantised(-1e30f), 0);
    EXPECT_EQ(quantised(-inf), 0);
    EXPECT_EQ(quantised(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(quantised(std::nextafter(1.0f, 0.0f)), 255);
    EXPECT_EQ(quantised(1e30f), 255);
    EXPECT_EQ(quantised(inf), 255);
}

TEST(Quantise, KeepsTheOrderOfChannelsAndRows) {
    const Image image{2, 2, {{0, 1, 0.2f}, {1, 0, 0}, {0, 0, 1}, {0.4f, 0.6f, 0.8f}}};
    EXPECT_EQ(quantised(image), (std::vector<std::uint8_t>{0, 255, 51, 255, 0, 0, 0, 0, 255, 102, 153, 204}));
}

}  // namespace
}  // namespace orrery
