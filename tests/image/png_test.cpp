#include "image/codec.hpp"

#include <gtest/gtest.h>

#include "mutation.hpp"
#include "sample_images.hpp"
#include "support/temporary_folder.hpp"

namespace orrery {
namespace {

using test::to_text;

std::string header_chunk(const std::string& png) { return png.substr(8, 25); }

TEST(Png, IsEightBitRgbNotInterlaced) {
    using namespace std::string_literals;
    const std::string file = to_text(encode_png(test::gradient(3, 258), {}));
    EXPECT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(header_chunk(file).substr(0, 21), "\0\0\0\x0dIHDR\0\0\0\x03\0\0\x01\x02\x08\x02\0\0\0"s);
    for (const char* absent : {"tIME", "gAMA", "sRGB", "tEXt"}) EXPECT_EQ(file.find(absent), file.npos);
}

TEST(Png, SaysWhatMadeItInTextChunks) {
    using namespace std::string_literals;
    const std::string file = to_text(encode_png(test::gradient(1, 1), {{"scene", "a.json"}, {"seed", "7\n"}}));
    EXPECT_NE(file.find("\0\0\0\x0ctEXtscene\0a.json"s), file.npos);
    EXPECT_NE(file.find("\0\0\0\x07tEXtseed\0"
                        "7 "s),
              file.npos);
    EXPECT_LT(file.find("tEXt"), file.find("IDAT"));
}

TEST(Png, KeepsUtf8AsInternationalText) {
    const std::string file = to_text(encode_png(test::gradient(1, 1), {{"scene", "\xc3\xa9"}}));
    EXPECT_NE(file.find("iTXtscene"), file.npos);
    EXPECT_NE(file.find("\xc3\xa9"), file.npos);
    EXPECT_EQ(file.find("tEXt"), file.npos);
}

TEST(Png, SaysWhereItsValuesAreSrgb) {
    const std::string chunk = std::string("\0\0\0\x01sRGB", 8);
    const auto file = [](ToneMap mapper) {
        return to_text(encode_image(ImageFormat::png, test::gradient(2, 2), mapper, {}));
    };
    EXPECT_NE(file(ToneMap::srgb).find(chunk), std::string::npos);
    for (const ToneMap other : {ToneMap::sigmoid, ToneMap::linear, ToneMap::none})
        EXPECT_EQ(file(other).find("sRGB"), std::string::npos);
    EXPECT_EQ(file(ToneMap::srgb).find("gAMA"), std::string::npos);
}

TEST(Png, TakesAnyMetadata) {
    const Metadata awkward{
        {"", ""}, {" ", " "}, {"a  b", "two spaces"}, {std::string(500, 'k'), std::string(100000, 'v')}};
    const Image image = test::eight_bit_gradient(3, 2);
    EXPECT_EQ(decode_png(encode_png(image, awkward)).pixels, image.pixels);
}

TEST(Png, RefusesAHeaderThatPromisesMoreThanTheFileCanHold) {
    Bytes file = encode_png(test::gradient(2, 2), {});
    file[16] = std::byte{0x7f};  // the width, and with the checksum right
    test::repair_png_checksums(file);
    EXPECT_THROW(decode_png(file), std::runtime_error);
}

TEST(Png, RefusesADamagedChecksum) {
    Bytes file = encode_png(test::gradient(2, 2), {});
    file[29] ^= std::byte{1};
    EXPECT_THROW(decode_png(file), std::runtime_error);
}

}  // namespace
}  // namespace orrery
