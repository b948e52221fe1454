// The known word nearest to a misspelt one.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace orrery {

/// Of an ASCII letter; any other byte stays as it is.
constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`; letter case is free.
/// Of what follows the common beginning only the first 64 bytes count, which bounds the work.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Finds nearest words within a budget of work. A file of many faults and many ids costs their product, so that
/// without a budget a hostile file of a few megabytes would take minutes. One fault among a hundred thousand ids is
/// well within.
class Spelling {
public:
    /// The word of `known` nearest to `word`, the first of equals. Empty when `known` is empty or the budget is spent.
    std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

    /// As nearest(), but empty unless the two are so alike that a slip of the hand explains the difference.
    std::string_view likely(std::string_view word, std::span<const std::string_view> known);

private:
    std::size_t budget_ = 30'000'000;  ///< in cells of the distance table: a fraction of a second
};

}  // namespace orrery
