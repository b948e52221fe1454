// Command lines that are answered or refused before any scene is rendered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "program.hpp"
#include "pseudo_terminal.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;
using Arguments = std::vector<std::string>;

const std::string any_scene = scene_file("tests/diffuse_area.json");

TEST(Usage, HelpAndVersionGoToStandardOutput) {
    for (const Arguments& asked : {Arguments{"--help"},
                                   {"-h"},
                                   {"render", "--help"},
                                   {"info", "--help"},
                                   {"generate", "--help"},
                                   {"develop", "--help"},
                                   {"compare", "--help"}}) {
        const Outcome help = orrery(asked);
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_THAT(help.output, HasSubstr("Usage: orrery"));
        EXPECT_EQ(help.error, "");
    }
    const Outcome version = orrery({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    // With the revision, where the source is a checkout.
    EXPECT_THAT(version.output, MatchesRegex("orrery " ORRERY_VERSION "([+][0-9a-f]{9})?\n"));
}

TEST(Usage, RenderHelpNamesEveryOptionItsDefaultAndAnExample) {
    const std::string help = orrery({"render", "--help"}).output;
    for (const char* option : {"-o,--output FILE",
                               "--integrator pt|wrt|depth",
                               "--spp N",
                               "--depth N",
                               "--size WxH",
                               "--seed N",
                               "--threads N",
                               "--estimator uniform|stratified|sobol",
                               "--transport naive|nee|mis",
                               "--light-sampling area|cone",
                               "--light-choice all|uniform|power",
                               "--roulette on|off",
                               "--roulette-from N",
                               "--tonemap sigmoid|linear|none|srgb",
                               "--isa auto|scalar|sse2|avx2|avx512",
                               "--precision auto|float|double",
                               "--stats FILE.json",
                               "--quiet",
                               "--wave-size N",
                               "--error SHARE",
                               "--time TIME",
                               "--adaptive on|off",
                               "--error-image FILE"})
        EXPECT_THAT(help, HasSubstr(option));
    EXPECT_GE(count_of("(default: ", help), 14u);
    EXPECT_THAT(help, HasSubstr("Example"));
    EXPECT_THAT(help, HasSubstr("orrery render scenes/"));
}

const std::vector<Arguments> helps = {
    {"--help"},           {"render", "--help"}, {"info", "--help"}, {"develop", "--help"}, {"generate", "--help"},
    {"compare", "--help"}};

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream split(text);
    std::vector<std::string> words;
    for (std::string word; split >> word;)
        if (word != "\\") words.push_back(word);  // behind a command that goes on
    return words;
}

TEST(Usage, HelpFitsItsTerminalAndBreaksNoWord) {
    for (const Arguments& asked : helps) {
        const std::vector<std::string> words = words_of(orrery(asked, {.columns = "100"}).output);
        for (const std::size_t columns : {20u, 40u, 60u, 80u, 81u, 100u}) {
            const std::string help = orrery(asked, {.columns = std::to_string(columns)}).output;
            EXPECT_EQ(words_of(help), words) << columns;
            std::istringstream lines(help);
            for (std::string line; std::getline(lines, line);) {
                EXPECT_TRUE(line.size() <= columns || words_of(line).size() == 1) << columns << ": " << line;
                EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
            }
        }
    }
}

TEST(Usage, HelpIsEightyColumnsWideWhereNobodyKnowsAndAHundredAtMost) {
    const std::string help = orrery({"render", "--help"}).output;
    for (const char* columns : {"80", "0", "-3", "wide", "80x"})
        EXPECT_EQ(orrery({"render", "--help"}, {.columns = columns}).output, help) << columns;
    EXPECT_EQ(orrery({"render", "--help"}, {.columns = "100"}).output,
              orrery({"render", "--help"}, {.columns = "4000"}).output);
    EXPECT_NE(orrery({"render", "--help"}, {.columns = "100"}).output, help);
}

TEST(Usage, HelpIsAsWideAsTheTerminal) {
    PseudoTerminal terminal(50);
    Program program({"render", "--help"}, {.output = terminal.name()});
    EXPECT_TRUE(terminal.shows("scene.\r\n"));
    program.wait();
    std::string shown = terminal.shown();
    std::erase(shown, '\r');
    EXPECT_EQ(shown, orrery({"render", "--help"}, {.columns = "50"}).output);
}

TEST(Usage, HintsNameTheCommandThatWasTyped) {
    EXPECT_THAT(orrery({"render"}, {.typed = "./run"}).error, HasSubstr("Try: ./run render --help\n"));
    EXPECT_THAT(orrery({"render"}).error, HasSubstr("Try: orrery render --help\n"));
    EXPECT_THAT(orrery({}, {.typed = "../here/run"}).error, HasSubstr("Try: ../here/run --help\n"));
    for (const Arguments& asked : helps) {
        const std::string help = orrery(asked, {.typed = "./run"}).output;
        EXPECT_THAT(help, HasSubstr("Usage: ./run"));
        EXPECT_THAT(help, HasSubstr("  ./run "));
        EXPECT_THAT(help, Not(HasSubstr("orrery")));
    }
    EXPECT_THAT(orrery({}, {.typed = "\x1B[31mrun"}).error, Not(HasSubstr("\x1B")));
}

/// Runs the command line where nothing may appear, and checks that it is refused. Returns the reason.
std::string refusal_of(const Arguments& arguments) {
    const TemporaryFolder folder;
    const Outcome outcome = orrery(arguments, {.folder = folder.path()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_THAT(outcome.error, StartsWith("orrery: error: "));
    EXPECT_TRUE(folder.names().empty());
    return outcome.error;
}

/// As above, of a render with these options added.
std::string refusal_with(const Arguments& options) {
    Arguments arguments = {"render", any_scene, "-o", "x.ppm"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return refusal_of(arguments);
}

TEST(Usage, ACommandAndASceneAreNeeded) {
    EXPECT_THAT(refusal_of({}), HasSubstr("expected a command, render, info, develop, generate or compare"));
    EXPECT_THAT(refusal_of({"paint", any_scene}),
                HasSubstr("expected a command, render, info, develop, generate or compare"));
    EXPECT_THAT(refusal_of({"render"}), HasSubstr("SCENE"));
    EXPECT_THAT(refusal_of({"info"}), HasSubstr("SCENE"));
    EXPECT_THAT(refusal_of({"render", any_scene, "another.json"}), HasSubstr("another.json"));
}

TEST(Usage, OptionsAreKnownAndHaveOneValue) {
    EXPECT_THAT(refusal_with({"--bogus"}), HasSubstr("--bogus"));
    EXPECT_THAT(refusal_with({"--spp"}), HasSubstr("--spp"));
    EXPECT_THAT(refusal_with({"--spp", "4", "--spp", "5"}), HasSubstr("--spp"));
    EXPECT_THAT(refusal_of({"info", any_scene, "-o", "x.ppm"}), HasSubstr("-o"));
}

TEST(Usage, MisspeltWordsAreNamedWithTheNearestKnown) {
    EXPECT_THAT(refusal_of({"rendr", any_scene}), HasSubstr("found \"rendr\", expected a command"));
    EXPECT_THAT(refusal_of({"rendr", any_scene}), HasSubstr("did you mean render?"));
    EXPECT_THAT(refusal_of({"Generate"}), HasSubstr("did you mean generate?"));
    EXPECT_THAT(refusal_of({"paint"}), Not(HasSubstr("did you mean")));
    EXPECT_THAT(refusal_with({"--sp", "3"}), AllOf(HasSubstr("found \"--sp\""), HasSubstr("did you mean --spp?")));
    EXPECT_THAT(refusal_of({"render", "--sp", "3"}), HasSubstr("did you mean --spp?"));
    EXPECT_THAT(refusal_of({"render", "--ouput=x.ppm", any_scene}), HasSubstr("did you mean --output?"));
    EXPECT_THAT(refusal_with({"--light-choise", "all"}), HasSubstr("did you mean --light-choice?"));
    EXPECT_THAT(refusal_of({"compare", "a", "b", "--max-rms", "1"}), HasSubstr("did you mean --max-rmse?"));
    EXPECT_THAT(refusal_with({"--bogus"}), Not(HasSubstr("did you mean")));
    EXPECT_THAT(refusal_with({"--\x1B[31m"}), Not(HasSubstr("\x1B")));
}

TEST(Usage, NumbersAreWholeAndInRange) {
    for (const char* text : {"0", "-1", "4294967296", "1e3", "0x10", "", " 4", "4 ", "+4", "4.0", "nan"})
        EXPECT_THAT(refusal_with({"--spp", text}), AllOf(HasSubstr("--spp: found"), HasSubstr("1 to 4294967295")));
    EXPECT_THAT(refusal_with({"--depth", "-1"}), HasSubstr("0 to 4294967295"));
    EXPECT_THAT(refusal_with({"--integrator", "wrt", "--depth", "21"}), HasSubstr("0 to 20"));
    EXPECT_THAT(refusal_with({"--seed", "4294967296"}), HasSubstr("0 to 4294967295"));
    for (const char* text : {"0", "1025"}) EXPECT_THAT(refusal_with({"--threads", text}), HasSubstr("1 to 1024"));
    for (const char* text : {"0", "65537"}) EXPECT_THAT(refusal_with({"--wave-size", text}), HasSubstr("1 to 65536"));
}

TEST(Usage, SizesAreTwoNumbers) {
    for (const char* text : {"640", "0x480", "640x0", "65537x1", "640x480x3", "x", "", "640X480", "640 x 480"})
        EXPECT_THAT(refusal_with({"--size", text}), AllOf(HasSubstr("WIDTHxHEIGHT"), HasSubstr("1 to 65536")));
}

TEST(Usage, StopsAreSharesAndTimes) {
    for (const char* text : {"0", "-1%", "101%", "1.5", "1 %", "%", "nan", "inf", "1e-3", "0x1", "1%%", ""})
        EXPECT_THAT(refusal_with({"--error", text}), HasSubstr("1% or 0.01")) << text;
    for (const char* text : {"30", "0s", "-1s", "1d", "s", "1 s", "1e3s", "nans", "9000000h", ""})
        EXPECT_THAT(refusal_with({"--time", text}), HasSubstr("30s, 2m, 1.5h or 500ms")) << text;
    EXPECT_THAT(refusal_with({"--adaptive", "on"}), HasSubstr("expected --error or --time"));
}

TEST(Usage, ChoicesNameWhatThereIs) {
    EXPECT_THAT(refusal_with({"--integrator", "PT"}), HasSubstr("pt|wrt|depth"));
    EXPECT_THAT(refusal_with({"--estimator", "halton"}), HasSubstr("uniform|stratified|sobol"));
    EXPECT_THAT(refusal_with({"--transport", "bdpt"}), HasSubstr("naive|nee|mis"));
    EXPECT_THAT(refusal_with({"--light-sampling", "uniform"}), HasSubstr("area|cone"));
    EXPECT_THAT(refusal_with({"--light-choice", "one"}), HasSubstr("all|uniform|power"));
    EXPECT_THAT(refusal_with({"--roulette", "yes"}), HasSubstr("on|off"));
    EXPECT_THAT(refusal_with({"--tonemap", "aces"}), HasSubstr("sigmoid|linear|none|srgb"));
    EXPECT_THAT(refusal_with({"--isa", "avx9000"}), HasSubstr("supports: scalar"));
    EXPECT_THAT(refusal_with({"--precision", "half"}), HasSubstr("auto|float|double"));
}

TEST(Usage, OutputsHaveAKnownEndingAndAreDifferentFiles) {
    for (const char* name : {"x.jpeg", "noending", "", ".png/"})
        EXPECT_THAT(refusal_with({"-o", name}), HasSubstr(".ppm, .png, .pfm and .exr"));
    EXPECT_THAT(refusal_with({"-o", "./x.ppm"}), HasSubstr("named twice"));
    EXPECT_THAT(refusal_with({"--stats", "x.ppm"}), HasSubstr("named twice"));
    EXPECT_THAT(refusal_with({"--stats", any_scene}), HasSubstr("named twice"));
}

TEST(Usage, MorePixelsThanMemoryAreRefusedWithTheFigure) {
    const Outcome outcome = orrery({"render", any_scene, "-o", "/x.ppm", "--size", "65536x65536"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.error, HasSubstr("601.3 GB"));
}

TEST(Usage, AScenesOwnDepthMayBeTooMuchForWhitted) {
    const TemporaryFolder folder;
    auto world = small_world();
    world["scene"]["renderer"]["depth"] = 21;
    store(folder / "scene.json", to_bytes(world.dump()));
    const Outcome outcome = orrery({"info", (folder / "scene.json").string(), "--integrator", "wrt"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.error, HasSubstr("the scene's depth"));
}

}  // namespace
}  // namespace orrery::test
