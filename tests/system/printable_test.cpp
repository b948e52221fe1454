// Text made safe to print.
#include "system/printable.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <ios>
#include <set>

namespace orrery {
namespace {

TEST(Printable, EscapesWhatATerminalShouldNotSee) {
    EXPECT_EQ(printable("grey \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8C\x8D"), "grey \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8C\x8D");
    EXPECT_EQ(printable("a\x1B[2Jb\n"), "a\\x1B[2Jb\\x0A");
    EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
    EXPECT_EQ(printable("\xC2\x9B"), "\\xC2\\x9B") << "a C1 control character";
    EXPECT_EQ(printable("\xC0\xAF"), "\\xC0\\xAF") << "overlong";
    EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80") << "surrogate";
    EXPECT_EQ(printable("\xE2\x82"), "\\xE2\\x82") << "cut short";
    EXPECT_EQ(printable("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80") << "past U+10FFFF";
    EXPECT_EQ(printable("\x7F"), "\\x7F");
}

std::string utf8(std::uint32_t c) {
    const auto tail = [&](int shift) { return static_cast<char>(0x80u | (c >> shift & 0x3Fu)); };
    if (c < 0x800) return {static_cast<char>(0xC0u | c >> 6), tail(0)};
    return {static_cast<char>(0xE0u | c >> 12), tail(6), tail(0)};
}

// The list of the Unicode standard: Bidi_Control, and the separators of lines and paragraphs.
TEST(Printable, EscapesWhatReordersOrBreaksLines) {
    const std::set<std::uint32_t> stirring = {0x61C,  0x200E, 0x200F, 0x2028, 0x2029, 0x202A, 0x202B,
                                              0x202C, 0x202D, 0x202E, 0x2066, 0x2067, 0x2068, 0x2069};
    for (std::uint32_t c = 0x80; c < 0xD800; ++c) {
        const bool escaped = c < 0xA0 || stirring.contains(c);
        EXPECT_EQ(printable(utf8(c)) != utf8(c), escaped) << std::hex << c;
        EXPECT_EQ(is_printable("a" + utf8(c) + "b"), !escaped) << std::hex << c;
    }
    EXPECT_EQ(printable("\xE2\x80\xAE"
                        "evil"),
              "\\xE2\\x80\\xAE"
              "evil");
}

// What is escaped is not escaped again: messages may be made safe where they are made and where they are printed.
TEST(Printable, LeavesWhatIsPrintable) {
    for (const char* text : {"", "a\x1B[2Jb\r\n", "\xE2\x80\xA8", "\xFF\xFE", "\\x1B", "\xC3\xA9"}) {
        EXPECT_TRUE(is_printable(printable(text)));
        EXPECT_EQ(printable(printable(text)), printable(text));
    }
    EXPECT_FALSE(is_printable("a\n"));
    EXPECT_EQ(printable_whole(std::string(1000, 'x')), std::string(1000, 'x'));
}

TEST(Printable, ShortensInTheMiddleBetweenCharacters) {
    EXPECT_EQ(printable("abcdefghijkl", 6), "abcd...kl");
    EXPECT_EQ(printable("abcdef", 6), "abcdef");
    // Neither cut may fall into the two-byte character.
    EXPECT_EQ(printable("abc\xC3\xA9xxxxxx\xC3\xA9z", 6), "abc...z");
}

}  // namespace
}  // namespace orrery
