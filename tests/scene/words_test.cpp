// Words in messages: edit distance and suggestions.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "scene/report.hpp"
#include "scene/spelling.hpp"

namespace orrery::test {
namespace {

using Words = std::array<std::string_view, 3>;

TEST(SpellingTest, DistanceCountsSlips) {
    EXPECT_EQ(edit_distance("glass", "glass"), 0u);
    EXPECT_EQ(edit_distance("Glass", "glaSS"), 0u);
    EXPECT_EQ(edit_distance("glas", "glass"), 1u);
    EXPECT_EQ(edit_distance("glaass", "glass"), 1u);
    EXPECT_EQ(edit_distance("gloss", "glass"), 1u);
    EXPECT_EQ(edit_distance("galss", "glass"), 1u);
    EXPECT_EQ(edit_distance("aab", "aba"), 1u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
}

TEST(SpellingTest, NearestIsFoundAndLikelyIsPickier) {
    const Words words{"floor", "far wall", "ceiling"};
    Spelling spelling;
    EXPECT_EQ(spelling.nearest("flor", words), "floor");
    EXPECT_EQ(spelling.nearest("cieling", words), "ceiling");
    EXPECT_EQ(spelling.likely("cieling", words), "ceiling");
    EXPECT_EQ(spelling.likely("comment", words), "");
    EXPECT_EQ(spelling.nearest("floor", {}), "");
}

TEST(SpellingTest, OneFaultAmongManyIdsIsWithinTheBudget) {
    std::vector<std::string> ids;
    for (int i = 0; i < 100'000; ++i) ids.push_back("sphere number " + std::to_string(i));
    const std::vector<std::string_view> known(ids.begin(), ids.end());
    EXPECT_EQ(Spelling().nearest("sphere nmuber 98765", known), "sphere number 98765");
}

TEST(SpellingTest, BudgetRunsOut) {
    const Words words{"floor", "far wall", "ceiling"};
    Spelling spelling;
    int answers = 0;
    while (answers < 10'000'000 && !spelling.nearest("flor", words).empty()) ++answers;
    EXPECT_GT(answers, 100'000);
    EXPECT_LT(answers, 10'000'000);
}

TEST(ReportTest, KeepsAThousandOfASeverityAndCountsTheRest) {
    Report report;
    for (int i = 0; i < 1500; ++i) report.add(Severity::warning, "/a", "w" + std::to_string(i));
    EXPECT_FALSE(report.has_errors());
    report.add(Severity::error, "/b", "e");
    EXPECT_TRUE(report.has_errors());
    const auto diagnostics = report.take();
    ASSERT_EQ(diagnostics.size(), 1002u);
    EXPECT_EQ(diagnostics[1000].where, "/b") << "a flood of warnings must not drown an error";
    EXPECT_EQ(diagnostics[1001].message, "500 more warnings not shown");
}

TEST(ReportTest, TellsWarningsInTheSameWordsOnceWithTheirNumber) {
    Report report;
    for (int i = 0; i < 386; ++i) {
        report.add(Severity::warning, "/atoms/" + std::to_string(i), "no mass");
        if (i % 100 == 0) report.add(Severity::warning, "/b", "no charge");
        if (i % 200 == 0) report.add(Severity::error, "/c", "no radius");
    }
    report.add(Severity::warning, "/d", "no name");
    const auto diagnostics = report.take();
    ASSERT_EQ(diagnostics.size(), 5u);
    EXPECT_EQ(diagnostics[0].where, "/atoms/0");
    EXPECT_EQ(diagnostics[0].message, "no mass; 385 more like it");
    EXPECT_EQ(diagnostics[1].message, "no charge; 3 more like it");
    EXPECT_EQ(diagnostics[2].message, "no radius") << "errors have to be mended one by one";
    EXPECT_EQ(diagnostics[3].message, "no radius");
    EXPECT_EQ(diagnostics[4].message, "no name");
}

}  // namespace
}  // namespace orrery::test
