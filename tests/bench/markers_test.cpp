#include <gtest/gtest.h>

#include <stdexcept>

#include "bench/report/page.hpp"

namespace orrery::bench {
namespace {

const std::string page = "Prose.\n<!-- begin a -->\nold\n<!-- end a -->\nMore.\n<!-- begin b -->\n<!-- end b -->\n";

TEST(Blocks, ReplaceWhatStandsBetweenTheirMarkersAndNothingElse) {
    EXPECT_EQ(with_blocks(page, {{"a", "new\n"}, {"b", "| 1 |\n"}}),
              "Prose.\n<!-- begin a -->\nnew\n<!-- end a -->\nMore.\n<!-- begin b -->\n| 1 |\n<!-- end b -->\n");
}

TEST(Blocks, AreReplacedAgainWithTheSameResult) {
    const std::map<std::string, std::string> blocks{{"a", "new\n"}, {"b", "two\nlines\n"}};
    EXPECT_EQ(with_blocks(with_blocks(page, blocks), blocks), with_blocks(page, blocks));
}

TEST(Blocks, WithoutAPlaceOrAnEndAreRefused) {
    EXPECT_THROW(with_blocks(page, {{"c", ""}}), std::runtime_error);
    EXPECT_THROW(with_blocks("<!-- begin a -->\n", {{"a", ""}}), std::runtime_error);
    EXPECT_THROW(with_blocks("<!-- end a -->\n<!-- begin a -->\n", {{"a", ""}}), std::runtime_error);
}

}  // namespace
}  // namespace orrery::bench
