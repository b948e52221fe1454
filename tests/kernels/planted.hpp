// A world of spheres in the order of its tree, with the tree.
#pragma once

#include "plan/tree.hpp"
#include "world.hpp"

namespace orrery::kernel_tests {

class Planted {
public:
    explicit Planted(std::vector<Ball> balls) : tree_(plant(balls)), world_(balls) {
        world_.spheres.tree = {static_cast<std::uint32_t>(tree_.nodes.size()), tree_.nodes.data(), tree_.extent};
    }
    const World& operator*() const { return world_; }
    const World* operator->() const { return &world_; }
    /// The same spheres without the tree.
    kernels::SphereTable<float> bare() const {
        auto table = world_.spheres;
        table.tree = {};
        return table;
    }

private:
    /// Puts the balls in their tree's order.
    static Tree plant(std::vector<Ball>& balls) {
        std::vector<BuildSphere> spheres;
        for (const Ball& ball : balls)
            spheres.push_back({static_cast<float>(ball.centre.x), static_cast<float>(ball.centre.y),
                               static_cast<float>(ball.centre.z), static_cast<float>(ball.radius),
                               static_cast<std::uint32_t>(spheres.size())});
        Tree tree = build_tree(spheres);
        std::vector<Ball> ordered;
        for (const BuildSphere& s : spheres) ordered.push_back(balls[s.index]);
        balls = std::move(ordered);
        return tree;
    }

    Tree tree_;
    World world_;
};

}  // namespace orrery::kernel_tests
