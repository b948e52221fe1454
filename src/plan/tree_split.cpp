#include "plan/tree_split.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace orrery {

namespace {

constexpr std::size_t most_bins = 16;

struct Bin {
    Box box;
    std::uint32_t count = 0;
};
using Bins = std::array<Bin, most_bins>;

/// A short run has no use for many planes, and looking at them is most of its cost.
std::size_t bins_for(std::size_t spheres) { return spheres < 24 ? most_bins / 2 : most_bins; }

/// Maps a centre to its bin along each axis.
class Binning {
public:
    Binning(const Box& centres, std::size_t bins) : low_(centres.low) {
        const Four size = centres.high - centres.low;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const float scale = static_cast<float>(bins) * (1 - 0x1p-20f) / size[axis];
            usable_[axis] = size[axis] > 0 && std::isfinite(scale) && scale > 0;
            scale_[axis] = usable_[axis] ? scale : 0;
        }
    }
    bool usable(unsigned axis) const { return usable_[axis]; }
    using Places __attribute__((vector_size(16))) = std::int32_t;
    Places operator()(Four centre) const { return __builtin_convertvector((centre - low_) * scale_, Places); }

private:
    Four low_;
    Four scale_{};
    std::array<bool, 3> usable_{};
};

/// A leaf's spheres are tested at once, so that is what cost goes by.
double cost(const Box& box, std::uint32_t spheres) {
    return box.area() * ((spheres + kernels::tree_width - 1) / kernels::tree_width);
}

struct Plane {
    double cost = INFINITY;
    unsigned axis = 0;
    std::size_t bin = 0;  ///< first of the high side
};

void try_planes(std::span<const Bin> bins, unsigned axis, Plane& best) {
    std::array<double, most_bins> high_cost;
    Bin high;
    for (std::size_t b = bins.size() - 1; b > 0; --b) {
        high.box.add(bins[b].box);
        high.count += bins[b].count;
        high_cost[b] = high.count > 0 ? cost(high.box, high.count) : INFINITY;
    }
    Bin low;
    for (std::size_t b = 1; b < bins.size(); ++b) {
        low.box.add(bins[b - 1].box);
        low.count += bins[b - 1].count;
        const double total = low.count > 0 ? cost(low.box, low.count) + high_cost[b] : INFINITY;
        if (total < best.cost) best = {total, axis, b};
    }
}

/// A stable answer to "in the middle", whatever the centres are.
Cut halve(std::span<BuildSphere> spheres, const Span3& span) {
    Cut result;
    const Four size = span.centres.high - span.centres.low;
    result.axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    // Whole leaves to the low side.
    constexpr std::size_t leaf = kernels::tree_width;
    const std::size_t leaves = (spheres.size() + leaf - 1) / leaf;
    result.size = leaves > 1 ? leaves / 2 * leaf : spheres.size() / 2;
    const auto key = [axis = result.axis](const BuildSphere& s) { return axis == 0 ? s.x : axis == 1 ? s.y : s.z; };
    std::nth_element(spheres.begin(), spheres.begin() + static_cast<std::ptrdiff_t>(result.size), spheres.end(),
                     [&](const BuildSphere& a, const BuildSphere& b) {
                         return key(a) < key(b) || (key(a) == key(b) && a.index < b.index);
                     });
    result.low = measure(spheres.first(result.size));
    result.high = measure(spheres.subspan(result.size));
    return result;
}

}  // namespace

Span3 measure(std::span<const BuildSphere> spheres) {
    Span3 span;
    for (const BuildSphere& s : spheres) {
        const Four centre = four_of(s), radius = radius_of(centre);
        span.bound.add(centre - radius, centre + radius);
        span.centres.add(centre, centre);
    }
    return span;
}

Cut cut(std::span<BuildSphere> spheres, const Span3& span, bool in_halves) {
    if (in_halves) return halve(spheres, span);
    const std::size_t bin_count = bins_for(spheres.size());
    const Binning bin_of(span.centres, bin_count);
    std::array<Bins, 3> bins;
    for (const BuildSphere& s : spheres) {
        const Four centre = four_of(s), radius = radius_of(centre);
        const Four low = centre - radius, high = centre + radius;
        const auto place = bin_of(centre);
        for (unsigned axis = 0; axis < 3; ++axis) {
            // Masked for an axis that is not usable, whose place may be anything.
            const auto b = static_cast<std::size_t>(place[axis]) % most_bins;
            bins[axis][b].box.add(low, high);
            ++bins[axis][b].count;
        }
    }
    Plane best;
    for (unsigned axis = 0; axis < 3; ++axis)
        if (bin_of.usable(axis)) try_planes(std::span(bins[axis]).first(bin_count), axis, best);
    if (!(best.cost < INFINITY)) return halve(spheres, span);

    // Measures both sides while it partitions: the next step begins with that.
    Cut result;
    result.axis = best.axis;
    const auto plane = static_cast<std::int32_t>(best.bin);
    std::size_t low = 0, high = spheres.size();
    while (low < high) {
        const BuildSphere s = spheres[low];
        const Four centre = four_of(s), radius = radius_of(centre);
        const bool stays = bin_of(centre)[best.axis] < plane;
        Span3& side = stays ? result.low : result.high;
        side.bound.add(centre - radius, centre + radius);
        side.centres.add(centre, centre);
        if (stays) {
            ++low;
        } else {
            std::swap(spheres[low], spheres[--high]);
        }
    }
    result.size = low;
    return result;
}

}  // namespace orrery
