// Whatever bytes come: the reader returns, soon, with a scene or with errors, and with messages fit to print.
#include <gtest/gtest.h>

#include <ctime>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "scene/world.hpp"
#include "system/printable.hpp"

namespace orrery::test {
namespace {

/// The promise of ReadResult, and messages that are printable UTF-8 of bounded length.
void check(const ReadResult& result, const std::string& what) {
    bool has_error = false;
    for (const Diagnostic& diagnostic : result.diagnostics) {
        has_error |= diagnostic.severity == Severity::error;
        EXPECT_LT(diagnostic.message.size(), 2000u) << what;
        EXPECT_LT(diagnostic.where.size(), 40000u) << what;
        EXPECT_EQ(printable(diagnostic.message, 100000), diagnostic.message) << what;
        EXPECT_EQ(printable(diagnostic.where, 100000), diagnostic.where) << what;
        EXPECT_FALSE(diagnostic.message.empty()) << what;
    }
    EXPECT_EQ(result.scene.has_value(), !has_error) << what;
}

/// Processor time since construction: what a busy machine makes of it does not fail a test.
class Stopwatch {
public:
    double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
    std::clock_t start_ = std::clock();
};

/// Reads and checks; returns the seconds it took.
double seconds_for(const std::string& text, const std::string& what) {
    const Stopwatch stopwatch;
    const ReadResult result = read_scene_text(text, "x.json");
    const double seconds = stopwatch.seconds();
    check(result, what);
    return seconds;
}

std::string repeated(std::string_view part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
}

/// The text of a size takes about as much longer as it is larger: eight times, where a reader that looks at all of it
/// for every part takes 64 times as long.
void expect_proportionate(const std::string& what, int size, const std::function<std::string(int)>& text_of) {
    const std::string small = text_of(size), large = text_of(8 * size);
    const double once = std::min(seconds_for(small, what), seconds_for(small, what));
    EXPECT_LT(seconds_for(large, what), 24 * once + 0.02) << what;
}

TEST(Robustness, GarbageIsRefused) {
    std::mt19937 random(1);
    const auto bytes = [&](int size) {
        std::string text(static_cast<std::size_t>(size), '\0');
        for (char& c : text) c = static_cast<char>(random() & 0xFF);
        return text;
    };
    expect_proportionate("bytes", 100'000, bytes);
    expect_proportionate("bytes in a string", 100'000, [&](int size) { return '"' + bytes(size); });
    expect_proportionate("a long token before the fault", 100'000,
                         [&](int size) { return '"' + std::string(static_cast<std::size_t>(size), 'a') + "\" 5"; });
}

TEST(Robustness, DeepNestingIsRefused) {
    for (const char* part : {"[", "{\"a\":", "[[],", "{\"a\":[", "[{\"b\":"}) {
        const ReadResult result = read_scene_text(repeated(part, 100'000), "x.json");
        check(result, part);
        ASSERT_EQ(result.diagnostics.size(), 1u);
        EXPECT_NE(result.diagnostics[0].message.find("expected at most 100"), std::string::npos);
    }
    // Nested to the limit it is just a value of a wrong kind, whoever may hold it.
    Json json = world();
    json["extra"] = Json::parse(repeated("[", 99) + repeated("]", 99));
    const ReadResult result = read(json);
    EXPECT_TRUE(result.scene.has_value()) << listing(result);
    EXPECT_EQ(result.diagnostics.size(), 1u);
}

/// A scene of so many more spheres, each of a material of its own, which its primitive calls by its id and `slip`.
std::string many(int spheres, const std::string& slip) {
    Json json = world();
    for (int i = 0; i < spheres; ++i) {
        const std::string id = std::to_string(i) + " is the number of a sphere with a rather long name";
        json["shapes"].push_back({{"id", id}, {"type", "sphere"}, {"centre", {i, 10, 0}}, {"radius", 0.5}});
        json["materials"].push_back({{"id", id}, {"type", "diffuse"}, {"rho", {0.5, 0.5, 0.5}}});
        json["scene"]["primitives"].push_back(
            {{"id", "p"}, {"type", "geometric"}, {"shape", id}, {"material", id + slip}});
    }
    return json.dump();
}

TEST(Robustness, WhatIsLargeTakesAsMuchLonger) {
    expect_proportionate("empty entries", 5'000,
                         [](int n) { return "{\"materials\": [" + repeated("{},", n) + "{}]}"; });
    expect_proportionate("one key repeated", 5'000, [](int n) { return "{" + repeated("\"a\":1,", n) + "\"a\":1}"; });
    expect_proportionate("many keys", 5'000, [](int n) {
        std::string text = "{";
        for (int i = 0; i < n; ++i) text += '"' + std::to_string(i) + "\":1,";
        return text + "\"a\":1}";
    });
    expect_proportionate("repeated keys below a long one", 2'000, [](int n) {
        return "{\"" + std::string(static_cast<std::size_t>(n), '~') + "\": {" + repeated("\"b\":1,", n) + "\"b\":1}}";
    });
    expect_proportionate("a sound scene", 2'000, [](int n) { return many(n, ""); });
    // Every misspelt id against every known one: the search for the nearest is what could hang.
    expect_proportionate("misspelt ids", 2'000, [](int n) { return many(n, "x"); });
}

TEST(Robustness, LargeScenesAreReadWhole) {
    const ReadResult result = read_scene_text(many(20'000, ""), "x.json");
    ASSERT_TRUE(result.scene.has_value()) << listing(result);
    EXPECT_EQ(result.scene->primitives.size(), 20'006u);
    EXPECT_EQ(result.scene->materials[result.scene->primitives.back().material].id.substr(0, 6), "19999 ");
}

TEST(Robustness, HugeNumbersAreFaultsNotCrashes) {
    for (const char* number : {"123456789012345678901234567890", "-123456789012345678901234567890", "1e308", "-1e308",
                               "18446744073709551615", "-9223372036854775808", "1e-320", "0.1e-400", "-0"}) {
        Json json = world();
        json["scene"]["renderer"]["dimensions"] = {"NUMBER", "NUMBER"};
        json["scene"]["renderer"]["samples"] = "NUMBER";
        json["scene"]["renderer"]["seed"] = "NUMBER";
        json["shapes"][0]["radius"] = "NUMBER";
        json["shapes"][1]["centre"] = {"NUMBER", 0, 0};
        std::string text = json.dump();
        for (std::size_t at; (at = text.find("\"NUMBER\"")) != std::string::npos;) text.replace(at, 8, number);
        const ReadResult result = read_scene_text(text, "x.json");
        check(result, number);
        EXPECT_FALSE(result.scene.has_value()) << number;
    }
}

TEST(Robustness, UnprintableIdsMakePrintableMessages) {
    Json json = world();
    json["scene"]["camera"] = "\x1B[31m\n\t";
    json["scene"]["primitives"][0]["material"] = std::string(100'000, 'x');
    json["scene"]["a/b~c\x01"] = 1;
    const ReadResult result = read(json);
    check(result, "ids");
    ASSERT_EQ(result.diagnostics.size(), 3u) << listing(result);
    EXPECT_NE(result.diagnostics[0].message.find("\"\\x1B[31m\\x0A\\x09\""), std::string::npos) << listing(result);
    EXPECT_EQ(result.diagnostics[2].where, "/scene/a~1b~0c\\x01");
}

/// One random edit of a scene's text: a byte, a run removed or doubled, or a token of JSON put in.
std::string edited(std::string text, std::mt19937& random) {
    static constexpr std::string_view tokens[] = {"{",       "}",    "[",        "]",    ",",        ":",
                                                  "\"",      "null", "true",     "-1",   "1e999",    "\"glass\"",
                                                  "\\u0000", "[[",   "{\"id\":", "1e18", "\xC3\xA9", "\xFF"};
    const auto below = [&](std::size_t limit) { return limit == 0 ? 0 : random() % limit; };
    const std::size_t at = below(text.size());
    switch (below(4)) {
        case 0:
            if (!text.empty()) text[at] = static_cast<char>(random() & 0xFF);
            break;
        case 1:
            text.erase(at, below(40));
            break;
        case 2:
            text.insert(at, text.substr(below(text.size()), below(200)));
            break;
        default:
            text.insert(at, tokens[below(std::size(tokens))]);
    }
    return text;
}

TEST(Robustness, EditedScenesAreReadOrRefused) {
    std::vector<std::string> seeds{world().dump()};
    for (const auto& file : scene_files()) {
        std::stringstream text;
        text << std::ifstream(file).rdbuf();
        seeds.push_back(text.str());
    }
    std::mt19937 random(20240229);
    int read_scenes = 0, refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = seeds[random() % seeds.size()];
        for (auto edits = 1 + random() % 3; edits > 0; --edits) text = edited(std::move(text), random);
        const ReadResult result = read_scene_text(text, "x.json");
        check(result, text);
        if (testing::Test::HasFailure()) return;  // one example is enough
        ++(result.scene ? read_scenes : refused);
    }
    EXPECT_GT(read_scenes, 20);
    EXPECT_GT(refused, 1000);
}

/// Replaces a random value anywhere in a tree by one of another kind: passes the grammar, so reaches the reader proper.
TEST(Robustness, ReshapedScenesAreReadOrRefused) {
    const Json original = world();
    const Json flat = original.flatten();
    std::vector<std::string> pointers;
    for (const auto& [pointer, value] : flat.items()) {
        for (Json::json_pointer at(pointer); !at.empty(); at = at.parent_pointer()) pointers.push_back(at.to_string());
    }
    const Json values[] = {nullptr,
                           true,
                           -1,
                           0,
                           1e18,
                           1e-30,
                           "",
                           "glass",
                           "ball",
                           "glow",
                           Json::array(),
                           Json::object(),
                           {1, 2, 3},
                           {{"id", "glass"}},
                           original["scene"],
                           original["shapes"]};
    std::mt19937 random(7);
    int read_scenes = 0, refused = 0;
    for (int i = 0; i < 2000; ++i) {
        Json json = original;
        for (int edits = 0; edits < 2; ++edits) {
            const Json::json_pointer at(pointers[random() % pointers.size()]);
            if (json.contains(at)) json[at] = values[random() % std::size(values)];
        }
        const ReadResult result = read(json);
        check(result, json.dump());
        if (testing::Test::HasFailure()) return;
        ++(result.scene ? read_scenes : refused);
    }
    EXPECT_GT(read_scenes, 20);
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace orrery::test
