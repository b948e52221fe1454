#include "worlds/dice.hpp"
#include "worlds/palette.hpp"
#include "worlds/world.hpp"

namespace orrery::worlds {

World lattice(std::uint64_t spheres, std::uint32_t seed) {
    World world = studio();
    std::uint64_t side = 1;
    while (side * side * side < spheres) ++side;
    constexpr double edge = 1.3;  // of the whole cube: its corners lie about where the ball of the other worlds ends
    const double step = edge / static_cast<double>(side);
    world.sphere = [=, paints = world.materials.size()](std::uint64_t i) {
        const auto at = [&](std::uint64_t n) { return (static_cast<double>(n) + 0.5) * step - edge / 2; };
        const glm::dvec3 centre(at(i % side), at(i / (side * side)), at(i / side % side));
        return Sphere{centre, 0.35 * step, static_cast<std::uint32_t>(Dice(seed, 0, i).bits() % paints)};
    };
    return world;
}

}  // namespace orrery::worlds
