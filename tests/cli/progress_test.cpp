// The progress bar: on a terminal only, and gone when the work is done.
#include "cli/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "pseudo_terminal.hpp"

namespace orrery::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

TEST(Progress, LineTellsPercentRateAndTimeLeft) {
    EXPECT_EQ(progress_line(0.25, 3'000'000, 2, 79),
              "[###########------------------------------------]   25 %  1.5 Mrays/s  6 s left");
    EXPECT_THAT(progress_line(0, 0, 0, 79), MatchesRegex("\\[-+\\]    0 %"));
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
    EXPECT_THAT(outcome.error, Not(HasSubstr(" %")));
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

}  // namespace
}  // namespace orrery::test
