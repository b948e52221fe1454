// Many spheres: the tree of boxes that the kernels traverse (kernels/tree.hpp), built by the surface area heuristic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/tree.hpp"

namespace orrery {

/// A sphere as the kernels see it: rounded to float.
struct BuildSphere {
    float x, y, z;
    float radius;
    std::uint32_t index;  ///< in the caller's list
};

struct Tree {
    std::vector<kernels::TreeNode<float>> nodes;  ///< empty where there are no spheres
    float extent = 0;                             ///< largest magnitude of a bound's coordinate
};

/// Measured: with fewer spheres the linear loop is faster.
inline constexpr std::size_t tree_crossover = 64;

/// Builds the tree over `spheres` and puts them into its order: a sphere's place is the id the kernels give. Fewer than
/// 2^27 of them, finite, radii >= 0. All cores TBB grants; the same tree for any number of them.
Tree build_tree(std::span<BuildSphere> spheres);

}  // namespace orrery
