// Do samples follow their density? Histograms judged by chi-square, at one significance for the whole folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "statistics/goodness_of_fit.hpp"

namespace orrery::kernel_tests {

/// Chance that any test of this folder fails although all kernels are right, over another choice of seeds. The seeds
/// are fixed, so in practice a test that passed once passes always.
inline constexpr double family_alpha = 1e-4;
/// No fewer than the p-values this folder looks at (Bonferroni). Raise it when adding hundreds.
inline constexpr double family_size = 1000;
inline constexpr double significance = family_alpha / family_size;

/// Counts over a rectangle of cells; coordinates in [0, 1], what lies outside is counted as escaped.
class Histogram {
public:
    Histogram(std::size_t columns, std::size_t rows) : columns_(columns), rows_(rows), counts_(columns * rows) {}
    void add(double x, double y) {
        if (!(x >= -rounding && x <= 1 + rounding && y >= -rounding && y <= 1 + rounding)) return void(++escaped_);
        const auto cell = [](double v, std::size_t n) {
            return std::min(static_cast<std::size_t>(std::max(v, 0.0) * static_cast<double>(n)), n - 1);
        };
        ++counts_[cell(y, rows_) * columns_ + cell(x, columns_)];
    }
    std::size_t columns() const { return columns_; }
    std::size_t rows() const { return rows_; }

    /// `expected`: what each cell's share of the density is, row by row, 1 in all.
    void expect_fits(std::vector<double> expected, const std::string& what) const {
        double total = 0;
        for (const std::uint64_t count : counts_) total += static_cast<double>(count);
        for (double& share : expected) share *= total;
        EXPECT_EQ(escaped_, 0u) << what << ": samples outside the density's support";
        const auto fit = statistics::chi_square_test(counts_, expected, 25);
        EXPECT_GT(fit.degrees, 8) << what;
        EXPECT_GT(fit.p_value, significance)
            << what << ": chi-square " << fit.statistic << " at " << fit.degrees << " degrees of freedom";
    }
    void expect_uniform(const std::string& what) const {
        expect_fits(std::vector<double>(counts_.size(), 1.0 / static_cast<double>(counts_.size())), what);
    }

private:
    static constexpr double rounding = 1e-5;  // a coordinate computed from float
                                              // directions may pass an end by that
    std::size_t columns_, rows_;
    std::vector<std::uint64_t> counts_;
    std::uint64_t escaped_ = 0;
};

}  // namespace orrery::kernel_tests
