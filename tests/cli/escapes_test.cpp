// Nothing that comes from a scene, a file name or the command line reaches a terminal raw.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "program.hpp"
#include "pseudo_terminal.hpp"
#include "system/printable.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Arguments = std::vector<std::string>;

/// Sets a terminal's title, clears it, paints it, ends the line and fakes another, turns the direction of text, breaks
/// the line again, and is no UTF-8.
const std::string evil =
    "\x1B]0;title\x07\x1B[2J\x1B[31mred\r\nerror: fake\x7F\xC2\x9B"
    "31m\xE2\x80\xAE"
    "live\xE2\x80\xA8\xFF";
/// The same for JSON, which must be UTF-8.
const std::string evil_text = evil.substr(0, evil.size() - 1);

/// Every line of what was printed can be looked at.
void expect_lines(const std::string& text, std::size_t lines) {
    EXPECT_EQ(count_of("\n", text), lines) << printable_whole(text);
    std::string visible = text;
    std::erase(visible, '\n');
    EXPECT_TRUE(is_printable(visible)) << printable_whole(text);
}

class Escapes : public ::testing::Test {
protected:
    Escapes() { store_world("scene.json", small_world()); }

    void store_world(const std::string& name, const nlohmann::json& world) const {
        store(folder / name.c_str(), to_bytes(world.dump()));
    }
    Outcome run(const Arguments& arguments, Surroundings surroundings = {}) const {
        surroundings.folder = folder.path();
        return orrery(arguments, surroundings);
    }

    TemporaryFolder folder;
};

TEST_F(Escapes, NamesOfScenesAndImages) {
    store_world(evil, small_world());
    const Outcome outcome = run({"render", evil, "-o", evil + ".png", "--stats", evil + ".json"});
    EXPECT_EQ(outcome.exit_code, 0);
    expect_lines(outcome.error, 1);
    EXPECT_EQ(outcome.output, evil + ".png\n") << "a script reads the very name";
    EXPECT_TRUE(fs::exists(folder / (evil + ".png").c_str()));
    expect_lines(run({"info", evil}).output, count_of("\n", run({"info", "scene.json"}).output));
    const Outcome stats = run({"render", evil, "-o", evil + ".png", "--quiet", "--stats", "-"});
    expect_lines(stats.output, count_of("\n", stats.output));
    EXPECT_NO_THROW(nlohmann::json::parse(stats.output));
}

TEST_F(Escapes, NamesOnATerminal) {
    PseudoTerminal terminal;
    const std::string output = "/proc/self/fd/" + std::to_string(terminal.program_side());
    EXPECT_EQ(run({"render", "scene.json", "-o", evil + ".png", "--quiet"}, {.output = output}).exit_code, 0);
    EXPECT_EQ(run({"generate", "random", "--spheres", "3", "-o", evil + ".json"}, {.output = output}).exit_code, 0);
    std::string shown = terminal.shown();
    std::erase(shown, '\r');  // the terminal's own
    expect_lines(shown, 2);
    EXPECT_THAT(shown, HasSubstr("live"));
}

TEST_F(Escapes, NamesThatCannotBeUsed) {
    const Arguments refused[] = {
        {"render", "no" + evil},
        {"info", "no" + evil},
        {"render", "scene.json"},
        {"render", "scene.json", "-o", evil},
        {"render", "scene.json", "-o", evil + "/x.png"},
        {"render", "scene.json", "-o", "x.png", "--error-image", evil},
        {"render", "scene.json", "-o", "x.png", "--stats", evil + "/x.json"},
        {"render", "scene.json", "-o", evil + ".png", "-o", evil + ".png"},
        {"generate", "random", "--spheres", "3", "-o", evil + "/x.json"},
        {"compare", evil, "scene.json"},
        {"compare", "scene.json", evil},
        {"compare", "scene.json", "scene.json", "--difference", evil},
        {"compare", "scene.json", "scene.json", "--json", evil + "/x"},
    };
    for (const Arguments& arguments : refused) {
        const Outcome outcome = run(arguments);
        EXPECT_GT(outcome.exit_code, 0);
        expect_lines(outcome.error, 1);
        EXPECT_EQ(outcome.output, "");
    }
}

