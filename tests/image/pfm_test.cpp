#include "image/codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/temporary_folder.hpp"

namespace orrery {
namespace {

using namespace std::string_literals;
using test::to_bytes;
using test::to_text;

TEST(Pfm, IsTheExpectedBytes) {
    const Image image{1, 2, {{1, 2, -2}, {0.5f, 0, 1e10f}}};
    EXPECT_EQ(to_text(encode_pfm(image)),
              "PF\n1 2\n-1.0\n"
              "\0\0\0\x3f"  // bottom row first: 0.5, 0, 1e10
              "\0\0\0\0"
              "\xf9\x02\x15\x50"
              "\0\0\x80\x3f"  // 1, 2, -2
              "\0\0\0\x40"
              "\0\0\0\xc0"s);
}

TEST(Pfm, GivesEveryFloatBackBitForBit) {
    using limits = std::numeric_limits<float>;
    const Image image{
        2, 1, {{limits::max(), limits::denorm_min(), -0.0f}, {limits::infinity(), 0.1f, limits::quiet_NaN()}}};
    const Image read = decode_pfm(encode_pfm(image));
    EXPECT_EQ(read.pixels[0], image.pixels[0]);
    EXPECT_TRUE(std::signbit(read.pixels[0].b));
    EXPECT_EQ(read.pixels[1].r, limits::infinity());
    EXPECT_EQ(read.pixels[1].g, 0.1f);
    EXPECT_TRUE(std::isnan(read.pixels[1].b));
}

TEST(Pfm, ReadsBothByteOrders) {
    const Rgb expected{1, 0.5f, 2};
    for (const std::string scale : {"-1.0", "-1", "-0.25", "-1e3"})
        EXPECT_EQ(decode_pfm(to_bytes("PF\n1 1\n" + scale + "\n\0\0\x80\x3f\0\0\0\x3f\0\0\0\x40"s)).pixels[0],
                  expected);
    for (const std::string scale : {"1.0", "+1.0", "1", "2.5e0"})
        EXPECT_EQ(decode_pfm(to_bytes("PF\n1 1\n" + scale + "\n\x3f\x80\0\0\x3f\0\0\0\x40\0\0\0"s)).pixels[0],
                  expected);
}

TEST(Pfm, ReadsGreyAsAllThreeChannels) {
    const Image image = decode_pfm(to_bytes("Pf 1 2 1.0\n\x3f\x80\0\0\x40\0\0\0"s));
    EXPECT_EQ(image.pixels, (std::vector<Rgb>{{2, 2, 2}, {1, 1, 1}}));
}

TEST(Pfm, RefusesFaultyHeaders) {
    for (const std::string header :
         {"P6\n1 1\n-1.0\n", "PF\n0 1\n-1.0\n", "PF\n1 0\n-1.0\n", "PF\n1 -1\n-1.0\n", "PF\n1 1\n0\n", "PF\n1 1\nnan\n",
          "PF\n1 1\ninf\n", "PF\n1 1\n-1.0x\n", "PF\n1 1\none\n", "PF\n#\n1 1\n-1.0\n", "PF\n1 1\n1e99\n"})
        EXPECT_THROW(decode_pfm(to_bytes(header + std::string(12, '\0'))), std::runtime_error) << header;
}

TEST(Pfm, RefusesMorePixelsThanThereAre) {
    EXPECT_THROW(decode_pfm(to_bytes("PF\n1 1\n-1.0\n" + std::string(11, '\0'))), std::runtime_error);
    EXPECT_THROW(decode_pfm(to_bytes("PF\n4294967295 4294967295\n-1.0\n")), std::runtime_error);
    EXPECT_NO_THROW(decode_pfm(to_bytes("PF\n1 1\n-1.0\n" + std::string(12, '\0'))));
}

}  // namespace
}  // namespace orrery
