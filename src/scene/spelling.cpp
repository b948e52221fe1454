#include "scene/spelling.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace orrery {
namespace {

constexpr std::size_t compared_bytes = 64;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    a = a.substr(0, compared_bytes);
    b = b.substr(0, compared_bytes);
    // Optimal string alignment: three rows of the table suffice, row i holding the distances of a[0, i) to b[0, j).
    using Row = std::array<std::size_t, compared_bytes + 1>;
    Row two_above{}, above{}, row{};
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        two_above = above;
        above = row;
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const char x = lower(a[i - 1]), y = lower(b[j - 1]);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (x == y ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && x == lower(b[j - 2]) && lower(a[i - 2]) == y;
            if (swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string_view Spelling::nearest(std::string_view word, std::span<const std::string_view> known) {
    std::string_view best;
    std::size_t best_distance = std::numeric_limits<std::size_t>::max();
    for (const std::string_view candidate : known) {
        const std::size_t work = (std::min(word.size(), compared_bytes) + 1) * (compared_bytes + 1);
        if (work > budget_) return {};
        budget_ -= work;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string_view Spelling::likely(std::string_view word, std::span<const std::string_view> known) {
    const std::string_view best = nearest(word, known);
    return edit_distance(word, best) <= std::max<std::size_t>(1, best.size() / 3) ? best : std::string_view{};
}

}  // namespace orrery
