// Our files through netpbm's programs, and theirs through our readers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

#include "image/image_file.hpp"
#include "image/codec.hpp"
#include "sample_images.hpp"
#include "support/external_program.hpp"
#include "support/temporary_folder.hpp"

namespace orrery {
namespace {

using namespace std::string_literals;
using test::output_of;
using test::TemporaryFolder;

TEST(Netpbm, ReadsOurPpm) {
    const TemporaryFolder folder;
    const Image image{2, 1, {{0, 0.2f, 1}, {0.4f, 0.6f, 0.8f}}};
    write_image(folder / "x.ppm", image, ToneMap::none, {{"scene", "a.json"}, {"seed", "1 2 3"}});
    const Bytes plain = output_of(fmt::format("'{}' -plain '{}'", ORRERY_PAMTOPNM, (folder / "x.ppm").string()));
    std::istringstream words(test::to_text(plain));
    const std::vector<std::string> read(std::istream_iterator<std::string>(words), {});
    EXPECT_EQ(read, (std::vector<std::string>{"P3", "2", "1", "255", "0", "51", "255", "102", "153", "204"}));
}

TEST(Netpbm, ReadsOurPng) {
    const TemporaryFolder folder;
    for (const auto& [width, height] : test::sizes()) {
        const Image image = test::eight_bit_gradient(width, height);
        write_image(folder / "x.png", image, ToneMap::none, {{"scene", "a.json"}});
        const Bytes ppm = output_of(fmt::format("'{}' '{}'", ORRERY_PNGTOPNM, (folder / "x.png").string()));
        EXPECT_TRUE(test::to_text(ppm) == test::to_text(encode_ppm(image, {}))) << width << "x" << height;
    }
}

TEST(Netpbm, FindsTheMetadataOfOurPng) {
    const TemporaryFolder folder;
    write_image(folder / "x.png", test::gradient(2, 2), ToneMap::none, {{"scene", "a b.json"}, {"seed", "17"}});
    output_of(
        fmt::format("'{}' -text='{}' '{}'", ORRERY_PNGTOPNM, (folder / "text").string(), (folder / "x.png").string()));
    const std::string text = test::load(folder / "text");
    EXPECT_NE(text.find("scene"), text.npos) << text;
    EXPECT_NE(text.find("a b.json"), text.npos) << text;
    EXPECT_NE(text.find("17"), text.npos) << text;
}

// Values k / 255 survive the way through netpbm's 8 bits, rows upside down or bytes in the other order would not.
TEST(Netpbm, ReadsOurPfm) {
    const TemporaryFolder folder;
    for (const auto& [width, height] : test::sizes()) {
        const Image image = test::eight_bit_gradient(width, height);
        write_image(folder / "x.pfm", image, ToneMap::sigmoid, {});
        const Bytes ppm = output_of(
            fmt::format("'{}' -maxval=255 '{}' | '{}'", ORRERY_PFMTOPAM, (folder / "x.pfm").string(), ORRERY_PAMTOPNM));
        EXPECT_TRUE(decode_ppm(ppm).pixels == image.pixels) << width << "x" << height;
    }
}

TEST(Netpbm, WritesPfmWeRead) {
    const TemporaryFolder folder;
    const Image image = test::eight_bit_gradient(7, 5);
    test::store(folder / "x.ppm", encode_ppm(image, {}));
    for (const char* order : {"big", "little"}) {
        const Image read = decode_pfm(
            output_of(fmt::format("'{}' -endian={} '{}'", ORRERY_PAMTOPFM, order, (folder / "x.ppm").string())));
        ASSERT_EQ(read.pixels.size(), image.pixels.size());
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            EXPECT_FLOAT_EQ(read.pixels[i].r, image.pixels[i].r);
            EXPECT_FLOAT_EQ(read.pixels[i].g, image.pixels[i].g);
            EXPECT_FLOAT_EQ(read.pixels[i].b, image.pixels[i].b);
        }
    }
}

/// A netpbm file as PNG by their program, read by ours.
Image through_png(const std::string& netpbm, const std::string& options) {
    const TemporaryFolder folder;
    test::store(folder / "in", test::to_bytes(netpbm));
    return decode_png(
        output_of(fmt::format("'{}' -quiet {} '{}'", ORRERY_PNMTOPNG, options, (folder / "in").string())));
}

TEST(Netpbm, WritesEveryKindOfPngWeRead) {
    const std::vector<Rgb> bilevel{{0, 0, 0}, {1, 1, 1}};
    EXPECT_EQ(through_png("P1\n2 1\n1 0\n", "").pixels, bilevel);
    const float third = 85 / 255.0f;
    EXPECT_EQ(through_png("P2\n3 1\n3\n0 1 3\n", "").pixels, (std::vector<Rgb>{{}, {third, third, third}, {1, 1, 1}}));
    const float grey = 77 / 255.0f;
    EXPECT_EQ(through_png("P2\n2 1\n255\n77 255\n", "").pixels, (std::vector<Rgb>{{grey, grey, grey}, {1, 1, 1}}));
    const float deep = 4660 / 65535.0f;
    EXPECT_EQ(through_png("P2\n2 1\n65535\n4660 65535\n", "").pixels,
              (std::vector<Rgb>{{deep, deep, deep}, {1, 1, 1}}));
    EXPECT_EQ(through_png("P3\n2 1\n65535\n4660 0 1  65535 7 8\n", "").pixels,
              (std::vector<Rgb>{{deep, 0, 1 / 65535.0f}, {1, 7 / 65535.0f, 8 / 65535.0f}}));
    const std::vector<Rgb> colours{{1, 0, 0}, {0, 0.2f, 1}};  // few enough for a palette
    EXPECT_EQ(through_png("P3\n2 1\n255\n255 0 0  0 51 255\n", "").pixels, colours);
    EXPECT_EQ(through_png("P3\n2 1\n255\n255 0 0  0 51 255\n", "-transparent=red").pixels, colours);
    EXPECT_EQ(through_png("P3\n2 1\n255\n255 0 0  0 51 255\n", "-gamma=0.45 -interlace").pixels, colours);
}

TEST(Netpbm, WritesAlphaWeIgnore) {
    const TemporaryFolder folder;
    const Image image = test::eight_bit_gradient(23, 19);
    test::store(folder / "alpha",
                test::to_bytes("P5\n23 19\n255\n" + std::string(12 * 19, '\x40') + std::string(11 * 19, '\0')));
    const Image read = through_png(test::to_text(encode_ppm(image, {})),
                                   fmt::format("-interlace -alpha='{}'", (folder / "alpha").string()));
    EXPECT_EQ(read.pixels, image.pixels);
}

}  // namespace
}  // namespace orrery
