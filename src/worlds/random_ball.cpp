#include "worlds/dice.hpp"
#include "worlds/palette.hpp"
#include "worlds/world.hpp"

namespace orrery::worlds {

World random_ball(std::uint64_t spheres, std::uint32_t seed) {
    World world = studio();
    // Radii are `mean` times 0.5 to 1.5, whose mean cube is 1.25.
    constexpr double taken = 0.06;
    const double mean = std::cbrt(taken / 1.25 / static_cast<double>(spheres));
    world.sphere = [=, paints = world.materials.size()](std::uint64_t i) {
        Dice dice(seed, 0, i);
        const glm::dvec3 centre = dice.in_ball();
        const double radius = mean * dice.uniform(0.5, 1.5);
        return Sphere{centre, radius, static_cast<std::uint32_t>(dice.bits() % paints)};
    };
    return world;
}

}  // namespace orrery::worlds
