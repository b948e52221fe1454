#include "plan/tree.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "plan/tree_split.hpp"

namespace orrery {

namespace {

using kernels::leaf_bit;
using kernels::tree_depth;
using kernels::tree_width;

/// Beyond this depth runs are cut in halves, so that no world, however skewed, makes a tree deeper than tree_depth.
constexpr unsigned heuristic_depth = tree_depth - 28;
/// Runs of so few spheres are not worth a task of their own.
constexpr std::size_t task_size = 4096;
/// Runs of so few are not cut further.
constexpr std::size_t small_run = 4;

/// A binary tree over runs of the spheres; its nodes become the children of wide ones.
struct Run {
    Box bound;
    std::uint32_t first = 0, size = 0;
    unsigned axis = 0;
    Run* low = nullptr;  ///< null: not cut further
    Run* high = nullptr;
};

class BinaryBuilder {
public:
    explicit BinaryBuilder(std::span<BuildSphere> spheres) : spheres_(spheres) {}

    Run* build() { return build(0, spheres_.size(), measure(spheres_), 0); }

private:
    Run* build(std::size_t first, std::size_t size, const Span3& span, unsigned depth) {
        Run* const run = &runs_.local().emplace_back();
        run->bound = span.bound;
        run->first = static_cast<std::uint32_t>(first);
        run->size = static_cast<std::uint32_t>(size);
        if (size <= small_run) return run;
        const Cut parts = cut(spheres_.subspan(first, size), span, depth >= heuristic_depth);
        run->axis = parts.axis;
        const auto low = [&] { run->low = build(first, parts.size, parts.low, depth + 1); };
        const auto high = [&] { run->high = build(first + parts.size, size - parts.size, parts.high, depth + 1); };
        if (size >= task_size) {
            tbb::parallel_invoke(low, high);
        } else {
            low();
            high();
        }
        return run;
    }

    std::span<BuildSphere> spheres_;
    tbb::enumerable_thread_specific<std::deque<Run>> runs_;
};

/// The children of one wide node, with the binary cuts that made them: these tell front from back.
class Family {
public:
    explicit Family(const Run* root) { cuts_[0].run = root; }

    /// Cuts the largest child until there are sixteen.
    void grow() {
        while (children_ < tree_width) {
            int best = -1;
            double largest = -1;
            for (int i = 0; i < used_; ++i) {
                const Cut& c = cuts_[at(i)];
                if (c.low >= 0 || c.run->low == nullptr) continue;
                const double size = c.run->bound.area() * (c.run->size > tree_width ? 1e6 : 1);
                if (size > largest) largest = size, best = i;
            }
            if (best < 0) return;
            Cut& c = cuts_[at(best)];
            c.low = used_++;
            c.high = used_++;
            cuts_[at(c.low)].run = c.run->low;
            cuts_[at(c.high)].run = c.run->high;
            ++children_;
        }
    }
    std::array<const Run*, tree_width> children() {
        std::array<const Run*, tree_width> list{};
        unsigned count = 0;
        for (int i = 0; i < used_; ++i) {
            Cut& c = cuts_[at(i)];
            if (c.low >= 0) continue;
            c.child = count;
            list[count++] = c.run;
        }
        return list;
    }
    /// Children front to back for rays of an octant, four bits each.
    std::uint64_t order(unsigned octant) const {
        std::uint64_t list = 0;
        unsigned count = 0;
        add_order(0, octant, list, count);
        return list;
    }

private:
    struct Cut {
        const Run* run = nullptr;
        int low = -1, high = -1;  ///< cuts; -1 where this is a child
        unsigned child = 0;
    };
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }

    void add_order(int i, unsigned octant, std::uint64_t& list, unsigned& count) const {
        const Cut& c = cuts_[at(i)];
        if (c.low < 0) {
            list |= std::uint64_t{c.child} << (4 * count++);
            return;
        }
        const bool down = (octant >> c.run->axis & 1u) != 0;
        add_order(down ? c.high : c.low, octant, list, count);
        add_order(down ? c.low : c.high, octant, list, count);
    }

    std::array<Cut, 2 * tree_width> cuts_{};
    int used_ = 1;
    unsigned children_ = 1;
};

class WideBuilder {
public:
    explicit WideBuilder(std::vector<kernels::TreeNode<float>>& nodes) : nodes_(nodes) {}

    /// Appends the node of `run` and all below it; returns its index.
    std::uint32_t build(const Run* run) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        Family family(run);
        family.grow();
        const auto children = family.children();
        kernels::TreeNode<float> node{};
        for (std::size_t c = 0; c < tree_width; ++c) {
            const Box box = children[c] != nullptr ? children[c]->bound : Box{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.bound[2 * axis][c] = box.low[axis];
                node.bound[2 * axis + 1][c] = box.high[axis];
            }
        }
        for (unsigned octant = 0; octant < 8; ++octant) node.order[octant] = family.order(octant);
        for (std::size_t c = 0; c < tree_width; ++c) {
            if (children[c] == nullptr) continue;
            const bool leaf = children[c]->size <= tree_width;
            node.child[c] = leaf ? leaf_bit | children[c]->first : build(children[c]);
        }
        nodes_[index] = node;
        return index;
    }

private:
    std::vector<kernels::TreeNode<float>>& nodes_;
};

}  // namespace

Tree build_tree(std::span<BuildSphere> spheres, const TreeProgress& progress) {
    if (spheres.size() >= (std::size_t{1} << 27)) throw std::length_error("more than 2^27 spheres");
    Tree tree;
    if (spheres.empty()) return tree;
    BinaryBuilder binary(spheres);
    const Run* const root = binary.build();
    if (progress) progress(0.9);
    WideBuilder(tree.nodes).build(root);
    for (std::size_t axis = 0; axis < 3; ++axis)
        tree.extent = std::max({tree.extent, std::abs(root->bound.low[axis]), std::abs(root->bound.high[axis])});
    return tree;
}

}  // namespace orrery
