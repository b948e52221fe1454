// Plots as SVG: readable on light and dark pages, no script, no font but the reader's.
#pragma once

#include <string>
#include <vector>

namespace orrery::bench {

/// One line of a plot.
struct Series {
    std::string name;
    std::vector<std::pair<double, double>> points;  ///< (x, y), both > 0
    bool dashed = false;
    std::size_t colour = 0;  ///< of a palette of eight
};

/// Lines over logarithmic axes.
struct LinePlot {
    std::string title, x_label, y_label;
    std::vector<Series> series;
};
std::string svg_of(const LinePlot& plot);

/// Groups of bars, one bar of each series per group; values <= 0 are left out.
struct BarPlot {
    std::string title, y_label;
    std::vector<std::string> series;
    std::vector<std::string> groups;
    std::vector<std::vector<double>> values;  ///< [group][series]
    bool logarithmic = false;
};
std::string svg_of(const BarPlot& plot);

/// An axis: a value's place on it, in [0, 1], and where to write numbers.
class Axis {
public:
    /// Covers [low, high] up to round numbers: powers of ten split at 2 and 5 when logarithmic, else from 0 in steps of
    /// 1, 2 or 5 times a power of ten. Needs 0 < high, and 0 < low when logarithmic.
    Axis(double low, double high, bool logarithmic);
    double place(double value) const;
    const std::vector<double>& ticks() const { return ticks_; }

private:
    bool logarithmic_;
    double low_, high_;
    std::vector<double> ticks_;
};

/// 1500000 -> "1.5M", 65536 -> "65.5k", 0.25 -> "0.25".
std::string short_number(double value);

}  // namespace orrery::bench
