// The tree as a structure: every sphere in one leaf, boxes that hold what is below them, no depth out of bounds, the
// same for any number of threads, and a cost per ray that grows with the logarithm of the number of spheres.
#include "plan/tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <set>

namespace orrery {
namespace {

using kernels::leaf_bit;
using kernels::tree_depth;
using kernels::tree_width;
using Node = kernels::TreeNode<float>;

std::vector<BuildSphere> spheres_of(std::uint32_t count, const std::function<BuildSphere(std::uint32_t)>& make) {
    std::vector<BuildSphere> spheres;
    for (std::uint32_t i = 0; i < count; ++i) {
        spheres.push_back(make(i));
        spheres.back().index = i;
    }
    return spheres;
}

/// Uniform in the unit cube, their volumes together a tenth of it.
std::vector<BuildSphere> random_spheres(std::uint32_t count) {
    std::mt19937 random(count);
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    const float radius = 0.288f / std::cbrt(static_cast<float>(count));
    return spheres_of(count, [&](std::uint32_t) { return BuildSphere{unit(), unit(), unit(), radius, 0}; });
}

struct Extremes {
    std::array<float, 3> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
};

Extremes box_of(const Node& node, std::size_t c) {
    return {{node.bound[0][c], node.bound[2][c], node.bound[4][c]},
            {node.bound[1][c], node.bound[3][c], node.bound[5][c]}};
}

bool used(const Node& node, std::size_t c) { return node.bound[0][c] <= node.bound[1][c]; }

/// Walks the whole tree and checks what the kernels rely on.
class Inspection {
public:
    Inspection(const Tree& tree, const std::vector<BuildSphere>& spheres) : tree_(tree), spheres_(spheres) {
        for (const Node& node : tree.nodes)
            for (std::size_t c = 0; c < tree_width; ++c)
                if (used(node, c) && (node.child[c] & leaf_bit) != 0) {
                    EXPECT_TRUE(leaves.insert(node.child[c] & ~leaf_bit).second) << "two leaves begin in one place";
                }
        // A leaf ends where the next one begins: so no sphere is in two, and none in none if the first begins at 0.
        EXPECT_EQ(*leaves.begin(), 0u);
        EXPECT_LT(*leaves.rbegin(), spheres.size());
        leaves.insert(static_cast<std::uint32_t>(spheres.size()));
        inspect(0, 1);
        leaves.erase(static_cast<std::uint32_t>(spheres.size()));
        EXPECT_EQ(nodes_, tree.nodes.size()) << "nodes nobody leads to, or several do";
        EXPECT_LE(depth, tree_depth);
    }
    std::set<std::uint32_t> leaves;
    std::uint32_t depth = 0;

private:
    void inspect(std::uint32_t index, std::uint32_t level) {
        ++nodes_;
        depth = std::max(depth, level);
        const Node& node = tree_.nodes.at(index);
        std::uint32_t present = 0;
        for (std::size_t c = 0; c < tree_width; ++c) {
            const Extremes box = box_of(node, c);
            if (!used(node, c)) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    EXPECT_EQ(box.low[axis], INFINITY);
                    EXPECT_EQ(box.high[axis], -INFINITY);
                }
                continue;
            }
            present |= 1u << c;
            bounds_.push_back(box);
            if ((node.child[c] & leaf_bit) != 0) {
                inspect_leaf(node.child[c] & ~leaf_bit);
            } else {
                EXPECT_GT(node.child[c], index);
                inspect(node.child[c], level + 1);
            }
            bounds_.pop_back();
        }
        for (const std::uint64_t order : node.order) {
            std::uint32_t visited = 0;
            for (int i = 0; i < std::popcount(present); ++i) visited |= 1u << (order >> (4 * i) & 15u);
            EXPECT_EQ(visited, present) << "a child left out of an octant's order";
        }
    }
    /// Every sphere of the leaf lies in every box above it.
    void inspect_leaf(std::uint32_t first) {
        const std::uint32_t end = *leaves.upper_bound(first);
        EXPECT_LE(end - first, tree_width);
        for (std::uint32_t k = first; k < end; ++k) {
            const BuildSphere& s = spheres_[k];
            const std::array<float, 3> centre{s.x, s.y, s.z};
            for (const Extremes& box : bounds_) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    ASSERT_LE(box.low[axis], centre[axis] - s.radius) << "sphere " << k;
                    ASSERT_GE(box.high[axis], centre[axis] + s.radius) << "sphere " << k;
                    ASSERT_LE(std::max(-box.low[axis], box.high[axis]), tree_.extent);
                }
            }
        }
    }

    const Tree& tree_;
    const std::vector<BuildSphere>& spheres_;
    std::vector<Extremes> bounds_;  ///< from the root down
    std::size_t nodes_ = 0;
};

