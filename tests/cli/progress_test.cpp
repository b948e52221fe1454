// The progress bar: on a terminal only, and gone when the work is done.
#include "cli/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "program.hpp"
#include "pseudo_terminal.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Progress, LineTellsPercentRateAndTimeLeft) {
    EXPECT_EQ(progress_line(0.25, 3'000'000, 2, 79),
              "[###########------------------------------------]   25 %  1.5 Mrays/s  6 s left");
    EXPECT_THAT(progress_line(0, 0, 0, 79), MatchesRegex("\\[-+\\]    0 %"));
    EXPECT_THAT(progress_line(0.75, 10, 2, 79, 1.0 / 0.0, 0.5), HasSubstr("  2 s left")) << "half was there before";
    EXPECT_THAT(progress_line(0.5, 0, 2, 79, 1.0 / 0.0, 0.5), MatchesRegex(".* 50 %.*[0-9] Mrays/s")) << "who knows";
    EXPECT_THAT(progress_line(1, 10, 2, 79), MatchesRegex("\\[#+\\]  100 %.*0 s left"));
    EXPECT_THAT(progress_line(0.999, 10, 2, 79), HasSubstr(" 99 %")) << "100 is said when all is done";
}

TEST(Progress, LineFitsEveryTerminal) {
    for (std::size_t columns = 0; columns <= 200; ++columns)
        for (const double fraction : {0.0, 1e-9, 0.3, 1.0}) {
            const std::size_t length = progress_line(fraction, 123'456'789, 4e4, columns).size();
            EXPECT_LE(length, columns);
            if (columns >= 70) {
                EXPECT_EQ(length, columns);
            }
        }
}

TEST(Progress, DurationsAreReadable) {
    EXPECT_EQ(duration_text(0), "0 s");
    EXPECT_EQ(duration_text(59.2), "1:00");
    EXPECT_EQ(duration_text(83), "1:23");
    EXPECT_EQ(duration_text(14706), "4:05:06");
    EXPECT_EQ(duration_text(172799), "47:59:59");
    EXPECT_EQ(duration_text(172800), "2 days");
    EXPECT_EQ(duration_text(674 * 3600), "28 days");
    EXPECT_NE(duration_text(1e300), "");
}

std::vector<std::string> a_second_of_work(const TemporaryFolder& folder) {
    return {"render", scene_file("assignment_08.json"), "--size", "128x128", "--spp", "64",
            "-o",     (folder / "x.ppm").string()};
}

TEST(Progress, IsShownOnATerminalAndCleanedUp) {
    const TemporaryFolder folder;
    PseudoTerminal terminal;
    const Outcome outcome = orrery(a_second_of_work(folder), {.terminal = terminal.program_side()});
    EXPECT_EQ(outcome.exit_code, 0);
    const std::string shown = terminal.shown();
    EXPECT_THAT(shown, HasSubstr(" %"));
    EXPECT_THAT(shown, HasSubstr("Mrays/s"));
    EXPECT_THAT(shown, HasSubstr(" left"));
    // The last the bar does is to blank its line; the summary takes its place.
    const std::size_t last_bar = shown.rfind(" left");
    EXPECT_THAT(shown.substr(last_bar), MatchesRegex(" left *\r +\r[^\r]*samples per pixel[^\r]*\r\n"));
}

TEST(Progress, IsAbsentElsewhere) {
    const TemporaryFolder folder;
    const Outcome outcome = orrery(a_second_of_work(folder));
    EXPECT_THAT(outcome.error, Not(HasSubstr(" left")));
    EXPECT_THAT(outcome.error, Not(HasSubstr("\r")));
}

TEST(Progress, IsAbsentWhenQuiet) {
    const TemporaryFolder folder;
    PseudoTerminal terminal;
    auto arguments = a_second_of_work(folder);
    arguments.push_back("--quiet");
    orrery(arguments, {.terminal = terminal.program_side()});
    EXPECT_EQ(terminal.shown(), "");
}

/// A scene that is read from a pipe: it takes as long as the test likes.
class SlowScene : public ::testing::Test {
protected:
    SlowScene() { EXPECT_EQ(::mkfifo(pipe_.c_str(), 0600), 0); }

    /// Renders from the pipe; `meanwhile` is called between two halves of the text.
    template <class Meanwhile>
    Outcome render(std::vector<std::string> options, const Meanwhile& meanwhile) {
        std::vector<std::string> arguments{"render", pipe_.string(), "-o", (folder_ / "x.ppm").string()};
        arguments.insert(arguments.end(), options.begin(), options.end());
        Program program(arguments, {.terminal = terminal_.program_side()});
        const std::string text = small_world().dump();
        std::ofstream stream(pipe_);
        stream << text.substr(0, text.size() / 2) << std::flush;
        meanwhile();
        stream << text.substr(text.size() / 2) << std::flush;
        stream.close();
        return program.wait();
    }

    PseudoTerminal terminal_;
    const TemporaryFolder folder_;

private:
    const std::filesystem::path pipe_ = folder_ / "slow.json";
};

TEST_F(SlowScene, SaysThatItIsReadAndTakesThatBack) {
    const Outcome outcome = render({}, [&] { EXPECT_TRUE(terminal_.shows("reading slow.json ...")); });
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(terminal_.shown(), StartsWith("\rreading slow.json ...\r                     \r"));
}

TEST_F(SlowScene, SaysNothingWhenQuiet) {
    const Outcome outcome = render({"--quiet"}, [] { std::this_thread::sleep_for(std::chrono::milliseconds(1500)); });
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(terminal_.shown(), "");
}

}  // namespace
}  // namespace orrery::test
