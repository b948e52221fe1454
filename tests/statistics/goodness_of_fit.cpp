#include "statistics/goodness_of_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "statistics/distributions.hpp"

namespace orrery::statistics {

GoodnessOfFit chi_square_test(std::span<const std::uint64_t> observed, std::span<const double> expected,
                              double least_expected) {
    if (observed.size() != expected.size()) throw std::invalid_argument("chi_square_test: sizes differ");
    const double counted = static_cast<double>(std::accumulate(observed.begin(), observed.end(), std::uint64_t{0}));
    const double promised = std::accumulate(expected.begin(), expected.end(), 0.0);
    if (!(std::abs(counted - promised) <= 1e-4 * counted)) {
        throw std::invalid_argument("chi_square_test: counted " + std::to_string(counted) + " but expected " +
                                    std::to_string(promised) + " in all");
    }

    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t cell) { return expected[cell]; });

    GoodnessOfFit result;
    double cells = 0, pooled_observed = 0, pooled_expected = 0;
    double last_observed = 0, last_expected = 0;  // the last full cell, in case what follows it stays too small
    const auto add_cell = [&](double o, double e) { result.statistic += (o - e) * (o - e) / e; };
    for (const std::size_t cell : order) {
        if (expected[cell] < 0) throw std::invalid_argument("chi_square_test: a cell expects a negative count");
        if (expected[cell] == 0 && observed[cell] > 0) return {std::numeric_limits<double>::infinity(), cells, 0};
        pooled_observed += static_cast<double>(observed[cell]);
        pooled_expected += expected[cell];
        if (pooled_expected < least_expected || pooled_expected == 0) continue;
        if (cells > 0) add_cell(last_observed, last_expected);
        last_observed = std::exchange(pooled_observed, 0);
        last_expected = std::exchange(pooled_expected, 0);
        ++cells;
    }
    if (cells > 0) add_cell(last_observed + pooled_observed, last_expected + pooled_expected);
    result.degrees = std::max(0.0, cells - 1);
    if (result.degrees > 0) result.p_value = chi_square_upper_tail(result.statistic, result.degrees);
    return result;
}

}  // namespace orrery::statistics