/// The tree of a copy of `given`, after checking that the copy is the same spheres in another order.
struct Grown {
    std::vector<BuildSphere> spheres;
    Tree tree;
    explicit Grown(const std::vector<BuildSphere>& given, unsigned threads = 0)
        : spheres(given), tree(build_tree(spheres, threads)) {
        std::vector<bool> seen(given.size());
        for (const BuildSphere& s : spheres) {
            EXPECT_FALSE(seen.at(s.index));
            seen[s.index] = true;
            EXPECT_EQ(std::memcmp(&s, &given[s.index], sizeof s), 0);
        }
    }
};

TEST(Tree, HoldsEverySphereOnceWithinItsBoxes) {
    for (const std::uint32_t count : {1u, 2u, 15u, 16u, 17u, 100u, 255u, 256u, 257u, 5000u, 60000u}) {
        SCOPED_TRACE(count);
        const Grown grown(random_spheres(count));
        const Inspection inspection(grown.tree, grown.spheres);
        if (count <= 16) {
            EXPECT_EQ(inspection.depth, 1u);
        }
    }
}

TEST(Tree, OfNothingIsNone) { EXPECT_TRUE(build_tree({}).nodes.empty()); }

TEST(Tree, BearsSpheresThatNoPlaneSeparates) {
    const auto check = [](const char* name, const std::vector<BuildSphere>& spheres) {
        SCOPED_TRACE(name);
        const Grown grown(spheres);
        const Inspection inspection(grown.tree, grown.spheres);
        EXPECT_LE(grown.tree.nodes.size(), spheres.size() / 8 + 1);
    };
    const auto huge = std::numeric_limits<float>::max() / 4;
    const auto tiny = std::numeric_limits<float>::denorm_min();
    check("one centre", spheres_of(10000, [](std::uint32_t) { return BuildSphere{3, 4, 5, 1, 0}; }));
    check("one centre, many radii", spheres_of(10000, [](std::uint32_t i) {
              return BuildSphere{3, 4, 5, static_cast<float>(i), 0};
          }));
    check("huge", spheres_of(1000, [&](std::uint32_t i) {
              return BuildSphere{i % 2 == 0 ? huge : -huge, huge, 0, huge, 0};
          }));
    check("tiny", spheres_of(1000, [&](std::uint32_t i) {
              return BuildSphere{tiny * static_cast<float>(i), 0, 0, tiny, 0};
          }));
    check("doubling distances", spheres_of(200, [](std::uint32_t i) {
              return BuildSphere{std::ldexp(1.0f, static_cast<int>(i) - 100), 0, 0, 1e-30f, 0};
          }));
    check("a line", spheres_of(5000, [](std::uint32_t i) { return BuildSphere{static_cast<float>(i), 0, 0, 1, 0}; }));
    check("nested eccentrically", spheres_of(3000, [](std::uint32_t i) {
              const auto r = static_cast<float>(std::pow(0.99, i));
              return BuildSphere{r, 0, 0, r, 0};
          }));
}

