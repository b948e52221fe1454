// Pearson's chi-square test of counts against expected counts.
#pragma once

#include <cstdint>
#include <span>

namespace orrery::statistics {

struct GoodnessOfFit {
    double statistic = 0;
    double degrees = 0;  ///< cells after pooling, less one
    double p_value = 1;  ///< probability of a statistic at least as large if the counts follow `expected`
};

/// Compares counts with what a density says they should be (n times its integral over each cell).
/// Cells that expect fewer than `least_expected` are pooled, smallest first: below about 5 the statistic is not yet
/// chi-square distributed. A count in a cell that expects exactly nothing gives p = 0.
/// Throws std::invalid_argument where sizes differ, a cell expects a negative count, or the totals differ by more
/// than one part in 10^4: then the density is not normalised (or the cells miss some of it), and no p-value can be had.
GoodnessOfFit chi_square_test(std::span<const std::uint64_t> observed, std::span<const double> expected,
                              double least_expected = 5);

}  // namespace orrery::statistics
