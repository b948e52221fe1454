#include <algorithm>
#include <glm/geometric.hpp>

#include "worlds/dice.hpp"
#include "worlds/world.hpp"

namespace orrery::worlds {
namespace {

enum Stream : std::uint32_t { galaxies, stars };
enum Colour : std::uint32_t { blue, white, yellow, orange, red, nebula };

/// A disk with a bulge and arms.
struct Galaxy {
    glm::dvec3 middle, right, up, normal;  ///< the last three its own axes
    double size;                           ///< where its disk ends
    double winding;                        ///< radians of an arm from bulge to rim
    double arms;
};

/// Galaxy 0 is the large one in front; the others shrink into the distance.
Galaxy galaxy(std::uint32_t seed, std::uint64_t number) {
    Dice dice(seed, galaxies, number);
    Galaxy g;
    g.normal = number == 0 ? glm::normalize(glm::dvec3(0.35, 1, -0.55)) : dice.direction();
    g.right =
        glm::normalize(glm::cross(std::abs(g.normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), g.normal));
    g.up = glm::cross(g.normal, g.right);
    const double depth = dice.uniform(3, 30);
    const double across = 0.36 * (depth + 4);
    const double x = dice.uniform(-across, across);
    const double y = dice.uniform(-across, across);
    g.middle = number == 0 ? glm::dvec3(-0.1, -0.1, 0) : glm::dvec3(x, y, depth);
    g.size = dice.power_law(0.3, 3, 2);
    if (number == 0) g.size = 1.15;
    g.winding = dice.uniform(3, 7);
    if (dice.uniform() < 0.5) g.winding = -g.winding;
    g.arms = 2 + std::floor(dice.uniform() * 3);
    return g;
}

/// Half of all stars belong to galaxy 0, the others in equal parts to the rest.
std::uint64_t home(std::uint64_t star, std::uint64_t count) { return star % 2 == 0 ? 0 : 1 + star / 2 % (count - 1); }

}  // namespace

World cosmos(std::uint64_t spheres, std::uint32_t seed) {
    World world;
    world.eye = {0, 0.35, -2.9};
    world.target = {0, 0, 0};
    world.fov = 40;
    world.background = {0.012, 0.014, 0.03};
    world.materials = {{.id = "blue star", .type = "diffuse", .rho = {0.5, 0.7, 1}},
                       {.id = "white star", .type = "diffuse", .rho = {0.95, 0.95, 1}},
                       {.id = "yellow star", .type = "diffuse", .rho = {1, 0.9, 0.55}},
                       {.id = "orange star", .type = "diffuse", .rho = {1, 0.62, 0.3}},
                       {.id = "red star", .type = "diffuse", .rho = {0.95, 0.3, 0.2}},
                       {.id = "nebula", .type = "diffuse", .rho = {0.85, 0.35, 0.6}}};
    world.lamps = {{.id = "near", .position = {-2, 3, -4}, .intensity = {200, 190, 165}},
                   {.id = "far", .position = {8, 12, -8}, .intensity = {5000, 5300, 6500}}};

    const auto count = 2 + static_cast<std::uint64_t>(std::cbrt(static_cast<double>(spheres)) / 2);
    // Stars of the least size cover a fair part of their disk, whatever their number.
    const double least = 0.5 / std::sqrt(static_cast<double>(spheres) + 20);
    world.sphere = [=](std::uint64_t i) {
        const std::uint64_t number = home(i, count);
        const Galaxy g = galaxy(seed, number);
        Dice dice(seed, stars, i);
        const bool in_bulge = dice.uniform() < 0.25;
        const double u = dice.uniform();
        const double out = in_bulge ? 0.25 * u : std::sqrt(0.02 + 0.98 * u);
        glm::dvec3 local;
        if (in_bulge) {
            local = dice.direction() * out;
            local.z *= 0.6;
        } else {
            const double arm = std::floor(dice.uniform() * g.arms) / g.arms * 2 * std::numbers::pi;
            const double stray = dice.bell() * 1.35;
            const double angle = arm + g.winding * std::log(1 + 2 * out) / std::log(3.0) + stray;
            const double height = dice.bell() * 0.09 * (1.2 - out);
            local = {out * std::cos(angle), out * std::sin(angle), height};
        }
        const double share = number == 0 ? 1 : std::sqrt(static_cast<double>(count - 1));
        const double radius = g.size * std::min(0.035, share * least * dice.power_law(0.35, 35, 3.2));
        const glm::dvec3 centre = g.middle + g.size * (g.right * local.x + g.up * local.y + g.normal * local.z);
        const double hue = dice.uniform() + (in_bulge ? 0.35 : -0.25 * out);
        const Colour colour = hue < 0.05   ? nebula
                              : hue < 0.3  ? blue
                              : hue < 0.6  ? white
                              : hue < 0.85 ? yellow
                              : hue < 1.1  ? orange
                                           : red;
        return Sphere{centre, radius, colour};
    };
    return world;
}

}  // namespace orrery::worlds
