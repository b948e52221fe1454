// How large an image may be.
#include <gtest/gtest.h>

#include "scene/image_memory.hpp"
#include "scene/world.hpp"
#include "system/memory.hpp"

namespace orrery::test {
namespace {

TEST(ImageMemory, CountsPixelsAgainstMemory) {
    EXPECT_FALSE(too_many_pixels(100, 10, 140'000).has_value());
    EXPECT_TRUE(too_many_pixels(1001, 1, 140'000).has_value());
    // The largest product must not wrap around.
    EXPECT_TRUE(too_many_pixels(0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF'FFFFFFFF).has_value());
}

TEST(ImageMemory, RefusalNamesTheFigures) {
    EXPECT_EQ(too_many_pixels(65536, 65536, 16'000'000'000),
              "found 65536 x 65536, 4294967296 pixels that take 601.3 GB, expected an image that fits the 16.0 GB of "
              "memory");
}

TEST(ImageMemory, LargestDimensionsAreJudgedByThisMachine) {
    Json json = world();
    json["scene"]["renderer"]["dimensions"] = {65536, 65536};
    const ReadResult result = read(json);
    if (!too_many_pixels(65536, 65536, memory_limit())) {
        EXPECT_TRUE(result.scene.has_value()) << listing(result);
        return;
    }
    ASSERT_EQ(result.diagnostics.size(), 1u) << listing(result);
    EXPECT_EQ(result.diagnostics[0].where, "/scene/renderer/dimensions");
    EXPECT_NE(result.diagnostics[0].message.find("4294967296 pixels"), std::string::npos) << listing(result);
}

TEST(ImageMemory, WholeNumbersMayBeWrittenAsFloats) {
    Json json = world();
    json["scene"]["renderer"]["dimensions"] = {64.0, 48.0};
    const ReadResult result = read(json);
    ASSERT_TRUE(result.scene.has_value()) << listing(result);
    EXPECT_EQ(result.scene->settings.width, 64u);
}

}  // namespace
}  // namespace orrery::test
