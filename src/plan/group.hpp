// Many spheres: bunches of neighbours with a bounding sphere each (kernels/tables.hpp, SphereGroups).
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace orrery {

struct Grouping {
    std::vector<std::uint32_t> order;  ///< which primitive stands at each place of the sphere table
    std::uint32_t ungrouped = 0;       ///< places [0, ungrouped) stand alone
    std::vector<std::uint32_t> end;    ///< by group: one behind its last place
    std::vector<float> cx, cy, cz;     ///< by group: centre of the bounding sphere
    std::vector<float> radius2;        ///< by group: its squared radius, margin included
};

/// Spheres much larger than most stand alone, first; the others are split at medians until a bunch is small. Fewer than
/// `group_crossover` spheres are not grouped and keep their order.
Grouping group_spheres(const std::vector<Primitive>& primitives);

/// Measured: below this many spheres the linear loop is faster.
inline constexpr std::size_t group_crossover = 24;

}  // namespace orrery
