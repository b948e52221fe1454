// One step of the tree's builder: where to cut a run of spheres in two.
#pragma once

#include <span>

#include "plan/tree_box.hpp"

namespace orrery {

/// What a run of spheres spans.
struct Span3 {
    Box bound;    ///< of the spheres
    Box centres;  ///< of their centres
};
Span3 measure(std::span<const BuildSphere> spheres);

struct Cut {
    std::size_t size = 0;  ///< spheres on the low side, which now stand first
    unsigned axis = 0;
    Span3 low, high;
};

/// Cuts at the plane of least expected cost (binned surface area heuristic) and partitions the spheres by it. Where no
/// plane separates them, or `in_halves`, it cuts in the middle of the longest side. At least two spheres.
Cut cut(std::span<BuildSphere> spheres, const Span3& span, bool in_halves);

}  // namespace orrery
