#include "image/codec.hpp"

#include <gtest/gtest.h>

namespace orrery {
namespace {

TEST(MetadataKey, PassesPrintableAscii) {
    EXPECT_EQ(metadata_key("scene"), "scene");
    EXPECT_EQ(metadata_key("light sampling"), "light sampling");
}

TEST(MetadataKey, ReplacesWhatAFormatCannotHold) {
    EXPECT_EQ(metadata_key("a\nb\tc"), "a_b_c");
    EXPECT_EQ(metadata_key("\xc3\xa9t\xc3\xa9"), "__t__");
    EXPECT_EQ(metadata_key(std::string_view("a\0b", 3)), "a_b");
    EXPECT_EQ(metadata_key("  key "), "key");
    EXPECT_EQ(metadata_key(""), "Comment");
    EXPECT_EQ(metadata_key("   "), "Comment");
    EXPECT_EQ(metadata_key(std::string(200, 'k')), std::string(79, 'k'));
}

TEST(MetadataValue, StaysOnOneLine) {
    EXPECT_EQ(metadata_value("one\ntwo\r\nthree"), "one two  three");
    EXPECT_EQ(metadata_value(std::string_view("a\0b\x7f", 4)), "a b ");
    EXPECT_EQ(metadata_value(""), "");
}

TEST(MetadataValue, KeepsUtf8) {
    EXPECT_EQ(metadata_value("sc\xc3\xa8ne"), "sc\xc3\xa8ne");
    EXPECT_FALSE(is_ascii("sc\xc3\xa8ne"));
    EXPECT_TRUE(is_ascii("scene"));
}

}  // namespace
}  // namespace orrery
