#include "plan/alias_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace orrery {

namespace {

constexpr std::uint64_t whole = std::uint64_t{1} << AliasTable::bits;  // of a cell

/// Shares of the items, in units of which `units` make all.
std::vector<std::uint64_t> divided(std::span<const double> weights, std::uint64_t units) {
    const double greatest = *std::ranges::max_element(weights);
    double sum = 0;
    for (const double weight : weights) sum += weight / greatest;
    std::vector<std::uint64_t> shares;
    for (const double weight : weights) {
        const auto share = static_cast<std::uint64_t>(weight / greatest / sum * static_cast<double>(units));
        shares.push_back(weight > 0 ? std::max<std::uint64_t>(share, 1) : 0);
    }
    // What rounding left over or took too much, an item each at most, hardly shows in the largest share.
    auto& largest = *std::ranges::max_element(shares);
    largest += units - std::accumulate(shares.begin(), shares.end(), std::uint64_t{0});
    return shares;
}

}  // namespace

AliasTable alias_table(std::span<const double> weights) {
    if (weights.empty() || weights.size() > whole) throw std::invalid_argument("an alias table has 1 to 2^24 items");
    AliasTable table;
    table.cells.resize(std::bit_ceil(weights.size()));
    const std::uint64_t units = table.cells.size() * whole;
    std::vector<std::uint64_t> rest = divided(weights, units);
    for (const std::uint64_t share : rest)
        table.probability.push_back(static_cast<double>(share) / static_cast<double>(units));

    rest.resize(table.cells.size());  // cells of no item
    std::vector<std::uint32_t> small, large;
    for (std::uint32_t i = 0; i < rest.size(); ++i) (rest[i] < whole ? small : large).push_back(i);
    // Every small item fills its cell up from a large one, which may become small by that. In whole numbers the last
    // ones come out even.
    while (!small.empty()) {
        const std::uint32_t cell = small.back(), other = large.back();
        small.pop_back();
        table.cells[cell] = {static_cast<std::uint32_t>(rest[cell]), other};
        rest[other] -= whole - rest[cell];
        if (rest[other] < whole) {
            large.pop_back();
            small.push_back(other);
        }
    }
    for (const std::uint32_t i : large) table.cells[i] = {static_cast<std::uint32_t>(whole), i};
    return table;
}

}  // namespace orrery
