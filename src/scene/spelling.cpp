#include "scene/spelling.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace orrery {
namespace {

constexpr std::size_t compared_bytes = 64;

/// edit_distance(), or some number >= `bound` as soon as the distance cannot be less. Adds the cells it filled to
/// `work`.
std::size_t bounded_distance(std::string_view a, std::string_view b, std::size_t bound, std::size_t& work) {
    // A common beginning ("sphere number ...") changes no distance, and real ids are full of them.
    while (!a.empty() && !b.empty() && lower(a[0]) == lower(b[0])) {
        a.remove_prefix(1);
        b.remove_prefix(1);
    }
    a = a.substr(0, compared_bytes);
    b = b.substr(0, compared_bytes);
    ++work;
    const std::size_t at_least = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
    if (at_least >= bound) return at_least;

    // Optimal string alignment: three rows of the table suffice, row i holding the distances of a[0, i) to b[0, j).
    std::array<std::array<std::size_t, compared_bytes + 1>, 3> rows;
    for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
    std::size_t least_above = 0;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        const auto& above = rows[(i + 2) % 3];
        const auto& two_above = rows[(i + 1) % 3];
        auto& row = rows[i % 3];
        std::size_t least = row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const char x = lower(a[i - 1]), y = lower(b[j - 1]);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (x == y ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && x == lower(b[j - 2]) && lower(a[i - 2]) == y;
            if (swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
            least = std::min(least, row[j]);
        }
        work += b.size() + 1;
        // Every later row builds on the last two.
        if (std::min(least, least_above) >= bound) return bound;
        least_above = least;
    }
    return rows[a.size() % 3][b.size()];
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::size_t work = 0;
    return bounded_distance(a, b, std::numeric_limits<std::size_t>::max(), work);
}

std::string_view Spelling::nearest(std::string_view word, std::span<const std::string_view> known) {
    std::string_view best;
    std::size_t best_distance = std::numeric_limits<std::size_t>::max();
    for (const std::string_view candidate : known) {
        std::size_t work = 0;
        const std::size_t distance = bounded_distance(word, candidate, best_distance, work);
        if (work > budget_) return {};
        budget_ -= work;
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
