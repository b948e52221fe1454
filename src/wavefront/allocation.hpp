// How many samples each part of the image should have.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace orrery {

/// Pixels that are sampled alike.
struct Region {
    double pixels = 0;
    double taken = 0;    ///< samples per pixel so far
    double scatter = 0;  ///< relative variance of one sample, summed over the pixels: after n samples scatter / n
};

/// Samples per pixel by region, none below what is taken already, with the least sum of scatter / n for their total
/// (Neyman's allocation: in proportion to the root of the scatter per pixel), such that either
/// * that sum is `target`, or
/// * the total, over pixels, is `limit`,
/// whichever takes fewer samples. Deterministic.
std::vector<double> allocate(std::span<const Region> regions, double target, double limit);

/// The total over pixels.
double total_samples(std::span<const Region> regions, std::span<const double> samples);

}  // namespace orrery
