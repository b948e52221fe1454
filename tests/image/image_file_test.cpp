#include "image/image_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "image/codec.hpp"
#include "sample_images.hpp"
#include "support/temporary_folder.hpp"

namespace orrery {
namespace {

using test::TemporaryFolder;

constexpr const char* all_names[] = {"x.ppm", "x.png", "x.pfm", "x.exr"};

TEST(ImageFormat, GoesByTheEndingInAnyCase) {
    EXPECT_EQ(image_format("a.ppm"), ImageFormat::ppm);
    EXPECT_EQ(image_format("b/c.d/a.PNG"), ImageFormat::png);
    EXPECT_EQ(image_format("../a.b.Pfm"), ImageFormat::pfm);
    EXPECT_EQ(image_format("a.eXr"), ImageFormat::exr);
}

TEST(ImageFormat, NamesTheKnownEndings) {
    for (const char* file : {"a.jpg", "a", ".png", "a.", "png", "a.png.bak", "a.ppm/"}) {
        try {
            image_format(file);
            ADD_FAILURE() << file;
        } catch (const std::invalid_argument& fault) {
            EXPECT_NE(std::string(fault.what()).find(".ppm, .png, .pfm and .exr"), std::string::npos) << file;
            EXPECT_EQ(std::string(fault.what()).rfind(file, 0), 0u);
        }
    }
}

TEST(WriteImage, ComesBackInEveryFormatAndSize) {
    const TemporaryFolder folder;
    for (const auto& [width, height] : test::sizes())
        for (const char* name : all_names) {
            const bool bytes = image_format(name) == ImageFormat::ppm || image_format(name) == ImageFormat::png;
            const Image image = bytes ? test::eight_bit_gradient(width, height) : test::gradient(width, height);
            write_image(folder / name, image, ToneMap::none, {{"scene", "a.json"}});
            const Image read = read_image(folder / name);
            EXPECT_EQ(read.width, width);
            EXPECT_EQ(read.height, height);
            EXPECT_TRUE(read.pixels == image.pixels) << name << " " << width << "x" << height;
        }
}

TEST(WriteImage, MapsTonesForEightBitsOnly) {
    const TemporaryFolder folder;
    const Image image{1, 1, {{1, 3, 0.25f}}};
    for (const char* name : all_names) write_image(folder / name, image, ToneMap::sigmoid, {});
    const Rgb mapped{128 / 255.0f, 191 / 255.0f, 0.2f};
    EXPECT_EQ(read_image(folder / "x.ppm").pixels[0], mapped);
    EXPECT_EQ(read_image(folder / "x.png").pixels[0], mapped);
    EXPECT_EQ(read_image(folder / "x.pfm").pixels[0], image.pixels[0]);
    EXPECT_EQ(read_image(folder / "x.exr").pixels[0], image.pixels[0]);
}

TEST(WriteImage, GivesTheSameBytesForTheSameImage) {
    const TemporaryFolder folder;
    const Image image = test::gradient(61, 47);
    const Metadata metadata{{"scene", "a.json"}, {"seed", "1"}};
    for (const char* name : all_names) {
        write_image(folder / name, image, ToneMap::sigmoid, metadata);
        const std::string first = test::load(folder / name);
        write_image(folder / name, image, ToneMap::sigmoid, metadata);
        EXPECT_TRUE(test::load(folder / name) == first) << name;
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"x.exr", "x.pfm", "x.png", "x.ppm"}));
}

TEST(WriteImage, RefusesAnImageThatIsNone) {
    const TemporaryFolder folder;
    for (const char* name : all_names) {
        EXPECT_THROW(write_image(folder / name, {}, ToneMap::none, {}), std::runtime_error);
        EXPECT_THROW(write_image(folder / name, {2, 2, std::vector<Rgb>(3)}, ToneMap::none, {}), std::runtime_error);
    }
    EXPECT_THROW(write_image(folder / "x.jpg", test::gradient(1, 1), ToneMap::none, {}), std::invalid_argument);
    EXPECT_TRUE(folder.names().empty());
}

std::string fault_of(const std::filesystem::path& file) {
    try {
        read_image(file);
        return "none";
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
}

TEST(ReadImage, GoesByTheContentNotTheName) {
    const TemporaryFolder folder;
    write_image(folder / "x.png", test::eight_bit_gradient(3, 2), ToneMap::none, {});
    std::filesystem::rename(folder / "x.png", folder / "x.anything");
    EXPECT_EQ(read_image(folder / "x.anything").pixels, test::eight_bit_gradient(3, 2).pixels);
}

TEST(ReadImage, NamesTheFileAndTheFault) {
    const TemporaryFolder folder;
    const std::string absent = (folder / "absent.ppm").string();
    EXPECT_EQ(fault_of(absent), absent + ": cannot open: No such file or directory");
    EXPECT_EQ(fault_of(folder.path()), folder.path().string() + ": not a regular file");
    const std::string garbage = (folder / "garbage.png").string();
    for (const char* content : {"", "P", "hello, world", "P3\n1 1\n255\n0 0 0\n"}) {
        test::store(garbage, test::to_bytes(content));
        EXPECT_EQ(fault_of(garbage), garbage + ": not a PPM (P6), PNG, PFM or EXR file");
    }
    test::store(garbage, test::to_bytes("P6\n2 2\n255\nabc"));
    EXPECT_EQ(fault_of(garbage), garbage + ": truncated: 4 pixels of 3 bytes are announced, 3 bytes are there");
}

TEST(ReadImage, DoesNotWaitForAPipe) {
    const TemporaryFolder folder;
    const std::string pipe = (folder / "pipe").string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(fault_of(pipe), pipe + ": not a regular file");
}

}  // namespace
}  // namespace orrery
