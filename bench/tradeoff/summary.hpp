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

/// The ratio of independent estimates.
Figure ratio(const Figure& a, const Figure& b);

/// MRSE and time of one level.
struct LevelSummary {
    std::uint32_t renders = 0;
    double samples = 0;  ///< per pixel
    Figure mrse;         ///< mean over renders, the reference's own subtracted
    Figure seconds;      ///< of processor time, median over renders
    Figure efficiency;   ///< 1 / (MRSE x seconds); 0 where the MRSE is not above the reference's own
};

struct CellSummary {
    std::size_t scene = 0;
    std::string name;
    Variant variant;
    std::vector<LevelSummary> levels = {};
    Figure slope = {};  ///< of log MRSE over log samples; -1 for independent samples. Error infinite below two levels
    /// Mean square of the relative difference between expectation and reference, which no number of samples removes:
    /// what the MRSE tends to.
    Figure floor = {};

    /// What counts: that of the level with most samples, where all variants take about as long.
    const Figure& efficiency() const { return levels.back().efficiency; }
    bool biased() const;      ///< the floor is above zero beyond chance
    bool flattening() const;  ///< the error falls slower than it must
};

CellSummary summarise(const Cell& cell, const Reference& reference);

/// Through points (x, y) by their standard errors. Error infinite where all x are equal.
Figure slope_of(const std::vector<double>& x, const std::vector<Figure>& y);

double median(std::vector<double> values);

/// The mean of the logarithms of ratios as a ratio; its error from theirs.
Figure geometric_mean(const std::vector<Figure>& ratios);

}  // namespace orrery::tradeoff
