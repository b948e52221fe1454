// Scenes that cannot be rendered: exit code 2, what is wrong on standard error, and no file touched.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "program.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Renders the text over an existing image, and checks that nothing is touched. Returns what the program said.
std::string refusal_of(const std::string& text, const char* command = "render") {
    const TemporaryFolder folder;
    store(folder / "scene.json", to_bytes(text));
    store(folder / "image.ppm", to_bytes("previous"));
    std::vector<std::string> arguments = {command, "scene.json"};
    if (std::string(command) == "render") arguments.insert(arguments.end(), {"-o", "image.ppm", "--stats", "s.json"});
    const Outcome outcome = orrery(arguments, {.folder = folder.path()});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(load(folder / "image.ppm"), "previous");
    EXPECT_THAT(folder.names(), ElementsAre("image.ppm", "scene.json"));
    EXPECT_THAT(outcome.error, HasSubstr("error: "));
    return outcome.error;
}

std::string spoilt(const char* pointer, const nlohmann::json& value) {
    auto world = small_world();
    world[nlohmann::json::json_pointer(pointer)] = value;
    return world.dump();
}

/// The world's text with one piece replaced, for what no JSON library writes.
std::string replaced(const std::string& piece, const std::string& by) {
    std::string text = small_world().dump();
    return text.replace(text.find(piece), piece.size(), by);
}

TEST(BadScene, EveryFaultIsNamedWithItsPlaceInOneRun) {
    auto world = small_world();
    world["scene"]["primitives"][0]["material"] = "n";
    world["scene"]["camera"] = "d";
    world["materials"][0]["rho"] = {0.5, 2, 0.5};
    for (const char* command : {"render", "info"})
        EXPECT_THAT(refusal_of(world.dump(), command),
                    AllOf(HasSubstr("scene.json:/scene/primitives/0/material: error: "), HasSubstr("\"m\""),
                          HasSubstr("scene.json:/scene/camera: error: "), HasSubstr("scene.json:/materials/0/rho")));
}

TEST(BadScene, ASyntaxErrorHasLineAndColumn) {
    EXPECT_THAT(refusal_of("{\n  \"cameras\": [,]\n}"), HasSubstr("scene.json:2:15: error: "));
}

TEST(BadScene, Garbage) {
    std::mt19937 random(1);
    std::string bytes(200'000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const std::string error = refusal_of(bytes);
    EXPECT_LT(error.size(), 2000u) << "a message, not a dump";
    refusal_of("");
    refusal_of(std::string(200'000, '\0'));
    refusal_of(std::string(200'000, ' '));
}

TEST(BadScene, DeepNesting) {
    refusal_of(std::string(100'000, '['));
    refusal_of(std::string(100'000, '[') + std::string(100'000, ']'));
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    refusal_of(objects);
}

TEST(BadScene, NumbersThatAreNone) {
    refusal_of(replaced("\"radius\":1", "\"radius\":NaN"));
    refusal_of(replaced("\"radius\":1", "\"radius\":1e400"));
    refusal_of(replaced("\"radius\":1", "\"radius\":-Infinity"));
    refusal_of(replaced("\"radius\":1", "\"radius\":0"));
    refusal_of(replaced("\"samples\":4", "\"samples\":1e400"));
}

TEST(BadScene, DimensionsBeyondReason) {
    refusal_of(spoilt("/scene/renderer/dimensions", {1'000'000'000, 1'000'000'000}));
    refusal_of(spoilt("/scene/renderer/dimensions", {1'000'000'000, 1}));
    EXPECT_THAT(refusal_of(spoilt("/scene/renderer/dimensions", {65536, 65536})), HasSubstr("601.3 GB"));
}

TEST(BadScene, FilesThatAreNoScene) {
    for (const char* file : {"missing.json", "/", "/dev/null", "/proc/self/mem", ""}) {
        const Outcome outcome = orrery({"render", file, "-o", "/nowhere/x.ppm"});
        EXPECT_EQ(outcome.exit_code, 2) << file;
        EXPECT_NE(outcome.error, "");
    }
}

TEST(BadScene, WarningsDoNotStopARender) {
    const TemporaryFolder folder;
    store(folder / "scene.json", to_bytes(spoilt("/scene/renderer/gamma", 2.2)));
    const Outcome outcome = orrery({"render", "scene.json", "-o", "x.ppm"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.error, HasSubstr("scene.json:/scene/renderer/gamma: warning: "));
}

}  // namespace
}  // namespace orrery::test
