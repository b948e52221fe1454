// How far an image is from the truth, as its own samples tell: MRSE and RMSE with an interval that holds the error of
// this very image, which is a random number, in 95 % of all renders.
#pragma once

#include "film/film.hpp"

namespace orrery {

/// The root of a mean square over pixels and channels.
struct RootMeanSquare {
    double value = 0;
    double low = 0, high = 0;  ///< 95 % interval; infinite where nothing tells, as with one sample per pixel
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
/// cancels, because they see the same rare bright samples. d^2 k / (k + 2) stands for D^2; heavy tails make that too
/// large and the interval too wide. Channels of a pixel are taken to err together; pixels are independent, their
/// randomness being keyed by pixel. The interval is symmetric in the logarithm, as that of a ratio of variances is.
class SquaredError {
public:
    void add(double variance, double contrasts) {
        sum_ += variance;
        squares_ += variance * variance * (contrasts + 1) / (contrasts + 2);
        ++pixels_;
    }
    void add(const SquaredError& other) {
        sum_ += other.sum_;
        squares_ += other.squares_;
        pixels_ += other.pixels_;
    }

    double sum() const { return sum_; }
    RootMeanSquare root_mean() const;

private:
    double sum_ = 0;      ///< of d
    double squares_ = 0;  ///< of d^2 (k + 1) / (k + 2)
    std::uint64_t pixels_ = 0;
};

/// Both kinds of error of some pixels, in the order they were added in.
struct ErrorSums {
    SquaredError relative, absolute;

    /// `around`: the mean of the pixels around it.
    void add(const PixelEstimate& pixel, const Rgb64& around);
    void add(const ErrorSums& other);
    ImageError error() const { return {relative.root_mean(), absolute.root_mean()}; }
};

/// Mean of the up to 8 pixels around one; of an image of one pixel, that.
Rgb64 mean_around(const Image& image, std::uint32_t x, std::uint32_t y);

/// Standard error of a pixel's mean, by channel.
Rgb standard_error(const PixelEstimate& pixel);

}  // namespace orrery
