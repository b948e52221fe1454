// Figures with error bars from the renders of a cell.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "bench/tradeoff/measure.hpp"

namespace orrery::tradeoff {

/// An estimate and its standard error.
struct Figure {
    double value = 0, error = 0;
};

/// MRSE and time of one level.
struct LevelSummary {
    std::uint32_t renders = 0;
    double samples = 0;  ///< per pixel
    Figure mrse;         ///< mean over renders, the reference's own subtracted
    Figure seconds;      ///< of processor time, median over renders
};

struct CellSummary {
    std::vector<LevelSummary> levels = {};
    Figure slope = {};  ///< of log MRSE over log samples; -1 for independent samples. Error infinite below two levels
    /// Mean square of the relative difference between expectation and reference, which no number of samples removes:
    /// what the MRSE tends to.
    Figure floor = {};
};

CellSummary summarise(const Cell& cell, const Reference& reference);

/// Through points (x, y) by their standard errors. Error infinite where all x are equal.
Figure slope_of(const std::vector<double>& x, const std::vector<Figure>& y);

double median(std::vector<double> values);

}  // namespace orrery::tradeoff
