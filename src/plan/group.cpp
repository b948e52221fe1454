#include "plan/group.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>

#include "kernels/sphere.hpp"

namespace orrery {

namespace {

/// Bunches of at most this many. The showcase takes 1.11, 0.93 and 0.86 user seconds per frame with 4, 8 and 16.
constexpr std::size_t bunch = 16;
/// A sphere this many times larger than the median would blow up its group's bound.
constexpr double oversize = 8;

struct Box {
    glm::dvec3 low{INFINITY}, high{-INFINITY};
    void add(const glm::dvec3& p, double r) {
        low = glm::min(low, p - r);
        high = glm::max(high, p + r);
    }
};

class Grouper {
public:
    Grouper(const std::vector<Primitive>& primitives, Grouping& grouping)
        : primitives_(primitives), grouping_(grouping) {}

    /// Splits places [first, last) of the order at medians of the longest side, whole bunches to the left.
    void split(std::size_t first, std::size_t last) {
        if (last - first <= bunch) return close(first, last);
        Box centres;
        for (std::size_t i = first; i < last; ++i) centres.add(at(i).centre, 0);
        const glm::dvec3 size = centres.high - centres.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t bunches = (last - first + bunch - 1) / bunch;
        const std::size_t middle = first + bunches / 2 * bunch;
        const auto place = [&](std::size_t i) { return grouping_.order.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(place(first), place(middle), place(last), [&](std::uint32_t a, std::uint32_t b) {
            const double x = primitives_[a].centre[axis], y = primitives_[b].centre[axis];
            return x < y || (x == y && a < b);
        });
        split(first, middle);
        split(middle, last);
    }

private:
    const Primitive& at(std::size_t place) const { return primitives_[grouping_.order[place]]; }

    /// Makes a group of places [first, last). The bound holds for what the kernels see: everything rounded to float.
    void close(std::size_t first, std::size_t last) {
        Box box;
        for (std::size_t i = first; i < last; ++i) box.add(at(i).centre, at(i).radius);
        const glm::vec3 centre((box.low + box.high) * 0.5);
        double radius = 0;
        for (std::size_t i = first; i < last; ++i)
            radius = std::max(radius, glm::distance(glm::dvec3(glm::vec3(at(i).centre)), glm::dvec3(centre)) +
                                          static_cast<double>(static_cast<float>(at(i).radius)));
        radius *= 1 + kernels::group_margin;
        grouping_.end.push_back(static_cast<std::uint32_t>(last));
        grouping_.cx.push_back(centre.x);
        grouping_.cy.push_back(centre.y);
        grouping_.cz.push_back(centre.z);
        grouping_.radius2.push_back(static_cast<float>(radius * radius));
    }

    const std::vector<Primitive>& primitives_;
    Grouping& grouping_;
};

}  // namespace

Grouping group_spheres(const std::vector<Primitive>& primitives) {
    Grouping grouping;
    grouping.order.resize(primitives.size());
    std::iota(grouping.order.begin(), grouping.order.end(), 0u);
    grouping.ungrouped = static_cast<std::uint32_t>(primitives.size());
    if (primitives.size() < group_crossover) return grouping;

    std::vector<double> radii;
    for (const Primitive& p : primitives) radii.push_back(p.radius);
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    const double largest = oversize * *middle;
    const auto small = std::stable_partition(grouping.order.begin(), grouping.order.end(),
                                             [&](std::uint32_t i) { return primitives[i].radius > largest; });
    grouping.ungrouped = static_cast<std::uint32_t>(small - grouping.order.begin());
    Grouper(primitives, grouping).split(grouping.ungrouped, primitives.size());
    return grouping;
}

}  // namespace orrery
