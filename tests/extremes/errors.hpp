// The errors of a case, one per trial: the worst of them, what made it, and their distribution.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace orrery::extremes {

class Errors {
public:
    /// `error` >= 0; what is no number counts as infinite. `describe` returns the trial as text.
    template <class Describe>
    void add(double error, const Describe& describe) {
        if (!(error >= 0)) error = std::numeric_limits<double>::infinity();
        ++count_;
        ++bins_[bin_of(error)];
        if (error > worst_ || count_ == 1) {
            worst_ = error;
            culprit_ = describe();
        }
    }
    void add(double error) {
        add(error, [] { return std::string(); });
    }

    std::uint64_t count() const { return count_; }
    double worst() const { return worst_; }
    const std::string& culprit() const { return culprit_; }

    /// What the fraction q of all errors does not exceed, to 2 %: the upper end of a bin of their logarithm.
    double quantile(double q) const {
        const auto wanted = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
        std::uint64_t seen = 0;
        for (std::size_t i = 0; i < bins_.size(); ++i) {
            seen += bins_[i];
            if (seen >= wanted) return i == 0 ? 0 : std::fmin(std::exp2((static_cast<double>(i) / 32) - 64), worst_);
        }
        return worst_;
    }

private:
    /// Bin 0 is zero (and less than 2^-64), the last all beyond 2^64.
    static std::size_t bin_of(double error) {
        if (error < 0x1p-64) return 0;
        return static_cast<std::size_t>(std::fmin(std::floor((std::log2(error) + 64) * 32) + 1, 4096));
    }

    std::array<std::uint64_t, 4097> bins_{};
    std::uint64_t count_ = 0;
    double worst_ = 0;
    std::string culprit_;
};

}  // namespace orrery::extremes
