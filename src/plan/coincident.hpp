// One surface listed twice: real files hold such pairs, made by loops (a ring closed at 360 degrees) and by exporters.
// A ray that leaves one copy would find the other at a distance of zero, on either side.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace orrery {

/// Two primitives, by their place in the list, and by how much their centres or radii differ at most: in multiples of
/// the scale at which coordinates are rounded, the largest of |x|, |y|, |z| and the radius.
struct Twins {
    std::uint32_t first = 0, again = 0;
    double apart = 0;
};

struct Coincidences {
    std::vector<Twins> same;  ///< `again` is `first` listed again, ascending
    std::size_t near = 0;     ///< pairs that are not the same, but near
    Twins nearest;            ///< of them
    bool too_many = false;    ///< to compare them all: neither list is complete
};

/// Pairs no further apart than `same`, or than `near` >= same > 0. One that is the same as an earlier one takes no part
/// in further comparisons: what is alike by way of a third may stay. Time and memory in proportion to the number of
/// spheres, however they stand.
Coincidences coincidences(const std::vector<Primitive>& primitives, double same, double near);

}  // namespace orrery
