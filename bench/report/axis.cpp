#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/report/plot.hpp"

namespace orrery::bench {

namespace {

/// 1, 2, 5, 10, 20, 50, ...: the i-th of them, i = 0 is 1.
double round_number(int i) {
    constexpr double steps[] = {1, 2, 5};
    const int decade = i >= 0 ? i / 3 : (i - 2) / 3;
    return steps[i - 3 * decade] * std::pow(10.0, decade);
}

/// The last of them that is not above value, up to rounding.
int round_index_below(double value) {
    int i = 3 * static_cast<int>(std::floor(std::log10(value)));
    while (round_number(i + 1) <= value * (1 + 1e-9)) ++i;
    while (round_number(i) > value * (1 + 1e-9)) --i;
    return i;
}

}  // namespace

Axis::Axis(double low, double high, bool logarithmic) : logarithmic_(logarithmic), low_(0), high_(high) {
    if (logarithmic) {
        int i = round_index_below(low);
        low_ = round_number(i);
        ticks_.push_back(low_);
        while (ticks_.back() < high * (1 - 1e-9)) ticks_.push_back(round_number(++i));
    } else {
        constexpr double most_steps = 6;
        int i = round_index_below(high / most_steps);
        if (round_number(i) * most_steps < high) ++i;
        const double step = round_number(i);
        for (int n = 0; n == 0 || ticks_.back() < high * (1 - 1e-9); ++n) ticks_.push_back(n * step);
    }
    high_ = ticks_.back();
    if (logarithmic && ticks_.size() == 1) ticks_.push_back(high_ *= 2);
}

double Axis::place(double value) const {
    if (!logarithmic_) return (value - low_) / (high_ - low_);
    return std::log(value / low_) / std::log(high_ / low_);
}

std::string short_number(double value) {
    constexpr struct {
        double unit;
        const char* suffix;
    } scales[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}};
    for (const auto& scale : scales)
        if (std::abs(value) >= scale.unit * 0.9995) return fmt::format("{:.3g}{}", value / scale.unit, scale.suffix);
    return fmt::format("{:.3g}", value);
}

}  // namespace orrery::bench
