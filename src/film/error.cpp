#include "film/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orrery {
namespace {

/// An estimate of f = 1 / (truth^2 + 0.01) that is right on average when multiplied by the pixel's variance, which was
/// estimated from the same samples.
///
/// Whoever was hit by a rare bright sample has a large mean *and* a large variance: their ratio would hide the error.
/// Where the samples are too few, on the other hand, f of a mean is too large on average, f being convex. Both to
/// second order, with the mean's variance v and its third cumulant v s:
///     E[v f(mean)] = v (f + f' s + f'' v / 2)
/// so that f(mean) - f' s - f'' v / 2 is right, or 1 / (mean^2 + 0.01 + 3 v mean^2 f - 2 mean s), which stays positive.
/// For bright samples all alike, k of them in a pixel by Poisson's law, the mean being k s, this is
/// 1 / (k (k + 1) s^2 + 0.01), and k / (k (k + 1)) has the expectation 1 / K up to exp(-K), K being that of k. Where
/// there are one or two of them it is too small: half of s^2 less makes up for most of it.
///
/// A pixel with a single bright sample tells nothing: what it should be, the pixels around know, unless they differ
/// among each other by more than chance. So the mean is drawn towards theirs as far as its own error is more than that,
/// as Wiener's filter does, and a part of it is `kept`; it is also left alone where it differs from theirs by more than
/// two standard errors.
double inverse_square(double mean, double variance, double skew, double degrees, double around, double variance_around,
                      double kept) {
    const double left = 1 - kept;
    const double truth = kept * mean + left * around;
    const double square = truth * truth;
    // An estimate's square is on average (k + 2) / k times that of what it estimates.
    const double own = variance * degrees / (degrees + 2);
    const double convexity =
        3 * square / (square + relative_floor) * (kept * kept * own + left * left * variance_around);
    // A sum of samples that are >= 0 has no more than sqrt(v).
    const double step = kept * std::clamp(skew, -std::sqrt(own), std::sqrt(own));
    return 1 / (std::max(0.0, square + convexity - step * (2 * truth + step / 2)) + relative_floor);
}

/// How much of a mean's difference to the pixels around is to be believed, in [0, 1].
double kept_of(double mean, double variance, double around, double variance_around, double scatter) {
    const double difference = mean - around;
    const double signal = std::max(scatter, difference * difference - variance_around - 4 * variance);
    return signal / (signal + variance);
}

/// What the doubt about the truth adds to half of the interval, in the logarithm of the root: measured, over scenes and
/// numbers of samples, against what is left of the estimate's bias (bench/COVERAGE.md).
double systematic(double doubt) { return 0.1 * std::sqrt(doubt) + 0.3 * doubt; }

/// What blocks of cells (contrasts.hpp) leave of the variance that they claim where edges are all the error there is.
constexpr double left_of_edges = 0.81;

/// An upper end of the interval farther away is none: so few samples carry the estimate that it may have missed as
/// much.
constexpr double largest_factor = 2;

}  // namespace

RootMeanSquare SquaredError::root_mean() const {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (!std::isfinite(sum_)) return {unknown, 0, unknown};
    if (sum_ == 0) return {0, 0, 0};
    const double value = std::sqrt(sum_ / static_cast<double>(pixels_));
    constexpr double quantile = 1.96;
    // Half the standard error of the logarithm of the mean square is that of the logarithm of its root. Of squares of
    // normal numbers, n of them, the sum of squares over the squared sum is on average too small by n / (n + 2).
    const double seen = 2 * squares_ / (sum_ * sum_);
    const double relative_variance = seen / std::max(1 - seen / 2, 1e-3);
    const double by_chance = std::exp(quantile * std::sqrt(relative_variance) / 2);
    const double factor = by_chance * std::exp(systematic(doubt()));
    const double least = std::sqrt(least_ / static_cast<double>(pixels_)) / by_chance;
    return {value, std::min(value / factor, least), factor < largest_factor ? value * factor : unknown};
}

void ErrorSums::add(const PixelEstimate& pixel, const Surroundings& around) {
    const Rgb64& variance = pixel.variance;
    const double without_edges = pixel.blocks ? left_of_edges : 1;
    const double mean_variance = (variance.r + variance.g + variance.b) / 3;
    absolute.add(mean_variance, without_edges * mean_variance, 0);
    double sum = 0, least = 0, doubtful = 0;
    for (const double Rgb64::*channel : {&Rgb64::r, &Rgb64::g, &Rgb64::b}) {
        const double v = variance.*channel, mean = pixel.mean.*channel, skew = pixel.skew.*channel;
        const double others = around.mean.*channel, of_others = around.variance.*channel;
        if (v == 0) continue;
        double by_itself = v, error = v;  // not known
        if (std::isfinite(v)) {
            by_itself = v * inverse_square(mean, v, skew, pixel.degrees, 0, 0, 1);
            error = by_itself;
            if (around.count > 0) {
                const double kept = kept_of(mean, v, others, of_others, around.scatter.*channel);
                error = v * inverse_square(mean, v, skew, pixel.degrees, others, of_others, kept);
            }
        }
        sum += error / 3;
        least += without_edges * std::min(by_itself, error) / 3;
        doubtful += error * std::min(error, 1.0) / 3;
    }
    relative.add(sum, least, doubtful);
}

void ErrorSums::add(const ErrorSums& other) {
    relative.add(other.relative);
    absolute.add(other.absolute);
}

Surroundings surroundings(const Image& image, const Image& errors, std::uint32_t x, std::uint32_t y) {
    double sum[3] = {}, squares[3] = {}, noise[3] = {};
    std::uint32_t count = 0;
    const std::uint32_t left = x - std::min(x, 1u), right = std::min(x + 1, image.width - 1);
    for (std::uint32_t v = y - std::min(y, 1u); v <= std::min(y + 1, image.height - 1); ++v) {
        const Rgb *value = &image.at(left, v), *error = &errors.at(left, v);
        for (std::uint32_t u = left; u <= right; ++u, ++value, ++error) {
            if ((u == x && v == y) || !std::isfinite(error->r + error->g + error->b)) continue;
            const double values[3] = {value->r, value->g, value->b}, noises[3] = {error->r, error->g, error->b};
            for (int c = 0; c < 3; ++c) {
                sum[c] += values[c];
                squares[c] += values[c] * values[c];
                noise[c] += noises[c] * noises[c];
            }
            ++count;
        }
    }
    if (count == 0) return {};
    const double part = 1.0 / count, rest = count == 1 ? 0 : 1.0 / (count - 1);
    const auto scatter = [&](int c) {
        return std::max(0.0, (squares[c] - sum[c] * sum[c] * part) * rest - noise[c] * part);
    };
    return {{sum[0] * part, sum[1] * part, sum[2] * part},
            {noise[0] * part * part, noise[1] * part * part, noise[2] * part * part},
            {scatter(0), scatter(1), scatter(2)},
            count};
}

Rgb standard_error(const PixelEstimate& pixel) {
    const auto root = [](double variance) { return static_cast<float>(std::sqrt(variance)); };
    return {root(pixel.variance.r), root(pixel.variance.g), root(pixel.variance.b)};
}

}  // namespace orrery
