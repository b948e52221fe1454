// Mean and variance of a stream of numbers, in one pass and without cancellation (Welford).
#pragma once

#include <cstdint>

namespace orrery::statistics {

class RunningMoments {
public:
    void add(double x) {
        ++count_;
        const double before = x - mean_;
        mean_ += before / static_cast<double>(count_);
        squares_ += before * (x - mean_);
    }

    std::uint64_t count() const { return count_; }
    double mean() const { return mean_; }

    /// Unbiased variance of one number; 0 for fewer than two.
    double variance() const { return count_ < 2 ? 0.0 : squares_ / static_cast<double>(count_ - 1); }

    /// Variance of mean(), the square of its standard error.
    double variance_of_mean() const { return count_ == 0 ? 0.0 : variance() / static_cast<double>(count_); }

private:
    std::uint64_t count_ = 0;
    double mean_ = 0;
    double squares_ = 0;  ///< sum of squared deviations from the mean
};

}  // namespace orrery::statistics
