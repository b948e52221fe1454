// The tree our builder makes against the one nlohmann::json makes itself.
#include "scene/json_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/world.hpp"

namespace orrery::test {
namespace {

/// What nlohmann::json makes of it: nothing where it is no JSON, or holds a NUL byte, which it takes for the end.
std::optional<Json> expected(const std::string& text) {
    if (text.find('\0') != text.npos) return std::nullopt;
    Json json = Json::parse(text, nullptr, false);
    return json.is_discarded() ? std::nullopt : std::optional(json);
}

void check(const std::string& text) {
    const std::optional<Json> json = expected(text);
    Report report;
    const JsonTree tree = parse_json(text, report);
    ASSERT_EQ(tree != nullptr, json.has_value()) << text;
    ASSERT_EQ(report.take().empty(), tree != nullptr) << text;
    if (tree) {
        ASSERT_EQ(*tree, *json) << text;
        ASSERT_EQ(tree->dump(), json->dump()) << text;
    }
}

TEST(JsonTextTest, OddTextsReadAsElsewhere) {
    for (const char* text : {"{}",
                             "[]",
                             "[[],{},[{}]]",
                             "\"\"",
                             "0",
                             "-0",
                             "-0.0",
                             "0e9999",
                             "0.0e9999",
                             "1E2",
                             "1e+2",
                             "1.5e-3",
                             "01",
                             "1.",
                             ".5",
                             "+1",
                             "-",
                             "- 1",
                             "1e",
                             "0x10",
                             "9007199254740993",
                             "18446744073709551615",
                             "18446744073709551616",
                             "-9223372036854775808",
                             "-9223372036854775809",
                             "123456789012345678901234567890",
                             "1e308",
                             "1e309",
                             "-1e309",
                             "1e-400",
                             "4.9e-324",
                             "2.2250738585072011e-308",
                             "1.7976931348623157e308",
                             "0.1000000000000000055511151231257827021181583404541015625",
                             "\"\\u00e9\"",
                             "\"\\ud83c\\udf0d\"",
                             "\"\\ud800\"",
                             "\"\\udc00\"",
                             "\"\\ud800\\u0041\"",
                             "\"\\x\"",
                             "\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"",
                             "\"\xC3\xA9\"",
                             "\"\xC0\x80\"",
                             "\"\xED\xA0\x80\"",
                             "\"\xF4\x90\x80\x80\"",
                             "\"\xE2\x82\"",
                             "\"\x7F\"",
                             "\"\t\"",
                             "\xEF\xBB\xBF[1]",
                             "\xEF\xBB[1]",
                             " \t\r\n1 \n",
                             "\f1",
                             "1 2",
                             "[1,]",
                             "[,1]",
                             "{\"a\":1,}",
                             "{\"a\"}",
                             "{a:1}",
                             "{1:2}",
                             "[1 2]",
                             "nul",
                             "nulls",
                             "True",
                             "NaN",
                             "[Infinity]",
                             "/**/1",
                             "'a'",
                             "[",
                             "]",
                             "{",
                             "}",
                             "\"",
                             "\"\\",
                             "\"\\u12",
                             "",
                             " "})
        check(text);
}

TEST(JsonTextTest, ManyMembersAndElementsKeepTheirOrder) {
    std::string list = "[0", object = "{\"k0\":0";
    for (int i = 1; i < 10'000; ++i) {
        list += "," + std::to_string(i);
        object += ",\"k" + std::to_string(i) + "\":{\"k0\":" + std::to_string(i) + "}";
    }
    check(list + "]");
    check(object + "}");
}

/// A key that comes again: each time it is reported at its place, and its last value counts, whatever lies between.
TEST(JsonTextTest, RepeatedKeysAreFound) {
    for (const int others : {0, 3, 500}) {
        std::string text = "[0,[{\"x\":[1,{\"x\":0}],";
        for (int i = 0; i < others; ++i) text += "\"k" + std::to_string(i) + "\":{\"x\":1},";
        text += "\"x\":[2,{\"y\":[],\"y\":3}]}]]";
        Report report;
        const JsonTree tree = parse_json(text, report);
        ASSERT_NE(tree, nullptr);
        EXPECT_EQ(*tree, Json::parse(text)) << others;
        const std::vector<Diagnostic> diagnostics = report.take();
        ASSERT_EQ(diagnostics.size(), 2u) << others;
        EXPECT_EQ(diagnostics[0].where, "/1/0/x");
        EXPECT_EQ(diagnostics[1].where, "/1/0/x/1/y");
    }
}

TEST(JsonTextTest, NestingStopsAtTheLimit) {
    const auto diagnostics = [](std::string text, std::size_t levels) {
        text += std::string(levels, '[') + std::string(levels, ']') + "]}";
        Report report;
        const bool read = parse_json(text, report) != nullptr;
        std::vector<Diagnostic> told = report.take();
        EXPECT_EQ(read, told.empty());
        return told;
    };
    EXPECT_TRUE(diagnostics("{\"a\": [1, ", deepest_nesting - 2).empty());
    const auto told = diagnostics("{\"a\": [1, ", deepest_nesting - 1);
    ASSERT_EQ(told.size(), 1u);
    std::string where = "/a/1";
    for (std::size_t i = 2; i < deepest_nesting; ++i) where += "/0";
    EXPECT_EQ(told[0].where, where);
}

TEST(JsonTextTest, EditedTextsReadAsElsewhere) {
    static constexpr std::string_view tokens[] = {"{",    "}",        "[",     "]",       ",",   ":",   "\"",
                                                  "null", "-1",       "1e999", "\\u00e9", "01",  "1.",  "\\ud800",
                                                  "-0",   "\xC3\xA9", "\xFF",  "\t",      "1e5", "\\n", "\\"};
    const std::string seed = world().dump();
    std::mt19937 random(3);
    int accepted = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string text = seed.substr(0, 1 + random() % 400);
        for (std::size_t at = 0; (at = text.find(',', at)) != text.npos; ++at)
            if (random() % 40 == 0) text.insert(at, tokens[random() % std::size(tokens)]);
        // Closed in the order it was opened, most of what was cut off becomes JSON again.
        std::string open;
        bool quoted = false;
        for (const char c : text) {
            if (c == '"') quoted = !quoted;
            if (!quoted && (c == '[' || c == '{')) open += c == '[' ? ']' : '}';
            if (!quoted && (c == ']' || c == '}') && !open.empty()) open.pop_back();
        }
        if (quoted) text += '"';
        if (text.back() == '"' && open.size() % 2 == 1) text += ":1";
        text.append(open.rbegin(), open.rend());
        accepted += expected(text).has_value();
        check(text);
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(accepted, 300);
    EXPECT_LT(accepted, 3700);
}

}  // namespace
}  // namespace orrery::test