// Random spheres: leaves well filled, nodes nearly full, few levels, and no more memory than promised.
TEST(Tree, IsCompact) {
    constexpr std::uint32_t count = 1u << 17;
    const Grown grown(random_spheres(count));
    const Inspection inspection(grown.tree, grown.spheres);
    const auto nodes = static_cast<double>(grown.tree.nodes.size());
    const auto leaves = static_cast<double>(inspection.leaves.size());
    EXPECT_LE(inspection.depth, 7u) << "a full tree of full leaves would have 4";
    EXPECT_GT((leaves + nodes - 1) / nodes, 9) << "children per node";
    EXPECT_GT(count / leaves, 13) << "spheres per leaf";
    // Six numbers and two words per sphere stand in the columns, and the tree beside them.
    EXPECT_LT(nodes * sizeof(Node) / count + 8 * 4, 40);
}

TEST(Tree, IsTheSameForAnyNumberOfThreads) {
    const auto given = random_spheres(30000);
    const auto grow = [&](unsigned threads) { return Grown(given, threads); };
    const Grown one = grow(1), two = grow(2), many = grow(7);
    for (const Grown* other : {&two, &many}) {
        ASSERT_EQ(one.tree.nodes.size(), other->tree.nodes.size());
        EXPECT_EQ(std::memcmp(one.tree.nodes.data(), other->tree.nodes.data(), one.tree.nodes.size() * sizeof(Node)),
                  0);
        EXPECT_EQ(std::memcmp(one.spheres.data(), other->spheres.data(), given.size() * sizeof(BuildSphere)), 0);
    }
}

/// Boxes a ray enters before the first sphere on its way, leaves' boxes included: what the tree costs it in the best
/// order of visits.
class Walk {
public:
    explicit Walk(const Grown& grown) : grown_(grown) {}

    std::size_t boxes_entered(const std::array<double, 3>& o, const std::array<double, 3>& d) const {
        double t = INFINITY;
        for (const BuildSphere& s : grown_.spheres) {
            const std::array<double, 3> f{s.x - o[0], s.y - o[1], s.z - o[2]};
            const double b = f[0] * d[0] + f[1] * d[1] + f[2] * d[2];
            const double c = f[0] * f[0] + f[1] * f[1] + f[2] * f[2] - double{s.radius} * s.radius;
            if (c > 0 && b > 0 && b * b > c) t = std::min(t, b - std::sqrt(b * b - c));
        }
        return count(0, o, d, t);
    }

private:
    std::size_t count(std::uint32_t index, const std::array<double, 3>& o, const std::array<double, 3>& d,
                      double limit) const {
        const Node& node = grown_.tree.nodes[index];
        std::size_t entered = 0;
        for (std::size_t c = 0; c < tree_width; ++c) {
            const Extremes box = box_of(node, c);
            double enter = 0, leave = limit;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double a = (box.low[axis] - o[axis]) / d[axis], b = (box.high[axis] - o[axis]) / d[axis];
                enter = std::max(enter, std::min(a, b));
                leave = std::min(leave, std::max(a, b));
            }
            if (!used(node, c) || enter > leave) continue;
            ++entered;
            if ((node.child[c] & leaf_bit) == 0) entered += count(node.child[c], o, d, limit);
        }
        return entered;
    }
    const Grown& grown_;
};

// Sixty-four times the spheres may cost a constant more, not a constant factor: the growth is that of the logarithm.
TEST(Tree, CostGrowsWithTheLogarithm) {
    std::vector<double> cost;
    for (const std::uint32_t count : {1u << 8, 1u << 11, 1u << 14, 1u << 17}) {
        const Grown grown(random_spheres(count));
        const Walk walk(grown);
        std::mt19937 random(1);
        std::normal_distribution<double> normal;
        constexpr int rays = 100;
        std::size_t entered = 0;
        for (int i = 0; i < rays; ++i) {
            std::array<double, 3> d{normal(random), normal(random), normal(random)};
            const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            for (double& x : d) x /= length;
            entered += walk.boxes_entered({0.5, 0.5, 0.5}, d);
        }
        cost.push_back(static_cast<double>(entered) / rays);
    }
    for (std::size_t i = 1; i + 1 < cost.size(); ++i)
        EXPECT_LT(cost[i + 1] - cost[i], 1.3 * (cost[i] - cost[i - 1]) + 1);
}

}  // namespace
}  // namespace orrery
