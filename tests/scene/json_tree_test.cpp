// The quick parser and the tree against nlohmann::json, which shares neither.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "scene/json_text.hpp"
#include "scene/json_tree_builder.hpp"
#include "scene/quick_json.hpp"
#include "scene/world.hpp"

namespace orrery::test {
namespace {

Json as_json(const JsonTree& tree, const JsonValue& value) {
    switch (value.kind) {
        case JsonKind::null:
            return nullptr;
        case JsonKind::boolean:
            return value.bits != 0;
        case JsonKind::negative:
            return static_cast<std::int64_t>(value.bits);
        case JsonKind::natural:
            return value.bits;
        case JsonKind::real:
            return value.number();
        case JsonKind::text:
            return std::string(tree.names().text(value.name()));
        case JsonKind::list: {
            Json list = Json::array();
            for (std::size_t i = 0; i < value.size; ++i) list.push_back(as_json(tree, tree.child(value, i)));
            return list;
        }
        case JsonKind::object:
            break;
    }
    Json object = Json::object();
    for (std::size_t i = 0; i < value.size; ++i) {
        const JsonValue& member = tree.child(value, i);
        object[std::string(tree.names().text(member.key_name()))] = as_json(tree, member);
    }
    return object;
}

/// What nlohmann::json makes of it: nothing where it is no JSON, or holds a NUL byte, which it takes for the end.
std::optional<Json> expected(const std::string& text) {
    if (text.find('\0') != text.npos) return std::nullopt;
    Json json = Json::parse(text, nullptr, false);
    return json.is_discarded() ? std::nullopt : std::optional(json);
}

/// Both parsers of ours against that.
void check(const std::string& text) {
    const std::optional<Json> json = expected(text);
    Report report;
    const std::optional<JsonTree> tree = parse_json(text, report);
    ASSERT_EQ(tree.has_value(), json.has_value()) << text;
    if (tree) {
        ASSERT_EQ(as_json(*tree, tree->root()), *json) << text;
    }
    if (const std::optional<JsonTree> quick = parse_quickly(text)) {
        ASSERT_TRUE(json.has_value()) << "the quick parser takes what is no JSON: " << text;
        ASSERT_EQ(as_json(*quick, quick->root()), *json) << text;
    }
}

TEST(JsonTreeTest, OddTextsReadAsElsewhere) {
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

/// Every digit of a double has to arrive: random bit patterns in as many digits as some writers use.
TEST(JsonTreeTest, NumbersArriveToTheLastBit) {
    std::mt19937_64 random(11);
    for (int i = 0; i < 20'000; ++i) {
        double value = std::bit_cast<double>(random());
        if (!std::isfinite(value)) continue;
        char text[64];
        std::snprintf(text, sizeof text, "%.*g", static_cast<int>(6 + random() % 16), value);
        const std::optional<JsonTree> tree = parse_quickly(text);
        if (!std::isfinite(std::strtod(text, nullptr))) continue;  // rounded up beyond the largest
        ASSERT_TRUE(tree.has_value()) << text;
        ASSERT_EQ(tree->root().number(), std::strtod(text, nullptr)) << text;
    }
}

TEST(JsonTreeTest, ManyMembersAndElementsKeepTheirOrder) {
    std::string list = "[0", object = "{\"k0\":0";
    for (int i = 1; i < 10'000; ++i) {
        list += "," + std::to_string(i);
        object += ",\"k" + std::to_string(i) + "\":{\"k0\":" + std::to_string(i) + "}";
    }
    check(list + "]");
    check(object + "}");
    const JsonTree tree = *parse_quickly(list + "]");
    for (std::size_t i = 0; i < 10'000; ++i) ASSERT_EQ(tree.child(tree.root(), i).bits, i);
}

/// A key that comes again: each time it is reported, and its last value counts, whatever lies between.
TEST(JsonTreeTest, RepeatedKeysAreFoundInSmallAndLargeObjects) {
    for (const int others : {0, 3, 14, 15, 16, 17, 500}) {
        std::string text = "{\"x\":[1,{\"x\":0}],";
        for (int i = 0; i < others; ++i) text += "\"k" + std::to_string(i) + "\":{\"x\":1},";
        text += "\"x\":[2,[3]]}";
        EXPECT_FALSE(parse_quickly(text).has_value()) << others;
        Report report;
        const std::optional<JsonTree> tree = parse_json(text, report);
        ASSERT_TRUE(tree.has_value());
        EXPECT_EQ(as_json(*tree, tree->root()), Json::parse(text)) << others;
        const std::vector<Diagnostic> diagnostics = report.take();
        ASSERT_EQ(diagnostics.size(), 1u) << others;
        EXPECT_EQ(diagnostics[0].where, "/x");
    }
}

TEST(JsonTreeTest, NestingStopsAtTheLimit) {
    const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
    EXPECT_TRUE(parse_quickly(nested(deepest_nesting)).has_value());
    EXPECT_FALSE(parse_quickly(nested(deepest_nesting + 1)).has_value());
}

TEST(JsonTreeTest, EditedTextsReadAsElsewhere) {
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
