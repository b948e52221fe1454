// What is no JSON: line, column, wording; and what JSON allows but a scene does not.
#include <gtest/gtest.h>

#include <ostream>

#include "scene/world.hpp"

namespace orrery::test {
namespace {

struct Syntax {
    std::string name;
    std::string text;
    std::string where;
    std::string says;
};

void PrintTo(const Syntax& syntax, std::ostream* stream) { *stream << syntax.name; }

class SyntaxTest : public testing::TestWithParam<Syntax> {};

TEST_P(SyntaxTest, IsReportedAtLineAndColumn) {
    const ReadResult result = read_scene_text(GetParam().text, "x.json");
    ASSERT_EQ(result.diagnostics.size(), 1u) << listing(result);
    EXPECT_EQ(result.diagnostics[0].severity, Severity::error);
    EXPECT_EQ(result.diagnostics[0].where, GetParam().where) << listing(result);
    EXPECT_NE(result.diagnostics[0].message.find(GetParam().says), std::string::npos) << listing(result);
    EXPECT_FALSE(result.scene.has_value());
}

INSTANTIATE_TEST_SUITE_P(Table, SyntaxTest,
                         testing::Values(Syntax{"empty", "", "1:1", "expected a scene in JSON"},
                                         Syntax{"blank_lines", "\n\n  ", "3:3", "expected a scene in JSON"},
                                         Syntax{"missing_colon", "{\n  \"cameras\" []\n}", "2:13", "expected ':'"},
                                         Syntax{"columns_count_characters", "{\"\xC3\xA9\xC3\xA9\" 1}", "1:7",
                                                "expected ':'"},
                                         Syntax{"trailing_comma", "{\"a\": [1,\n]}", "2:1", "unexpected ']'"},
                                         Syntax{"unclosed", "{\"a\": [1, 2", "1:12", "unexpected end of input"},
                                         Syntax{"text_behind", "{} x", "1:4", "expected end of input"},
                                         Syntax{"not_a_number", "{\"a\": NaN}", "1:7", "invalid literal"},
                                         Syntax{"infinity", "[-Infinity]", "1:3", "invalid number"},
                                         Syntax{"beyond_double", "{\"a\": 1e400}", "1:11",
                                                "found 1e400, expected a number that fits a double"},
                                         Syntax{"comment", "// no\n{}", "1:1", "invalid literal"},
                                         Syntax{"invalid_utf8", "{\"\xFF\": 1}", "1:3", "ill-formed UTF-8"},
                                         Syntax{"lone_surrogate", "[\"\\ud800\"]", "1:9", "surrogate"},
                                         Syntax{"control_character", "[\"a\nb\"]", "1:4", "control character"},
                                         Syntax{"utf16", std::string("\xFF\xFE{\0}\0", 6), "1:4", "found a NUL byte"},
                                         Syntax{"nul_behind", std::string("{}\0", 3), "1:3", "found a NUL byte"}),
                         [](const testing::TestParamInfo<Syntax>& test) { return test.param.name; });

TEST(SyntaxTest, ByteOrderMarkIsSkipped) {
    const ReadResult result = read_scene_text("\xEF\xBB\xBF" + world().dump(), "x.json");
    EXPECT_TRUE(result.scene.has_value()) << listing(result);
    EXPECT_TRUE(result.diagnostics.empty()) << listing(result);
}

TEST(SyntaxTest, SchemaKeyIsAccepted) {
    Json json = world();
    json["$schema"] = "scene.schema.json";
    const ReadResult result = read(json);
    EXPECT_TRUE(result.diagnostics.empty()) << listing(result);
}

TEST(SyntaxTest, RepeatedKeysAreErrorsAndReadingGoesOn) {
    std::string text = world().dump();
    text.replace(text.find("\"fov\":"), 6, "\"fov\":1,\"fov\":");
    text.replace(text.find("\"samples\":16"), 12, "\"samples\":16,\"samples\":0");
    const ReadResult result = read_scene_text(text, "x.json");
    ASSERT_EQ(result.diagnostics.size(), 3u) << listing(result);
    EXPECT_EQ(result.diagnostics[0].where, "/cameras/0/fov");
    EXPECT_NE(result.diagnostics[0].message.find("a second time"), std::string::npos);
    EXPECT_EQ(result.diagnostics[1].where, "/scene/renderer/samples");
    EXPECT_NE(result.diagnostics[2].message.find("found 0"), std::string::npos) << "the last value is the one read on";
    EXPECT_FALSE(result.scene.has_value());
}

TEST(SyntaxTest, RootOfAnotherKindIsOneFault) {
    for (const char* text : {"[]", "5", "null", "\"scene\"", "1.5e3", "true"}) {
        const ReadResult result = read_scene_text(text, "x.json");
        ASSERT_EQ(result.diagnostics.size(), 1u) << text << listing(result);
        EXPECT_EQ(result.diagnostics[0].where, "");
        EXPECT_NE(result.diagnostics[0].message.find("expected an object with the keys"), std::string::npos);
    }
}

}  // namespace
}  // namespace orrery::test
