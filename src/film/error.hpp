// How far an image is from the truth, as its own samples tell: MRSE and RMSE with an interval that holds the error of
// this very image, which is a random number, in 95 % of all renders.
#pragma once

#include <cmath>

#include "film/film.hpp"

namespace orrery {

/// The root of a mean square over pixels and channels.
struct RootMeanSquare {
    double value = 0;
    /// Interval that holds it in 95 % of renders or more. `value` and `high` are infinite where nothing tells, as with
    /// one sample per pixel; `high` alone where a few samples carry the estimate, so that others of their kind may have
    /// been missed: the error is `low` at least.
    double low = 0, high = 0;
};

struct ImageError {
    RootMeanSquare relative;  ///< root of MRSE, the mean of (value - truth)^2 / (truth^2 + 0.01)
    RootMeanSquare absolute;  ///< RMSE, in the image's units
};

/// What keeps the relative error of black pixels finite: radiance 0.1, squared.
inline constexpr double relative_floor = 0.01;

/// Sums over pixels of their expected squared error, with the variance of that sum's difference to the squared error
/// really made.
///
/// Let D be the variance of a pixel's mean m, estimated as d from k contrasts. Then (m - truth)^2 - d has expectation 0
/// and variance 2 D^2 (1 + 1/k) for every distribution of samples: the fourth cumulant, which makes both terms vary,
/// cancels, because they see the same rare bright samples. d^2 k / (k + 1) stands for D^2: right for the lightest tails
/// that a difference of two independent numbers can have (kurtosis 2, edges under Sobol's points come near it), too
/// large for all others, the interval being too wide then. Channels of a pixel are taken to err together; pixels are
/// independent, their randomness being keyed by pixel. The interval is symmetric in the logarithm, as that of a ratio
/// of variances is.
///
/// What is relative is relative to a truth that is known no better than the image. Of the error of a pixel whose own
/// relative error is r, the share min(r^2, 1) is in doubt. Where a bright sample in dark surroundings is all that was
/// met of many that there are, the truth is brighter than these, and the error less: that the interval must hold, too;
/// and so it must what blocks of cells have counted in vain at edges.
class SquaredError {
public:
    /// `least`: what the variance may be as well, `doubtful`: the part of it that is in doubt.
    void add(double variance, double least, double doubtful) {
        sum_ += variance;
        squares_ += variance * variance;
        least_ += least;
        doubtful_ += doubtful;
        ++pixels_;
    }
    void add(const SquaredError& other) {
        sum_ += other.sum_;
        squares_ += other.squares_;
        least_ += other.least_;
        doubtful_ += other.doubtful_;
        pixels_ += other.pixels_;
    }

    double sum() const { return sum_; }
    /// Share of the sum, in [0, 1], that is in doubt.
    double doubt() const { return sum_ > 0 && std::isfinite(sum_) ? doubtful_ / sum_ : 0; }
    RootMeanSquare root_mean() const;

private:
    double sum_ = 0;      ///< of d
    double squares_ = 0;  ///< of d^2
    double least_ = 0;
    double doubtful_ = 0;  ///< of the part of d that is in doubt
    std::uint64_t pixels_ = 0;
};

/// What the up to 8 pixels around one show.
struct Surroundings {
    Rgb64 mean;
    Rgb64 variance;           ///< of that mean
    Rgb64 scatter;            ///< variance from pixel to pixel that their errors do not explain, >= 0
    std::uint32_t count = 0;  ///< of pixels whose error is known; 0: the others are 0 too
};

/// `errors`: the standard error of every pixel of the image.
Surroundings surroundings(const Image& image, const Image& errors, std::uint32_t x, std::uint32_t y);

/// Both kinds of error of some pixels, in the order they were added in.
struct ErrorSums {
    SquaredError relative, absolute;

    void add(const PixelEstimate& pixel, const Surroundings& around);
    void add(const ErrorSums& other);
    ImageError error() const { return {relative.root_mean(), absolute.root_mean()}; }
};

/// Standard error of a pixel's mean, by channel.
Rgb standard_error(const PixelEstimate& pixel);

}  // namespace orrery
