#include "image/codec.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>

#include <algorithm>
#include <limits>

#include "image/image_file.hpp"
#include "openexr_core_reader.hpp"
#include "sample_images.hpp"
#include "support/temporary_folder.hpp"

namespace orrery {
namespace {

using test::TemporaryFolder;

TEST(Exr, IsReadByAnotherImplementation) {
    const TemporaryFolder folder;
    for (const auto& [width, height] : test::sizes()) {
        const Image image = test::gradient(width, height);
        test::store(folder / "x.exr", encode_exr(image, {}));
        const test::CoreExr read = test::read_with_core(folder / "x.exr");
        EXPECT_EQ(read.image.width, width);
        EXPECT_EQ(read.image.height, height);
        EXPECT_TRUE(read.image.pixels == image.pixels) << width << "x" << height;
        EXPECT_TRUE(read.all_float);
        EXPECT_EQ(read.channels, (std::vector<std::string>{"B", "G", "R"}));
    }
}

TEST(Exr, SaysWhatMadeItInAttributes) {
    const TemporaryFolder folder;
    const std::string long_key(300, 'k');
    test::store(folder / "x.exr", encode_exr(test::gradient(2, 2), {{"scene", "\xc3\xa9.json"},
                                                                    {"channels", "no clash"},
                                                                    {"light sampling", "cone"},
                                                                    {"empty", ""},
                                                                    {"seed", "0"},
                                                                    {"seed", "1"},
                                                                    {long_key, "long"}}));
    const auto attribute = [&](const std::string& name) { return test::core_string_attribute(folder / "x.exr", name); };
    EXPECT_EQ(attribute("orrery:scene"), "\xc3\xa9.json");
    EXPECT_EQ(attribute("orrery:channels"), "no clash");
    EXPECT_EQ(attribute("orrery:light sampling"), "cone");
    EXPECT_EQ(attribute("orrery:empty"), "");
    EXPECT_EQ(attribute("orrery:seed"), "1");
    EXPECT_EQ(attribute("orrery:" + long_key.substr(0, 79)), "long");
}

TEST(Exr, HoldsNothingBesideTheFormatsOwnAndTheMetadata) {
    const TemporaryFolder folder;
    test::store(folder / "x.exr", encode_exr(test::gradient(2, 2), {{"seed", "0"}}));
    std::vector<std::string> names;
    for (const auto& [name, type] : test::read_with_core(folder / "x.exr").attributes) names.push_back(name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names,
              (std::vector<std::string>{"channels", "compression", "dataWindow", "displayWindow", "lineOrder",
                                        "orrery:seed", "pixelAspectRatio", "screenWindowCenter", "screenWindowWidth"}));
}

TEST(Exr, IsTheSameForAnyNumberOfThreads) {
    const Image image = test::gradient(61, 200);
    const Bytes alone = encode_exr(image, {});
    Imf::setGlobalThreadCount(4);
    const Bytes together = encode_exr(image, {});
    Imf::setGlobalThreadCount(0);
    EXPECT_TRUE(alone == together);
}

TEST(Exr, GivesEveryFiniteAndInfiniteFloatBack) {
    using limits = std::numeric_limits<float>;
    const Image image{2, 1, {{limits::max(), limits::denorm_min(), 0}, {limits::infinity(), 0.1f, 1e-30f}}};
    EXPECT_EQ(decode_exr(encode_exr(image, {})).pixels, image.pixels);
}

/// A file as another program might write it: halves, an offset data window, one more channel.
void write_half(const std::filesystem::path& file, Imf::Compression compression) {
    const Imath::Box2i window({-3, 5}, {-1, 6});
    Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), window);
    header.compression() = compression;
    std::vector<half> values;
    for (int i = 0; i < 24; ++i) values.emplace_back(static_cast<float>(i) * 0.25f);
    Imf::FrameBuffer buffer;
    std::size_t offset = 0;
    for (const char* name : {"R", "G", "B", "A"}) {
        header.channels().insert(name, Imf::Channel(Imf::HALF));
        buffer.insert(name,
                      Imf::Slice::Make(Imf::HALF, &values[offset++], window, 4 * sizeof(half), 12 * sizeof(half)));
    }
    Imf::OutputFile output(file.c_str(), header, 0);
    output.setFrameBuffer(buffer);
    output.writePixels(2);
}

TEST(Exr, ReadsHalvesAnOffsetWindowAndOtherCompressions) {
    const TemporaryFolder folder;
    for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                               Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION}) {
        write_half(folder / "half.exr", compression);
        const Image image = read_image(folder / "half.exr");
        EXPECT_EQ(image.width, 3u);
        EXPECT_EQ(image.height, 2u);
        EXPECT_EQ(image.at(0, 0), (Rgb{0, 0.25f, 0.5f}));
        EXPECT_EQ(image.at(2, 1), (Rgb{5, 5.25f, 5.5f}));
    }
}

/// One row of one pixel with the channels named.
void write_channels(const std::filesystem::path& file, const std::vector<std::string>& names, int sampling) {
    Imf::Header header(2, 2);
    Imf::FrameBuffer buffer;
    std::vector<float> values(4);
    for (const std::string& name : names) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT, sampling, sampling));
        buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 8, sampling, sampling));
    }
    Imf::OutputFile output(file.c_str(), header, 0);
    output.setFrameBuffer(buffer);
    output.writePixels(2);
}

std::string fault_of(const std::filesystem::path& file) {
    try {
        read_image(file);
        return "none";
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
}

TEST(Exr, RefusesOtherChannels) {
    const TemporaryFolder folder;
    write_channels(folder / "grey.exr", {"Y"}, 1);
    EXPECT_EQ(fault_of(folder / "grey.exr"), (folder / "grey.exr").string() + ": has no channel R");
    write_channels(folder / "sub.exr", {"R", "G", "B"}, 2);
    EXPECT_EQ(fault_of(folder / "sub.exr"), (folder / "sub.exr").string() + ": channel B is subsampled");
}

TEST(Exr, RefusesTiles) {
    const TemporaryFolder folder;
    {
        Imf::Header header(2, 2);
        for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        header.setTileDescription(Imf::TileDescription(2, 2, Imf::ONE_LEVEL));
        const Imf::TiledOutputFile output((folder / "tiled.exr").c_str(), header, 0);
    }
    EXPECT_EQ(fault_of(folder / "tiled.exr"),
              (folder / "tiled.exr").string() + ": only single-part scan-line EXR files are read");
}

}  // namespace
}  // namespace orrery
