// Truncated and mutated files: an image or a fault, never a crash, and never memory the file's size does not justify.
#include <gtest/gtest.h>
#include <openexr.h>

#include <new>

#include "image/codec.hpp"
#include "mutation.hpp"
#include "sample_images.hpp"
#include "support/heap_watch.hpp"
#include "support/temporary_folder.hpp"

namespace orrery {
namespace {

/// OpenEXRCore takes memory from malloc, which nobody watches, unless told where else.
const bool exr_is_watched = [] {
    exr_set_default_memory_routines(
        [](std::size_t size) -> void* {
            try {
                return ::operator new(size);
            } catch (const std::bad_alloc&) {
                return nullptr;
            }
        },
        [](void* memory) { ::operator delete(memory); });
    return true;
}();

/// Files of a few hundred bytes: 1032 times that, and the chunk EXR always gets, stay below this.
constexpr std::size_t justified_bytes = std::size_t{72} << 20;

class DamagedFile : public ::testing::TestWithParam<ImageFormat> {
protected:
    Bytes intact() const {
        return encode_image(GetParam(), test::gradient(5, 3), ToneMap::sigmoid, {{"scene", "a.json"}, {"seed", "0"}});
    }

    /// True where the file was read. A fault is fine, being out of memory is not.
    static bool reads(ByteView file) {
        test::restart_heap_watch();
        bool good = false;
        try {
            const Image image = decode_image(file);
            EXPECT_EQ(image.pixels.size(), std::size_t{image.width} * image.height);
            good = true;
        } catch (const std::bad_alloc&) {
            ADD_FAILURE() << "out of memory";
        } catch (const std::exception& fault) {
            EXPECT_STRNE(fault.what(), "");
        }
        EXPECT_LE(test::heap_use().largest, justified_bytes);
        return good;
    }
};

TEST_P(DamagedFile, IsRefusedWhereItIsCut) {
    const Bytes file = intact();
    for (std::size_t length = 0; length < file.size(); ++length)
        EXPECT_FALSE(reads(ByteView(file).first(length))) << length << " of " << file.size() << " bytes";
    EXPECT_TRUE(reads(file));
}

TEST_P(DamagedFile, DoesNoHarmWhereItIsMutated) {
    const Bytes file = intact();
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE(seed);
        reads(test::mutated(file, seed));
    }
}

TEST_P(DamagedFile, DoesNoHarmBehindTheMagic) {
    const Bytes file = intact();
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE(seed);
        Bytes garbage = test::mutated(Bytes(200, std::byte(seed)), seed);
        garbage.insert(garbage.begin(), file.begin(), file.begin() + 8);
        reads(garbage);
    }
}

// A million black pixels pack into a few thousand bytes, and take 12 MB.
TEST_P(DamagedFile, IsRefusedWhereItsPixelsDoNotFitInMemory) {
    const Image black{1000, 1000, std::vector<Rgb>(1'000'000)};
    const Bytes file = encode_image(GetParam(), black, ToneMap::none, {});
    test::restart_heap_watch();
    try {
        decode_image(file, 11'000'000);
        ADD_FAILURE() << "it was read";
    } catch (const std::runtime_error& fault) {
        EXPECT_NE(std::string(fault.what()).find("of memory are left"), std::string::npos) << fault.what();
    }
    EXPECT_LE(test::heap_use().largest, 1'000'000u) << "known before any is taken";
    EXPECT_EQ(decode_image(file, 17'000'000).pixels, black.pixels);
}

std::string name_of(const ::testing::TestParamInfo<ImageFormat>& info) {
    switch (info.param) {
        case ImageFormat::ppm:
            return "Ppm";
        case ImageFormat::png:
            return "Png";
        case ImageFormat::pfm:
            return "Pfm";
        case ImageFormat::exr:
            return "Exr";
    }
    return "Unknown";
}

INSTANTIATE_TEST_SUITE_P(EveryFormat, DamagedFile,
                         ::testing::Values(ImageFormat::ppm, ImageFormat::png, ImageFormat::pfm, ImageFormat::exr),
                         name_of);

// libpng stops at the first wrong checksum; damage with the checksums put right goes further.
TEST(DamagedPng, DoesNoHarmBehindTheChecksums) {
    const Bytes file = encode_image(ImageFormat::png, test::gradient(5, 3), ToneMap::sigmoid, {{"seed", "0"}});
    std::size_t read = 0;
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE(seed);
        Bytes damaged = test::mutated(file, seed);
        test::repair_png_checksums(damaged);
        test::restart_heap_watch();
        try {
            decode_image(damaged);
            ++read;
        } catch (const std::runtime_error&) {
        }
        EXPECT_LE(test::heap_use().largest, justified_bytes);
    }
    EXPECT_GT(read, 0u);
}

TEST(AbsurdSize, IsRefusedWithoutAllocatingIt) {
    for (const char* header : {"P6\n65536 65536\n255\n", "P6\n4294967295 4294967295\n65535\n",
                               "PF\n65536 65536\n-1.0\n", "Pf\n4294967295 1\n1.0\n"}) {
        test::restart_heap_watch();
        const Bytes file = test::to_bytes(header + std::string(100, 'x'));
        EXPECT_THROW(decode_image(file), std::runtime_error) << header;
        EXPECT_LE(test::heap_use().largest, 1000u);
    }
}

}  // namespace
}  // namespace orrery
