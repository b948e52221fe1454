// Walker's alias method in whole numbers: draws an item by its weight in constant time, and tells the probability with
// which it really does, to the last bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace orrery {

/// Cells are equally likely. A number in [0, 1) beside the cell's decides between the cell's own item (the item of the
/// same index) and one other.
struct AliasTable {
    /// The numbers are taken to be uniform on multiples of 2^-bits, and a share is one: nothing is lost to rounding.
    static constexpr unsigned bits = 24;
    struct Cell {
        std::uint32_t share = 0;  ///< own item below share * 2^-bits, from 0 to 2^bits
        std::uint32_t other = 0;  ///< item of the rest
    };
    std::vector<Cell> cells;          ///< a power of two, at least as many as items
    std::vector<double> probability;  ///< by item; > 0 where the weight is. No rounding in it: they add up to 1 exactly
};

/// Weights are >= 0 and finite, one of them > 0. Throws std::invalid_argument for none or for more than 2^24.
AliasTable alias_table(std::span<const double> weights);

}  // namespace orrery