TEST_F(Escapes, WordsOfTheCommandLine) {
    const Arguments refused[] = {
        {evil},
        {"--" + evil},
        {"render", "scene.json", evil},
        {"render", "scene.json", "--" + evil},
        {"render", "scene.json", "--" + evil + "=3"},
        {"render", "scene.json", "--spp", evil},
        {"render", "scene.json", "--size", evil},
        {"render", "scene.json", "--transport", evil},
        {"render", "scene.json", "--isa", evil},
        {"render", "scene.json", "--quiet=" + evil},
        {"render", "scene.json", "-" + evil},
        {"generate", evil},
        {"compare", "scene.json", "scene.json", "--max-rmse", evil},
    };
    for (const Arguments& arguments : refused) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        expect_lines(outcome.error, 2);
        EXPECT_THAT(outcome.error, StartsWith("orrery: error: "));
    }
}

TEST_F(Escapes, ImagesThatCannotBeRead) {
    store(folder / "broken.pfm", to_bytes("PF\n" + evil + " 3\n-1.0\n"));
    const Outcome outcome = run({"compare", "broken.pfm", "broken.pfm"});
    EXPECT_EQ(outcome.exit_code, 1);
    expect_lines(outcome.error, 1);
}

TEST_F(Escapes, TextOfAScene) {
    const auto spoil = [&](const char* pointer, const nlohmann::json& value) {
        auto world = small_world();
        world[nlohmann::json::json_pointer(pointer)] = value;
        return world;
    };
    const nlohmann::json worlds[] = {
        spoil("/scene/camera", evil_text),
        spoil("/scene/renderer/type", evil_text),
        spoil("/scene/renderer/estimator", evil_text),
        spoil("/scene/renderer/samples", evil_text),
        spoil("/scene/primitives/0/material", evil_text),
        spoil("/scene/primitives/1/light", evil_text),
        spoil("/materials/0/type", evil_text),
        spoil("/materials/0/rho", {{evil_text, 1}}),
        spoil("/shapes/0/radius", -1),
        spoil("/scene", {{evil_text, 1}}),
    };
    for (const nlohmann::json& world : worlds) {
        store_world("bad.json", world);
        const Outcome outcome = run({"render", "bad.json", "-o", "x.png"});
        EXPECT_EQ(outcome.exit_code, 2);
        expect_lines(outcome.error, count_of("\nbad.json:", "\n" + outcome.error));
    }
    auto odd = small_world();
    odd[evil_text] = odd["scene"][evil_text] = odd["materials"][0][evil_text] = 1;
    store_world("odd.json", odd);
    const Outcome outcome = run({"render", "odd.json", "-o", "x.png"});
    EXPECT_EQ(outcome.exit_code, 0);
    expect_lines(outcome.error, 2);  // the warnings are of one kind, and told once; the summary
    store(folder / "raw.json", to_bytes("{\"" + evil));
    expect_lines(run({"render", "raw.json", "-o", "x.png"}).error, 1);
}

TEST_F(Escapes, AnOutputWithControlCharactersIsRefused) {
    for (const std::string character :
         {"\x1B", "\x07", "\r", "\n", "\t", "\x7F", "\xC2\x9B", "\xE2\x80\xAE", "\xE2\x80\xA8"}) {
        auto world = small_world();
        world["scene"]["renderer"]["output"] = "a" + character + "b.png";
        store_world("bad.json", world);
        const Outcome outcome = run({"render", "bad.json"});
        EXPECT_EQ(outcome.exit_code, 2);
        expect_lines(outcome.error, 1);
        EXPECT_THAT(outcome.error, HasSubstr("bad.json:/scene/renderer/output: error: found \"a\\x"));
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"bad.json", "scene.json"}));
}

}  // namespace
}  // namespace orrery::test
