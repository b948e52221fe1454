// What many spheres take: heap and allocations, which do not depend on how busy the machine is.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "generated.hpp"
#include "scene/read.hpp"
#include "support/heap_watch.hpp"
#include "support/temporary_folder.hpp"

namespace orrery::worlds {
namespace {

using test::heap_use;
using test::HeapUse;

TEST(LargeScene, IsWrittenInConstantMemory) {
    const auto use = [](std::uint64_t spheres) {
        const World world = random_ball(spheres, 0);
        test::restart_heap_watch();
        std::size_t largest = 0;
        write_world(world, spheres, "x", [&](std::string_view part) { largest = std::max(largest, part.size()); });
        EXPECT_LT(largest, std::size_t{1} << 17);
        return heap_use().peak;
    };
    EXPECT_EQ(use(20'000), use(100'000));
    EXPECT_LT(use(100'000), std::size_t{1} << 18);
}

HeapUse use_of_reading(std::uint64_t spheres) {
    const test::TemporaryFolder folder;
    {
        std::ofstream file(folder / "x.json");
        write_world(random_ball(spheres, 0), spheres, "x", [&](std::string_view part) { file << part; });
    }
    test::restart_heap_watch();
    const ReadResult result = read_scene(folder / "x.json");
    const HeapUse use = heap_use();
    EXPECT_TRUE(result.scene.has_value());
    return use;
}

TEST(LargeScene, IsReadInMemoryInProportion) {
    // 1280 bytes a sphere, nearly all of it JSON values of nlohmann-json.
    const HeapUse small = use_of_reading(20'000), large = use_of_reading(100'000);
    EXPECT_LT(large.peak, 100'000u * 1500);
    EXPECT_LT(static_cast<double>(large.peak), 6.5 * static_cast<double>(small.peak));
}

TEST(LargeScene, IsReadWithAllocationsInProportion) {
    // 22 a sphere: its objects, lists and long words in the JSON library, and what the readers of its fields keep.
    const HeapUse small = use_of_reading(20'000), large = use_of_reading(100'000);
    EXPECT_LT(large.allocations, 100'000u * 24);
    EXPECT_LT(static_cast<double>(large.allocations), 5.2 * static_cast<double>(small.allocations));
}

}  // namespace
}  // namespace orrery::worlds
