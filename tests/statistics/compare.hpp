// Do two renderers compute the same expectation? A verdict with a stated rate of false alarms.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "statistics/blocks.hpp"

namespace orrery::statistics {

struct ComparisonOptions {
    /// Chance that two renderers of equal expectation are told apart, over all blocks, channels and global means.
    double alpha = 1e-3;
    /// A difference up to this times |reference| is float rounding, not bias, and scores 0: without it, values that
    /// carry no noise (a background, a furnace) could never agree between float and double.
    double rounding = 1e-5;
};

/// One number of the candidate against the same of the reference.
struct Score {
    double difference = 0;  ///< candidate less reference
    double error = 0;       ///< standard error of `difference`
    double z = 0;           ///< standard normal if the expectations agree; Student's tail is already accounted for
};

struct Comparison {
    bool agrees = false;
    double threshold = 0;         ///< on every |z| below
    std::array<Score, 3> global;  ///< the means of the whole image, by channel
    Score worst;                  ///< the block with the greatest |z|
    std::uint32_t worst_x = 0, worst_y = 0, worst_channel = 0;
    std::string message;  ///< one paragraph with the figures above, for a test's failure output
};

/// Score of one estimate against another, independent one (Welch's test).
Score score(const Estimate& candidate, const Estimate& reference, double rounding);

/// Tests every block and channel, and the three means of the image, as one family. The claimed rate of false alarms
/// needs some 30 degrees of freedom per block (pixels times seeds): Welch's test is too sure of itself below that. At 7
/// degrees a claim of 5 % was measured to be 8.5 %.
/// Throws std::invalid_argument where the two are not cut alike.
Comparison compare(const BlockImage& candidate, const BlockImage& reference, const ComparisonOptions& options = {});

}  // namespace orrery::statistics
