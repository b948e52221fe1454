#include "image/codec.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace orrery {
namespace {

using namespace std::string_literals;
using test::to_bytes;
using test::to_text;

const Image two_by_two{2, 2, {{0, 0.5f, 1}, {0.2f, 0.4f, 0.6f}, {1, 0, 0}, {2, -1, 0.04f}}};

TEST(Ppm, IsTheExpectedBytes) {
    EXPECT_EQ(to_text(encode_ppm(two_by_two, {})),
              "P6\n2 2\n255\n"
              "\x00\x80\xff\x33\x66\x99\xff\x00\x00\xff\x00\x0a"s);
}

TEST(Ppm, SaysWhatMadeItInComments) {
    EXPECT_EQ(to_text(encode_ppm({1, 1, {{0, 0, 0}}}, {{"scene", "a b.json"}, {"evil", "x\n9 9\n255\n"}})),
              "P6\n# scene: a b.json\n# evil: x 9 9 255 \n1 1\n255\n\0\0\0"s);
}

TEST(Ppm, ReadsComments) {
    const Image image = decode_ppm(to_bytes("P6 # magic\n# whole line\n1#\n \t1\r\n#\n255\n\x00\x33\xff"s));
    EXPECT_EQ(image.width, 1u);
    EXPECT_EQ(image.height, 1u);
    EXPECT_EQ(image.pixels[0], (Rgb{0, 0.2f, 1}));
}

// After maxval there is one white space; what follows are samples even where they look like white space or comments.
TEST(Ppm, TakesSamplesForWhatTheyAre) {
    const Image image = decode_ppm(to_bytes("P6\n1 1\n255\n\n# "));
    EXPECT_EQ(image.pixels[0], (Rgb{10 / 255.0f, '#' / 255.0f, ' ' / 255.0f}));
}

TEST(Ppm, ReadsOtherMaxvals) {
    EXPECT_EQ(decode_ppm(to_bytes("P6\n1 1\n1\n\0\1\1"s)).pixels[0], (Rgb{0, 1, 1}));
    EXPECT_EQ(decode_ppm(to_bytes("P6\n1 1\n100\n\0\x32\x64"s)).pixels[0], (Rgb{0, 0.5f, 1}));
    EXPECT_EQ(decode_ppm(to_bytes("P6\n1 1\n256\n\0\x80\1\0\0\0"s)).pixels[0], (Rgb{0.5f, 1, 0}));
    EXPECT_EQ(decode_ppm(to_bytes("P6\n1 1\n65535\n\x12\x34\xff\xff\0\1"s)).pixels[0],
              (Rgb{0x1234 / 65535.0f, 1, 1 / 65535.0f}));
}

TEST(Ppm, RefusesFaultyHeaders) {
    for (const std::string header : {"P5\n1 1\n255\n", "P6\n0 1\n255\n", "P6\n1 0\n255\n", "P6\n-1 1\n255\n",
                                     "P6\n1.5 1\n255\n", "P6\nx 1\n255\n", "P6\n1 1\n0\n", "P6\n1 1\n65536\n",
                                     "P6\n4294967296 1\n255\n", "P6\n99999999999999999999 1\n255\n", "P6\n1 1\n"})
        EXPECT_THROW(decode_ppm(to_bytes(header + "\0\0\0\0\0\0"s)), std::runtime_error) << header;
    EXPECT_THROW(decode_ppm(to_bytes("P6\n" + std::string(1000, '1'))), std::runtime_error);
    EXPECT_THROW(decode_ppm(to_bytes("P6\n#" + std::string(1000, '1'))), std::runtime_error);
}

TEST(Ppm, RefusesMorePixelsThanThereAre) {
    EXPECT_THROW(decode_ppm(to_bytes("P6\n1 1\n255\n\0\0"s)), std::runtime_error);
    EXPECT_THROW(decode_ppm(to_bytes("P6\n4294967295 4294967295\n255\n\0\0\0"s)), std::runtime_error);
    EXPECT_THROW(decode_ppm(to_bytes("P6\n4294967295 1\n65535\n\0\0\0"s)), std::runtime_error);
}

TEST(Ppm, RefusesSamplesAboveMaxval) {
    EXPECT_THROW(decode_ppm(to_bytes("P6\n1 1\n100\n\0\x65\0"s)), std::runtime_error);
}

}  // namespace
}  // namespace orrery
