#include "plan/tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <list>
#include <mutex>
#include <stdexcept>

#include "plan/tree_split.hpp"
#include "system/threads.hpp"

namespace orrery {

namespace {

using kernels::leaf_bit;
using kernels::tree_depth;
using kernels::tree_width;

/// Beyond this depth runs are cut in halves, so that no world, however skewed, makes a tree deeper than tree_depth.
constexpr unsigned heuristic_depth = tree_depth - 28;
/// Runs of so few spheres are not worth a task of their own.
constexpr std::size_t task_size = 4096;

/// A binary tree over runs of the spheres, down to leaves. Its nodes become the children of wide ones, as `collapse`
/// finds cheapest.
struct Run {
    Box bound;
    std::uint32_t first = 0, size = 0;
    unsigned axis = 0;
    Run* low = nullptr;  ///< null: a leaf
    Run* high = nullptr;
    /// By slots a parent has to give, less one: the least expected cost of the wide nodes below, and how many of the
    /// slots then go to `low`; 0: one slot, for a node of its own.
    std::array<float, tree_width> cost{};
    std::array<std::uint8_t, tree_width> for_low{};
    std::uint8_t own_for_low = 0;  ///< as for_low, for a node's sixteen slots
};

/// Fills in costs and slots from those of both halves: dynamic programming over the slots, so that the wide nodes'
/// total area, which is how often rays visit them, is the least this binary tree allows.
///
/// What lost: cutting the largest child until there are sixteen makes 1.6 times as many nodes for 10^6 random spheres
/// and takes as long; filling its free slots with halves of leaves saves 2 % of the visits to leaves, since a visit
/// tests sixteen spheres all the same, adds 6 % to the vectors with a hit in them, and building takes 1.7 times as
/// long.
void collapse(Run& run, double unit) {
    std::array<float, tree_width> shared;
    shared[0] = INFINITY;
    for (std::uint8_t slots = 2; slots <= tree_width; ++slots) {
        float least = INFINITY;
        for (std::uint8_t low = 1; low < slots; ++low) {
            const float cost = run.low->cost[low - 1u] + run.high->cost[slots - low - 1u];
            if (cost < least || low == 1) least = cost, run.for_low[slots - 1u] = low;
        }
        shared[slots - 1u] = least;
    }
    run.own_for_low = run.for_low[tree_width - 1];
    // A little per node, so that boxes of no area make few nodes as well.
    const float own = static_cast<float>(run.bound.area() * unit + 1e-7) + shared[tree_width - 1];
    for (std::size_t i = 0; i < tree_width; ++i) {
        run.cost[i] = std::min(own, shared[i]);
        if (!(shared[i] < own)) run.for_low[i] = 0;
    }
}

class BinaryBuilder {
public:
    BinaryBuilder(std::span<BuildSphere> spheres, unsigned threads) : spheres_(spheres), fork_(threads) {}

    Run* build() {
        const Span3 span = measure(spheres_);
        const double area = span.bound.area();
        unit_ = area > 0 ? 1 / area : 0;
        return build(0, spheres_.size(), span, 0, room());
    }

private:
    using Room = std::deque<Run>;  ///< for the runs of one thread

    Room& room() {
        const std::lock_guard lock(mutex_);
        return rooms_.emplace_back();
    }

    Run* build(std::size_t first, std::size_t size, const Span3& span, unsigned depth, Room& runs) {
        Run* const run = &runs.emplace_back();
        run->bound = span.bound;
        run->first = static_cast<std::uint32_t>(first);
        run->size = static_cast<std::uint32_t>(size);
        if (size <= tree_width) return run;
        const Cut parts = cut(spheres_.subspan(first, size), span, depth >= heuristic_depth);
        run->axis = parts.axis;
        const auto low = [&](Room& r) { run->low = build(first, parts.size, parts.low, depth + 1, r); };
        const auto high = [&](Room& r) {
            run->high = build(first + parts.size, size - parts.size, parts.high, depth + 1, r);
        };
        if (size >= task_size) {
            fork_.both([&] { low(room()); }, [&] { high(runs); });
        } else {
            low(runs);
            high(runs);
        }
        collapse(*run, unit_);
        return run;
    }

    std::span<BuildSphere> spheres_;
    double unit_ = 0;  ///< costs are in areas of the whole
    Fork fork_;
    std::mutex mutex_;
    std::list<Room> rooms_;
};

/// Children front to back for the rays of every octant, four bits each.
struct Order {
    std::array<std::uint64_t, 8> list{};
    unsigned count = 0;
};

/// Chooses the children that take `slots` places of a parent, given how the run is to share them, and orders them by
/// the binary cuts between them: of two halves a ray that runs down the axis of the cut meets the high one first.
Order arrange(const Run& run, unsigned slots, unsigned for_low, std::vector<const Run*>& children) {
    Order order;
    if (run.low == nullptr || for_low == 0) {
        order.list.fill(children.size());
        order.count = 1;
        children.push_back(&run);
        return order;
    }
    const unsigned for_high = slots - for_low;
    const Order low = arrange(*run.low, for_low, run.low->for_low[for_low - 1], children);
    const Order high = arrange(*run.high, for_high, run.high->for_low[for_high - 1], children);
    for (unsigned octant = 0; octant < 8; ++octant) {
        const bool down = (octant >> run.axis & 1u) != 0;
        const Order& front = down ? high : low;
        const Order& back = down ? low : high;
        order.list[octant] = front.list[octant] | back.list[octant] << (4 * front.count);
    }
    order.count = low.count + high.count;
    return order;
}

class WideBuilder {
public:
    explicit WideBuilder(std::vector<kernels::TreeNode<float>>& nodes) : nodes_(nodes) {}

    /// Appends the node of `run` and all below it; returns its index.
    std::uint32_t build(const Run* run) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        std::vector<const Run*> children;
        const Order order = arrange(*run, tree_width, run->own_for_low, children);
        kernels::TreeNode<float> node{};
        for (std::size_t c = 0; c < tree_width; ++c) {
            const Box box = c < children.size() ? children[c]->bound : Box{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.bound[2 * axis][c] = box.low[axis];
                node.bound[2 * axis + 1][c] = box.high[axis];
            }
        }
        for (unsigned octant = 0; octant < 8; ++octant) node.order[octant] = order.list[octant];
        for (std::size_t c = 0; c < children.size(); ++c) {
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

Tree build_tree(std::span<BuildSphere> spheres, unsigned threads) {
    if (spheres.size() >= (std::size_t{1} << 27)) throw std::length_error("more than 2^27 spheres");
    Tree tree;
    if (spheres.empty()) return tree;
    BinaryBuilder binary(spheres, threads);
    const Run* const root = binary.build();
    WideBuilder(tree.nodes).build(root);
    for (std::size_t axis = 0; axis < 3; ++axis)
        tree.extent = std::max({tree.extent, std::abs(root->bound.low[axis]), std::abs(root->bound.high[axis])});
    return tree;
}

}  // namespace orrery
