// orrery info: the plan in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/isa.hpp"
#include "program.hpp"

namespace orrery::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

TEST(Info, PrintsSettingsMemoryAndPlan) {
    const Outcome outcome = orrery({"info", scene_file("tests/diffuse_area.json"), "--spp", "10", "--size", "640x480",
                                    "--estimator", "stratified"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_THAT(outcome.output,
                AllOf(ContainsRegex("size +640x480\n"), HasSubstr("9 per pixel, stratified 3 x 3 (10 asked)"),
                      ContainsRegex("film +41.0 MiB"), ContainsRegex("queues +[0-9]+ bytes"),
                      HasSubstr(std::string(isa_name(best_isa()))), HasSubstr("tests/diffuse_area.pfm")));
    EXPECT_THAT(outcome.output, ContainsRegex("left out +generate: lens +the camera is a pinhole"));
    EXPECT_THAT(outcome.output, ContainsRegex("runs +shadow: area lights"));
}

TEST(Info, FollowsTheOptions) {
    const auto info = [](std::vector<std::string> options) {
        options.insert(options.begin(), {"info", scene_file("tests/diffuse_area.json")});
        return orrery(options).output;
    };
    EXPECT_THAT(info({"--transport", "naive"}), ContainsRegex("left out +shadow: area lights"));
    EXPECT_THAT(info({"--integrator", "depth"}), HasSubstr("DEPTH stops after intersect"));
    EXPECT_THAT(info({"--isa", "scalar"}), ContainsRegex("isa +scalar"));
    EXPECT_THAT(info({"--wave-size", "1024"}), HasSubstr("per thread for waves of 1024"));
    EXPECT_THAT(info({"--estimator", "uniform", "--spp", "10"}), HasSubstr("10 per pixel, uniform"));
    EXPECT_THAT(info({"--tonemap", "linear", "--seed", "5"}),
                AllOf(ContainsRegex("tonemap +linear\n"), ContainsRegex("seed +5\n")));
}

// Float, the faster, is good enough for what people make.
TEST(Info, OrdinaryScenesAreComputedInFloat) {
    for (const char* scene : {"assignment_01", "assignment_02", "assignment_03", "assignment_04", "assignment_05",
                              "assignment_06", "assignment_07", "assignment_08", "sample", "showcase", "bench/like_46",
                              "bench/like_484", "bench/many_lights", "bench/lamp_behind_glass", "bench/point_light"})
        EXPECT_THAT(orrery({"info", scene_file(std::string(scene) + ".json")}).output,
                    ContainsRegex("precision +float\n"))
            << scene;
    const TemporaryFolder folder;
    for (const char* kind : {"random", "lattice", "cluster", "cosmos"}) {
        orrery({"generate", kind, "--spheres", "2000", "-o", "world.json"}, {.folder = folder.path()});
        EXPECT_THAT(orrery({"info", "world.json"}, {.folder = folder.path()}).output,
                    ContainsRegex("precision +float\n"))
            << kind;
    }
}

TEST(Info, SaysWhyAnotherTakesDouble) {
    EXPECT_THAT(
        orrery({"info", scene_file("large_ground.json")}).output,
        AllOf(ContainsRegex("precision +double\n"), ContainsRegex("runs +double precision +sphere \"ground\"")));
}

// The course's fourth scene lists its floor twice.
TEST(Info, WarnsOfASurfaceListedTwice) {
    const Outcome outcome = orrery({"info", scene_file("assignment_04.json")});
    EXPECT_THAT(outcome.error, HasSubstr("assignment_04.json:/scene/primitives/1: warning: found the same sphere as "
                                         "/scene/primitives/0, expected each once; the first listed wins"));
    EXPECT_EQ(orrery({"info", scene_file("assignment_04.json"), "--quiet"}).error, "");
}

TEST(Info, RendersNothing) {
    const TemporaryFolder folder;
    std::filesystem::copy_file(scene_file("tests/lens.json"), folder / "lens.json");
    // For ever, were it rendered.
    const Outcome outcome = orrery({"info", "lens.json", "--spp", "4294967295"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"lens.json"});
}

}  // namespace
}  // namespace orrery::test
