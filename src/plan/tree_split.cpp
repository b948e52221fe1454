#include "plan/tree_split.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace orrery {

namespace {

constexpr std::size_t bin_count = 16;

struct Bins {
    std::array<Box, bin_count> box;
    std::array<std::uint32_t, bin_count> count{};
};

/// Maps a centre to its bin along each axis.
class Binning {
public:
    explicit Binning(const Box& centres) : low_(centres.low) {
        const Four size = centres.high - centres.low;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const float scale = bin_count * (1 - 0x1p-20f) / size[axis];
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
    return spheres == 0 ? 0 : box.area() * ((spheres + kernels::tree_width - 1) / kernels::tree_width);
}

struct Plane {
    double cost = INFINITY;
    unsigned axis = 0;
    std::size_t bin = 0;  ///< first of the high side
};

void try_planes(const Bins& bins, unsigned axis, Plane& best) {
    std::array<double, bin_count> high_cost{};
    Box box;
    std::uint32_t count = 0;
    for (std::size_t b = bin_count - 1; b > 0; --b) {
        box.add(bins.box[b]);
        count += bins.count[b];
        high_cost[b] = cost(box, count);
        if (count == 0) high_cost[b] = INFINITY;
    }
    box = {};
    count = 0;
    for (std::size_t b = 1; b < bin_count; ++b) {
        box.add(bins.box[b - 1]);
        count += bins.count[b - 1];
        if (count == 0) continue;
        const double total = cost(box, count) + high_cost[b];
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
        const Four centre = centre_of(s), radius = radius_of(s);
        span.bound.add(centre - radius, centre + radius);
        span.centres.add(centre, centre);
    }
    return span;
}

Cut cut(std::span<BuildSphere> spheres, const Span3& span, bool in_halves) {
    if (in_halves) return halve(spheres, span);
    const Binning bin_of(span.centres);
    std::array<Bins, 3> bins;
    for (const BuildSphere& s : spheres) {
        const Four centre = centre_of(s), radius = radius_of(s);
        const Four low = centre - radius, high = centre + radius;
        const auto place = bin_of(centre);
        for (unsigned axis = 0; axis < 3; ++axis) {
            const auto b = static_cast<std::size_t>(place[axis]);
            bins[axis].box[b].add(low, high);
            ++bins[axis].count[b];
        }
    }
    Plane best;
    for (unsigned axis = 0; axis < 3; ++axis)
        if (bin_of.usable(axis)) try_planes(bins[axis], axis, best);
    if (!(best.cost < INFINITY)) return halve(spheres, span);

    // Measures both sides while it partitions: the next step begins with that.
    Cut result;
    result.axis = best.axis;
    const auto plane = static_cast<std::int32_t>(best.bin);
    std::size_t low = 0, high = spheres.size();
    while (low < high) {
        const BuildSphere s = spheres[low];
        const Four centre = centre_of(s), radius = radius_of(s);
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
