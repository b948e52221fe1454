// Many spheres: the tree of boxes that the kernels traverse (kernels/tables.hpp, kernels/tree_traverse.hpp), built by
// the surface area heuristic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/tables.hpp"

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

/// With fewer spheres the linear loop is faster. Whole renders by loop over by tree (AVX-512, float): random worlds of
/// 16, 24, 32, 48 and 64 spheres 0.97, 0.98, 0.92, 0.92, 1.06, of 96 and 128 2.5 and 3.1, where the loop no longer
/// leaves spheres out for coherent rays; denser ones of 16, 24, 32, 48 and 96 spheres 0.90, 0.88, 0.97, 1.01, 2.2.
inline constexpr std::size_t tree_crossover = 64;
/// Fewer spheres are sooner tested than left out for a packet of rays.
inline constexpr std::size_t packet_crossover = 4;

/// Builds the tree over `spheres` and puts them into its order: a sphere's place is the id the kernels give. Fewer than
/// 2^27 of them, finite, radii >= 0. On so many threads, 0 being one per processor; the same tree for any number.
Tree build_tree(std::span<BuildSphere> spheres, unsigned threads = 0);

}  // namespace orrery
