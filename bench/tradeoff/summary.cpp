#include "bench/tradeoff/summary.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace orrery::tradeoff {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Figure mean(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    const double m = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (const double value : values) squares += (value - m) * (value - m);
    return {m, values.size() > 1 ? std::sqrt(squares / (n - 1) / n) : infinity};
}

/// The median, with the error it has for a normal distribution as wide as the median deviation says.
Figure robust(const std::vector<double>& values) {
    const double middle = median(values);
    std::vector<double> deviations;
    for (const double value : values) deviations.push_back(std::abs(value - middle));
    return {middle, 1.4826 * 1.2533 * median(deviations) / std::sqrt(static_cast<double>(values.size()))};
}

LevelSummary summary_of(const Level& level, const Reference& reference) {
    LevelSummary summary;
    summary.renders = static_cast<std::uint32_t>(level.mrse.size());
    summary.samples = level.samples;
    summary.mrse = mean(level.mrse);
    summary.mrse.value -= reference.mrse;
    summary.mrse.error = std::hypot(summary.mrse.error, reference.mrse_error);
    summary.seconds = robust(level.seconds);
    return summary;
}

/// Products of the differences of distinct renders have the squared bias for expectation, and what the reference, which
/// all share, is wrong by. The error is that of an unbiased pixel: 2 v^2 / (n (n - 1)) is the variance of its mean
/// product, v that of a render; channels are taken to err together. What render and reference err together is
/// 4 v w / n, w the reference's variance: no more than the two by themselves, hence the factor 2.
Figure floor_of(const Level& level, const Reference& reference) {
    const double n = static_cast<double>(level.mrse.size());
    if (n < 2) return {0, infinity};
    double products = 0, variance = 0;
    for (std::size_t i = 0; i < level.differences.size(); i += 3) {
        double v = 0;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double d = level.differences[c], s = level.squares[c];
            products += (d * d - s) / (n * (n - 1)) / 3;
            v += (s - d * d / n) / (n - 1) / 3;
        }
        variance += 2 * v * v / (n * (n - 1));
    }
    const double pixels = static_cast<double>(level.differences.size()) / 3;
    return {products / pixels - reference.mrse,
            std::sqrt(2 * (variance / pixels / pixels + reference.mrse_error * reference.mrse_error))};
}

Figure slope_of(const std::vector<LevelSummary>& levels) {
    std::vector<double> x;
    std::vector<Figure> y;
    for (const LevelSummary& level : levels) {
        if (!(level.mrse.value > 0)) continue;
        x.push_back(std::log(level.samples));
        y.push_back({std::log(level.mrse.value), level.mrse.error / level.mrse.value});
    }
    return slope_of(x, y);
}

}  // namespace

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

Figure slope_of(const std::vector<double>& x, const std::vector<Figure>& y) {
    double weights = 0, mean_x = 0;
    std::vector<double> w;
    for (std::size_t i = 0; i < x.size(); ++i) {
        // Seeds that agree by luck must not outweigh all others.
        w.push_back(1 / (y[i].error * y[i].error + 1e-6));
        weights += w[i];
        mean_x += w[i] * x[i];
    }
    mean_x /= weights;
    double xx = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += w[i] * (x[i] - mean_x) * (x[i] - mean_x);
        xy += w[i] * (x[i] - mean_x) * y[i].value;
    }
    if (!(xx > 0)) return {0, infinity};
    return {xy / xx, 1 / std::sqrt(xx)};
}

CellSummary summarise(const Cell& cell, const Reference& reference) {
    CellSummary summary;
    for (const Level& level : cell.levels) summary.levels.push_back(summary_of(level, reference));
    summary.slope = slope_of(summary.levels);
    summary.floor = floor_of(cell.levels.back(), reference);
    return summary;
}

}  // namespace orrery::tradeoff
