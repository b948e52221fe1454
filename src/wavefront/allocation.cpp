#include "wavefront/allocation.hpp"

#include <algorithm>
#include <cmath>

namespace orrery {
namespace {

/// Every region's samples at a given density: `density` times the root of the scatter per pixel, or what it has.
std::vector<double> at_density(std::span<const Region> regions, double density) {
    std::vector<double> samples;
    samples.reserve(regions.size());
    for (const Region& region : regions)
        samples.push_back(std::max(region.taken, density * std::sqrt(region.scatter / region.pixels)));
    return samples;
}

double error_left(std::span<const Region> regions, std::span<const double> samples) {
    double sum = 0;
    for (std::size_t i = 0; i < regions.size(); ++i)
        if (regions[i].scatter > 0) sum += regions[i].scatter / samples[i];
    return sum;
}

}  // namespace

double total_samples(std::span<const Region> regions, std::span<const double> samples) {
    double sum = 0;
    for (std::size_t i = 0; i < regions.size(); ++i) sum += regions[i].pixels * samples[i];
    return sum;
}

std::vector<double> allocate(std::span<const Region> regions, double target, double limit) {
    // More density is more samples and less error, so that the density at which to stop can be halved in on.
    const auto enough = [&](double density) {
        const std::vector<double> samples = at_density(regions, density);
        return error_left(regions, samples) <= target || total_samples(regions, samples) >= limit;
    };
    if (enough(0)) return at_density(regions, 0);
    // To within a factor of two first: what density that is depends on how bright the image is, and one that could not
    // be told from 0 would give samples without end.
    double low = 0.5, high = 1;
    while (!enough(high)) low = high, high *= 2;
    while (enough(low)) high = low, low /= 2;
    for (int i = 0; i < 50; ++i) {
        const double middle = low + (high - low) / 2;
        (enough(middle) ? high : low) = middle;
    }
    return at_density(regions, high);
}

}  // namespace orrery
