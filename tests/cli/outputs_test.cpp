// Where images go, and what happens where they cannot.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "image/image_file.hpp"
#include "program.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Arguments = std::vector<std::string>;

class Outputs : public ::testing::Test {
protected:
    Outputs() { fs::create_directory(folder / "scenes"); }

    /// A scene in scenes/ that names this output, or none.
    std::string scene(const std::string& output) const {
        auto world = small_world();
        if (!output.empty()) world["scene"]["renderer"]["output"] = output;
        store(folder / "scenes/world.json", to_bytes(world.dump()));
        return "scenes/world.json";
    }
    Outcome run(const Arguments& arguments, Surroundings surroundings = {}) const {
        surroundings.folder = folder.path();
        return orrery(arguments, surroundings);
    }

    TemporaryFolder folder;
};

TEST_F(Outputs, TheScenesOwnIsBesideTheSceneAndItsFolderIsMade) {
    const Outcome outcome = run({"render", scene("../output/world.png")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(outcome.output, "output/world.png\n");
    EXPECT_TRUE(fs::exists(folder / "output/world.png"));
}

TEST_F(Outputs, OnlyTheLastFolderIsMade) {
    const Outcome outcome = run({"render", scene("../a/b/world.png")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(folder.names(), ElementsAre("scenes"));
}

TEST_F(Outputs, AFolderOfTheCommandLineIsNotMade) {
    const Outcome outcome = run({"render", scene(""), "-o", "missing/world.png"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr("missing"));
    EXPECT_THAT(folder.names(), ElementsAre("scenes"));
}

TEST_F(Outputs, TheCommandLineReplacesTheScenesOwn) {
    const Outcome outcome = run({"render", scene("../output/world.gif"), "-o", "a.ppm", "--output", "b.pfm"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(outcome.output, "a.ppm\nb.pfm\n");
    EXPECT_THAT(folder.names(), ElementsAre("a.ppm", "b.pfm", "scenes"));
}

TEST_F(Outputs, ASceneWithoutOneNeedsAnOption) {
    const Outcome outcome = run({"render", scene("")});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.error, HasSubstr("--output"));
}

TEST_F(Outputs, AnUnknownEndingInTheSceneIsNamedWithItsPlace) {
    const Outcome outcome = run({"render", scene("../output/world.gif")});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.error, HasSubstr("scenes/world.json:/scene/renderer/output"));
    EXPECT_THAT(folder.names(), ElementsAre("scenes"));
}

TEST_F(Outputs, OneThatCannotBeWrittenIsKnownBeforeRendering) {
    fs::create_directory(folder / "folder.ppm");
    store(folder / "file", to_bytes("not a folder"));
    for (const char* output : {"folder.ppm", "file/x.ppm", "/proc/orrery/x.ppm", "nowhere/x.ppm"}) {
        // For ever, were it rendered first.
        const Outcome outcome = run({"render", scene(""), "-o", "good.ppm", "-o", output, "--spp", "4294967295"});
        EXPECT_EQ(outcome.exit_code, 1) << output;
        EXPECT_THAT(outcome.error, HasSubstr(output));
        EXPECT_EQ(outcome.output, "");
    }
    for (const char* stats : {"nowhere/s.json", "folder.ppm", "/dev/full"})
        EXPECT_EQ(run({"render", scene(""), "-o", "good.ppm", "--stats", stats, "--spp", "4294967295"}).exit_code, 1);
    EXPECT_THAT(folder.names(), ElementsAre("file", "folder.ppm", "scenes"));
}

TEST_F(Outputs, ANameThatCannotBeIsKnownBeforeRendering) {
    fs::create_symlink("/dev/stdout", folder / "stdout.ppm");
    fs::create_symlink("loop.ppm", folder / "loop.ppm");
    const std::string names[] = {std::string(252, 'x') + ".ppm", "stdout.ppm", "loop.ppm",
                                 std::string(5000, '/') + "x.ppm"};
    for (const std::string& name : names)
        for (const Arguments& arguments : {Arguments{"render", scene(""), "-o", "good.ppm", "-o", name},
                                           Arguments{"render", scene(""), "-o", "good.ppm", "--stats", name}}) {
            Arguments for_ever = arguments;
            for_ever.insert(for_ever.end(), {"--spp", "4294967295"});
            const Outcome outcome = run(for_ever);
            // Where standard output is a file, that is what is said about the link to it.
            EXPECT_EQ(outcome.exit_code, name == "stdout.ppm" ? 2 : 1) << name;
            EXPECT_THAT(outcome.error, HasSubstr(name.substr(name.size() - 8)));
        }
    EXPECT_THAT(folder.names(), ElementsAre("loop.ppm", "scenes", "stdout.ppm"));
}

TEST_F(Outputs, WhatCannotBeAsLargeIsKnownBeforeRendering) {
    const Arguments arguments = {"render", scene(""), "-o", "x.pfm", "--size", "64x64", "--spp", "4294967295"};
    const Outcome outcome = run(arguments, {.largest_file = 20000});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr("x.pfm: takes 49152 bytes, and files may have 20000"));
    EXPECT_THAT(folder.names(), ElementsAre("scenes"));
}

// It would be a new file of that name, and what is printed later would go to the old one.
TEST_F(Outputs, AreNotWhereStandardOutputGoes) {
    store(folder / "x.ppm", to_bytes("old"));
    const Outcome outcome = run({"render", scene(""), "-o", "x.ppm", "--quiet"}, {.output = folder / "x.ppm"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.error, HasSubstr("standard output"));
    EXPECT_EQ(load(folder / "x.ppm"), "old");
}

/// Gives the scene through a pipe, and where it goes.
void feed(const fs::path& pipe, const std::string& text) {
    const int end = ::open(pipe.c_str(), O_WRONLY | O_CLOEXEC);
    EXPECT_EQ(::write(end, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(end);
}

TEST_F(Outputs, OfAPipedSceneAreInTheWorkingDirectory) {
    auto world = small_world();
    world["scene"]["renderer"]["output"] = "piped.png";
    const std::string text = world.dump();
    ASSERT_EQ(::mkfifo((folder / "scenes/fifo").c_str(), 0600), 0);
    {
        std::jthread feeder([&] { feed(folder / "scenes/fifo", text); });
        EXPECT_EQ(run({"render", "scenes/fifo"}).output, "piped.png\n");
    }
    EXPECT_TRUE(fs::remove(folder / "piped.png"));

    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(ends[1]);
    // As a shell names <(...).
    EXPECT_EQ(run({"render", "/dev/fd/" + std::to_string(ends[0])}).output, "piped.png\n");
    ::close(ends[0]);
    EXPECT_TRUE(fs::remove(folder / "piped.png"));

    // A file, but one that is open: `< scenes/world.json` and /dev/stdin.
    store(folder / "scenes/world.json", to_bytes(text));
    const int open = ::open((folder / "scenes/world.json").c_str(), O_RDONLY);
    EXPECT_EQ(run({"render", "/dev/fd/" + std::to_string(open)}).output, "piped.png\n");
    ::close(open);
    EXPECT_TRUE(fs::remove(folder / "piped.png"));

    EXPECT_EQ(run({"render", "scenes/world.json"}).output, "scenes/piped.png\n");
}

TEST_F(Outputs, AFullDiskLeavesThePreviousImage) {
    for (const char* name : {"x.ppm", "x.png", "x.pfm", "x.exr"}) {
        store(folder / name, to_bytes("previous"));
        const Outcome outcome =
            run({"render", scene(""), "-o", name, "--size", "64x64", "--spp", "1"}, {.largest_file = 300});
        EXPECT_EQ(outcome.exit_code, 1) << name;
        EXPECT_THAT(outcome.error, HasSubstr(name));
        EXPECT_EQ(load(folder / name), "previous");
    }
    EXPECT_THAT(folder.names(), ElementsAre("scenes", "x.exr", "x.pfm", "x.png", "x.ppm"));
}

TEST_F(Outputs, TheOthersAreWrittenWhereOneFails) {
    // 64 x 64 pixels are 12 KiB as PPM, and noise is three times as much as EXR, which nobody can tell before.
    const Outcome outcome =
        run({"render", scene_file("assignment_08.json"), "-o", "x.exr", "-o", "x.ppm", "--size", "64x64", "--spp", "1"},
            {.largest_file = 13000});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.output, "x.ppm\n");
    EXPECT_THAT(folder.names(), ElementsAre("scenes", "x.ppm"));
}

TEST_F(Outputs, StandardOutputThatCannotBeWrittenIsAFailure) {
    EXPECT_EQ(run({"render", scene(""), "-o", "x.ppm"}, {.output = "/dev/full"}).exit_code, 1);
    EXPECT_EQ(run({"render", scene(""), "-o", "x.ppm", "--stats", "-"}, {.output = "/dev/full"}).exit_code, 1);
    EXPECT_EQ(run({"info", scene("")}, {.output = "/dev/full"}).exit_code, 1);
    EXPECT_EQ(run({"--help"}, {.output = "/dev/full"}).exit_code, 1);
}

TEST_F(Outputs, NothingMeantForAClosedStandardOutputLandsInAFile) {
    const Outcome outcome = run({"render", scene(""), "-o", "x.ppm"}, {.output_closed = true});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(load(folder / "x.ppm").find("x.ppm"), std::string::npos);
}

TEST_F(Outputs, APipeThatNobodyReadsIsAFailure) {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    ::close(ends[0]);
    const Outcome outcome =
        run({"render", scene(""), "-o", "x.ppm", "--stats", "-"}, {.output = "/dev/fd/" + std::to_string(ends[1])});
    ::close(ends[1]);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr("standard output"));
}

#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes of address space and ends the program itself
TEST_F(Outputs, OutOfMemoryIsAFailureWithAMessage) {
    const Outcome outcome = run({"render", scene(""), "-o", "x.ppm", "--size", "4096x4096", "--spp", "1"},
                                {.address_space = rlim_t{400} << 20});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr("out of memory"));
    EXPECT_THAT(folder.names(), ElementsAre("scenes"));
}
#endif

TEST(ErrorImage, IsWrittenBesideTheOthersAndNamed) {
    const TemporaryFolder folder;
    const Outcome outcome = orrery(
        {"render", scene_file("tests/diffuse_area.json"), "-o", "x.ppm", "--error-image", "e.exr", "--size", "9x7"},
        {.folder = folder.path()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(outcome.output, "x.ppm\ne.exr\n");
    EXPECT_THAT(load(folder / "e.exr"), HasSubstr("standard error"));
    const Image errors = read_image(folder / "e.exr");
    EXPECT_EQ(errors.width, 9u);
    EXPECT_EQ(errors.height, 7u);
    EXPECT_TRUE(std::ranges::any_of(errors.pixels, [](const Rgb& p) { return p.g > 0; }));
}

TEST(ErrorImage, IsLinearOrRefused) {
    const TemporaryFolder folder;
    for (const char* name : {"e.png", "e.ppm", "e.jpg", "x.exr"}) {
        const Outcome outcome =
            orrery({"render", scene_file("tests/diffuse_area.json"), "-o", "x.exr", "--error-image", name},
                   {.folder = folder.path()});
        EXPECT_EQ(outcome.exit_code, 2) << name;
        EXPECT_THAT(outcome.error, HasSubstr(name));
    }
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace orrery::test
