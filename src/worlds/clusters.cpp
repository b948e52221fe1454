#include <algorithm>

#include "worlds/dice.hpp"
#include "worlds/palette.hpp"
#include "worlds/world.hpp"

namespace orrery::worlds {

World clusters(std::uint64_t spheres, std::uint32_t seed) {
    World world = studio();
    const auto knots = static_cast<std::uint64_t>(std::ceil(std::cbrt(static_cast<double>(spheres))));
    const double each = static_cast<double>(spheres) / static_cast<double>(knots);
    world.sphere = [=, paints = world.materials.size()](std::uint64_t i) {
        Dice knot(seed, 0, i % knots);
        const glm::dvec3 middle = knot.in_ball() * 0.85;
        const double size = knot.power_law(0.3, 3, 2.5) / std::cbrt(static_cast<double>(knots)) * 0.55;
        // Density falls with distance as d^-2: d uniform. Neighbours are then about d^(2/3) apart.
        Dice dice(seed, 1, i);
        const double d = dice.uniform();
        const glm::dvec3 centre = middle + dice.direction() * (d * size);
        const double apart = std::cbrt(4 * std::numbers::pi * d * d / each);
        const double radius = 0.3 * size * std::max(apart, 1 / each) * dice.uniform(0.6, 1.2);
        return Sphere{centre, radius, static_cast<std::uint32_t>(knot.bits() % paints)};
    };
    return world;
}

}  // namespace orrery::worlds
