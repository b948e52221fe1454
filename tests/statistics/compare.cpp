#include "statistics/compare.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "statistics/distributions.hpp"

namespace orrery::statistics {
namespace {

constexpr std::array<const char*, 3> channel_names = {"red", "green", "blue"};

void describe(std::ostream& out, const Estimate& candidate, const Estimate& reference, const Score& score) {
    out << candidate.mean << " +- " << candidate.standard_error() << ", reference " << reference.mean << " +- "
        << reference.standard_error() << " (" << 100 * score.difference / reference.mean << " %), z " << score.z;
}

std::string describe(const Comparison& result, const BlockImage& candidate, const BlockImage& reference) {
    std::ostringstream out;
    out << (result.agrees ? "agrees" : "differs") << " with the reference at |z| <= " << result.threshold << " over "
        << candidate.width() << " x " << candidate.height() << " blocks of " << candidate.block_size
        << " pixels\n  worst block (" << result.worst_x << ", " << result.worst_y << ") "
        << channel_names[result.worst_channel] << ": ";
    describe(out, candidate.at(result.worst_x, result.worst_y)[result.worst_channel],
             reference.at(result.worst_x, result.worst_y)[result.worst_channel], result.worst);
    const RgbEstimate candidate_mean = candidate.mean(), reference_mean = reference.mean();
    for (std::size_t channel = 0; channel < 3; ++channel) {
        out << "\n  mean " << channel_names[channel] << ": ";
        describe(out, candidate_mean[channel], reference_mean[channel], result.global[channel]);
    }
    return out.str();
}

}  // namespace

Score score(const Estimate& candidate, const Estimate& reference, double rounding) {
    const double variance = candidate.variance + reference.variance;
    Score result{candidate.mean - reference.mean, std::sqrt(variance), 0};
    const double excess = std::abs(result.difference) - rounding * std::abs(reference.mean);
    if (excess <= 0) return result;
    // Without variance, and for a candidate that is not finite, there is no chance that could explain a difference.
    double t = std::numeric_limits<double>::infinity(), degrees = t;
    if (variance > 0 && std::isfinite(excess)) {
        t = excess / result.error;
        degrees = variance * variance /
                  (candidate.variance * candidate.variance / candidate.degrees +
                   reference.variance * reference.variance / reference.degrees);
    }
    result.z = std::copysign(normal_equivalent(t, degrees), result.difference);
    return result;
}

Comparison compare(const BlockImage& candidate, const BlockImage& reference, const ComparisonOptions& options) {
    if (candidate.image_width != reference.image_width || candidate.image_height != reference.image_height ||
        candidate.block_size != reference.block_size || candidate.blocks.size() != reference.blocks.size()) {
        throw std::invalid_argument("compare: the images are not cut alike");
    }
    Comparison result;
    result.threshold = family_threshold(options.alpha, 3 * candidate.blocks.size() + 3);
    for (std::uint32_t y = 0; y < candidate.height(); ++y) {
        for (std::uint32_t x = 0; x < candidate.width(); ++x) {
            for (std::uint32_t channel = 0; channel < 3; ++channel) {
                const Score s = score(candidate.at(x, y)[channel], reference.at(x, y)[channel], options.rounding);
                if (!(std::abs(s.z) > std::abs(result.worst.z))) continue;
                result.worst = s;
                result.worst_x = x;
                result.worst_y = y;
                result.worst_channel = channel;
            }
        }
    }
    const RgbEstimate candidate_mean = candidate.mean(), reference_mean = reference.mean();
    result.agrees = std::abs(result.worst.z) <= result.threshold;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        result.global[channel] = score(candidate_mean[channel], reference_mean[channel], options.rounding);
        result.agrees = result.agrees && std::abs(result.global[channel].z) <= result.threshold;
    }
    result.message = describe(result, candidate, reference);
    return result;
}

}  // namespace orrery::statistics
