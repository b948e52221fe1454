#include "film/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orrery {
namespace {

/// variance / (truth^2 + 0.01) for a truth that is only known as `mean`, with that variance.
///
/// A pixel that was hit by a rare bright sample has a large mean *and* a large variance, and their ratio would hide the
/// error. So the mean is drawn towards the pixels around, as James and Stein do, as far as its own error explains the
/// difference: all the way where that is within two standard errors, hardly at all for one that has an edge beside it
/// and little noise.
double relative_variance(double mean, double variance, double around) {
    const double difference = mean - around;
    const double explained = 4 * variance / (difference * difference);
    const double kept = explained < 1 ? 1 - explained : 0;  // 0 too where nothing differs: the quotient is no number
    const double truth = around + kept * difference;
    return variance / (truth * truth + relative_floor);
}

Rgb64 mean_around_border(const Image& image, std::uint32_t x, std::uint32_t y) {
    Rgb64 sum;
    std::uint32_t count = 0;
    for (std::uint32_t v = y - std::min(y, 1u); v <= std::min(y + 1, image.height - 1); ++v) {
        for (std::uint32_t u = x - std::min(x, 1u); u <= std::min(x + 1, image.width - 1); ++u) {
            if (u == x && v == y) continue;
            const Rgb& pixel = image.at(u, v);
            sum = {sum.r + pixel.r, sum.g + pixel.g, sum.b + pixel.b};
            ++count;
        }
    }
    if (count == 0) return {image.at(x, y).r, image.at(x, y).g, image.at(x, y).b};
    return {sum.r / count, sum.g / count, sum.b / count};
}

}  // namespace

RootMeanSquare SquaredError::root_mean() const {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (!std::isfinite(sum_)) return {unknown, 0, unknown};
    if (sum_ == 0) return {0, 0, 0};
    const double value = std::sqrt(sum_ / static_cast<double>(pixels_));
    constexpr double quantile = 1.96;
    // Half the standard error of the logarithm of the mean square is that of the logarithm of its root.
    const double factor = std::exp(quantile * std::sqrt(2 * squares_) / sum_ / 2);
    return {value, value / factor, value * factor};
}

void ErrorSums::add(const PixelEstimate& pixel, const Rgb64& around) {
    const auto& [mean, variance, degrees] = pixel;
    absolute.add((variance.r + variance.g + variance.b) / 3, degrees);
    relative.add((relative_variance(mean.r, variance.r, around.r) + relative_variance(mean.g, variance.g, around.g) +
                  relative_variance(mean.b, variance.b, around.b)) /
                     3,
                 degrees);
}

void ErrorSums::add(const ErrorSums& other) {
    relative.add(other.relative);
    absolute.add(other.absolute);
}

Rgb64 mean_around(const Image& image, std::uint32_t x, std::uint32_t y) {
    if (x == 0 || y == 0 || x + 1 >= image.width || y + 1 >= image.height) return mean_around_border(image, x, y);
    // Three pixels of a row are nine numbers in a row.
    const auto row = [&](std::uint32_t v) { return &image.at(x - 1, v).r; };
    const float *const above = row(y - 1), *const beside = row(y), *const below = row(y + 1);
    float column[9];
    for (std::size_t i = 0; i < 9; ++i) column[i] = above[i] + below[i];
    const auto mean = [&](std::size_t c) {
        return (double{column[c]} + double{column[c + 3]} + double{column[c + 6]} + double{beside[c]} +
                double{beside[c + 6]}) /
               8;
    };
    return {mean(0), mean(1), mean(2)};
}

Rgb standard_error(const PixelEstimate& pixel) {
    const auto root = [](double variance) { return static_cast<float>(std::sqrt(variance)); };
    return {root(pixel.variance.r), root(pixel.variance.g), root(pixel.variance.b)};
}

}  // namespace orrery
