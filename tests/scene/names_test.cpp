// Strings by number, and the hash and the table below.
#include "scene/names.hpp"

#include <gtest/gtest.h>

#include <string>

#include "scene/keyed_hash.hpp"

namespace orrery::test {
namespace {

// CPython hashes strings of bytes by SipHash-1-3, with a key of zeros under PYTHONHASHSEED=0:
//   PYTHONHASHSEED=0 python3 -c 'print(hash(b"sphere") % 2**64)'
TEST(Siphash, IsPythons) {
    EXPECT_EQ(siphash("a", {}), 0x407448d2b89b1813);
    EXPECT_EQ(siphash("sphere", {}), 0xb2690196de52b050);
    EXPECT_EQ(siphash("abcdefg", {}), 0x6db12aae9070f506);
    EXPECT_EQ(siphash("abcdefgh", {}), 0x3f7b849c0b8e35ea);
    EXPECT_EQ(siphash("abcdefghi", {}), 0xf89b34a3d11eb6e5);
    EXPECT_EQ(siphash("the quick brown fox jumps over it", {}), 0xcf8ba914bf7aefa2);
}

TEST(Siphash, DependsOnAllOfTheKey) {
    EXPECT_NE(siphash("sphere", {0, 0}), siphash("sphere", {1, 0}));
    EXPECT_NE(siphash("sphere", {0, 0}), siphash("sphere", {0, 1}));
    EXPECT_EQ(keyed_hash("sphere"), keyed_hash(std::string("sphere")));
}

TEST(HashIndexTest, TellsItemsOfOneHashApart) {
    HashIndex index;
    const auto enter = [&](std::uint32_t item) {
        return index.find_or_insert(42, item, [&](std::uint32_t other) { return other == item; });
    };
    for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(enter(i), i);
    for (std::uint32_t i = 0; i < 1000; ++i)
        EXPECT_EQ(index.find_or_insert(42, 5000, [&](std::uint32_t other) { return other == i; }), i);
}

TEST(HashIndexTest, ComparesOnlyWhatHashesAlike) {
    HashIndex index;
    const auto never = [](std::uint32_t) {
        ADD_FAILURE() << "compared";
        return false;
    };
    // All begin their search in one slot.
    for (std::uint32_t i = 0; i < 40; ++i) EXPECT_EQ(index.find_or_insert(std::uint64_t{i} << 20, i, never), i);
}

TEST(NamesTest, NumberEveryDistinctStringOnce) {
    Names names;
    for (const int round : {0, 1}) {
        for (std::uint32_t i = 0; i < 20'000; ++i)
            ASSERT_EQ(names.number("s" + std::to_string(i)), Name{i}) << "round " << round;
        ASSERT_EQ(names.size(), 20'000u);
    }
    for (std::uint32_t i = 0; i < 20'000; ++i) ASSERT_EQ(names.text(Name{i}), "s" + std::to_string(i));
}

TEST(NamesTest, HoldStringsOfAnyLengthAndContent) {
    Names names;
    const std::string texts[] = {"",  std::string("\0", 1),   std::string("a\0b", 3), std::string(1'000'000, 'x'),
                                 "a", std::string(65536, 'y')};
    for (const std::string& text : texts) names.number(text);
    EXPECT_EQ(names.size(), std::size(texts));
    for (const std::string& text : texts) EXPECT_EQ(names.text(names.number(text)), text);
}

TEST(NameMapTest, KeepsTheFirstPlace) {
    NameMap map;
    EXPECT_EQ(map.find(Name{7}), std::nullopt);
    EXPECT_TRUE(map.insert(Name{7}, 0));
    EXPECT_FALSE(map.insert(Name{7}, 1));
    EXPECT_EQ(map.find(Name{7}), 0u);
    EXPECT_EQ(map.find(Name{6}), std::nullopt);
    EXPECT_EQ(map.find(Name{8}), std::nullopt);
}

TEST(NameSetTest, Remembers) {
    NameSet set;
    EXPECT_FALSE(set.contains(Name{70}));
    EXPECT_TRUE(set.insert(Name{70}));
    EXPECT_FALSE(set.insert(Name{70}));
    EXPECT_TRUE(set.contains(Name{70}));
    EXPECT_FALSE(set.contains(Name{69}));
    EXPECT_FALSE(set.contains(Name{1000}));
}

}  // namespace
}  // namespace orrery::test
