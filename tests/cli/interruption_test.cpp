// Ctrl-C, at three moments.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "program.hpp"
#include "pseudo_terminal.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class Interruption : public ::testing::TestWithParam<int> {};

TEST_P(Interruption, InMidRenderLeavesThePreviousImageAndNothingElse) {
    const TemporaryFolder folder;
    store(folder / "x.png", to_bytes("previous"));
    PseudoTerminal terminal;
    // Minutes of work; the first tile shows progress within moments.
    Program program({"render", scene_file("assignment_08.json"), "--size", "1024x1024", "--spp", "1024", "-o", "x.png",
                     "--stats", "s.json"},
                    {.folder = folder.path(), .terminal = terminal.program_side()});
    ASSERT_TRUE(terminal.shows(" left")) << terminal.shown();
    program.send(GetParam());
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 128 + GetParam());
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(load(folder / "x.png"), "previous");
    EXPECT_THAT(folder.names(), ElementsAre("x.png"));
    const std::string loss = "orrery: interrupted: the render is lost, no image was written\r\n";
    EXPECT_THAT(terminal.shown(), AnyOf(EndsWith(" \r" + loss), EndsWith("\r\x1B[K" + loss)))
        << "the bar is gone, also where a busy machine makes the handler end the program";
}

TEST_P(Interruption, WhileReadingTheSceneEndsAtOnce) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "scene.json").c_str(), 0600), 0);
    Program program({"render", "scene.json", "-o", "x.png"}, {.folder = folder.path()});
    // Opens when the program does: it is reading now, and reads for ever.
    const int writer = ::open((folder / "scene.json").c_str(), O_WRONLY | O_CLOEXEC);
    program.send(GetParam());
    EXPECT_EQ(program.wait().exit_code, 128 + GetParam());
    ::close(writer);
    EXPECT_THAT(folder.names(), ElementsAre("scene.json"));
}

/// A path that never ends, in a white room around a single pixel.
nlohmann::json endless_path() {
    auto world = small_world();
    world["materials"][0]["rho"] = {1, 1, 1};
    world["cameras"][0]["position"] = {0, 0, -0.5};
    world["scene"]["renderer"] = {{"type", "PT"}, {"dimensions", {1, 1}}, {"samples", 1}, {"depth", 4294967295u}};
    return world;
}

/// Waits until a program that gave us no sign is at work.
void let_it_begin() { std::this_thread::sleep_for(std::chrono::milliseconds(300)); }

TEST_P(Interruption, WithinAPathThatNeverEnds) {
    const TemporaryFolder folder;
    store(folder / "scene.json", to_bytes(endless_path().dump()));
    Program program({"render", "scene.json", "-o", "x.png"}, {.folder = folder.path()});
    let_it_begin();
    const auto sent = std::chrono::steady_clock::now();
    program.send(GetParam());
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 128 + GetParam());
    EXPECT_EQ(outcome.error, "orrery: interrupted: the render is lost, no image was written\n");
    EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(1)) << "0.1 s, and a busy machine";
    EXPECT_THAT(folder.names(), ElementsAre("scene.json"));
}

TEST_P(Interruption, StaysIgnoredWhereItWas) {
    const TemporaryFolder folder;
    store(folder / "scene.json", to_bytes(endless_path().dump()));
    Program program({"render", "scene.json", "-o", "x.png", "--time", "600ms"},
                    {.folder = folder.path(), .ignored_signal = GetParam()});
    let_it_begin();
    program.send(GetParam());
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.exit_code, 1) << "ended by its time";
    EXPECT_THAT(outcome.error, HasSubstr("time"));
}

// Four images of four million pixels take seconds to encode, which begins when the bar is gone.
TEST_P(Interruption, WhileImagesAreWrittenSaysWhatIsLost) {
    const TemporaryFolder folder;
    PseudoTerminal terminal;
    Program program({"render", scene_file("assignment_08.json"), "--size", "2048x2048", "--spp", "1", "--integrator",
                     "depth", "-o", "a.png", "-o", "b.png", "-o", "c.exr", "-o", "d.png"},
                    {.folder = folder.path(), .terminal = terminal.program_side()});
    ASSERT_TRUE(terminal.shows("  \r")) << terminal.shown();
    const auto sent = std::chrono::steady_clock::now();
    program.send(GetParam());
    EXPECT_EQ(program.wait().exit_code, 128 + GetParam());
    EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(1)) << "0.1 s, and a busy machine";
    EXPECT_THAT(terminal.shown(),
                EndsWith("\r\x1B[Korrery: interrupted: images that were not written yet are lost\r\n"));
    for (const std::string& name : folder.names()) EXPECT_THAT(name, AnyOf("a.png", "b.png", "c.exr"));
}

INSTANTIATE_TEST_SUITE_P(Signals, Interruption, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST(InterruptionTwice, EndsWorkThatIsSlowToAsk) {
    const TemporaryFolder folder;
    PseudoTerminal terminal;
    Program program({"render", scene_file("assignment_08.json"), "--size", "1024x1024", "--spp", "1024", "-o", "x.png"},
                    {.folder = folder.path(), .terminal = terminal.program_side()});
    ASSERT_TRUE(terminal.shows(" left"));
    program.send(SIGTERM);
    program.send(SIGTERM);
    EXPECT_EQ(program.wait().exit_code, 128 + SIGTERM);
    EXPECT_THAT(folder.names(), ElementsAre());
}

}  // namespace
}  // namespace orrery::test
