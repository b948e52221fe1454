// Many spheres: a tree of bounding boxes, sixteen to a node.
//
// Built by src/plan (tree.hpp there), traversed by tree_traverse.hpp. Leaves are runs of up to sixteen neighbours in
// the sphere table itself, whose order is the tree's: a leaf is where its run begins, and a sphere's id remains its
// place.
#pragma once

#include <cstdint>

namespace orrery::kernels {

/// Children of a node and spheres of a leaf: one vector of the widest instruction set.
inline constexpr std::uint32_t tree_width = 16;
/// No path from the root passes more nodes than this; the builder sees to it.
inline constexpr std::uint32_t tree_depth = 64;
/// A child that is a leaf: leaf_bit | first sphere.
inline constexpr std::uint32_t leaf_bit = 1u << 31;

/// Sixteen boxes; those of unused children lie at low = +inf, high = -inf and are met by no ray.
template <class Real>
struct alignas(64) TreeNode {
    Real bound[6][tree_width];        ///< low x, high x, low y, high y, low z, high z
    std::uint32_t child[tree_width];  ///< a node, or a leaf where leaf_bit is set
    /// Children front to back, four bits each, by octant: bit a of the index is set where a ray runs down axis a.
    std::uint64_t order[8];
};

template <class Real>
struct SphereTree {
    std::uint32_t count = 0;                ///< nodes; 0: no tree
    const TreeNode<Real>* nodes = nullptr;  ///< the root first
    Real extent = 0;                        ///< the largest magnitude of a bound's coordinate
};

}  // namespace orrery::kernels
