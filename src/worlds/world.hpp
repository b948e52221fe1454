// What a generated world is: a view, lights, materials, and a rule that gives its spheres one by one.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace orrery::worlds {

struct Sphere {
    glm::dvec3 centre{0};
    double radius = 1;
    std::uint32_t material = 0;  ///< index into World::materials
};

struct Paint {
    std::string id;
    std::string type;  ///< a material type of scene files that has a single `rho`
    glm::dvec3 rho{0};
    double roughness = 0;  ///< `glossy reflection` only
};

struct Lamp {
    std::string id;
    glm::dvec3 position{0};
    glm::dvec3 intensity{0};
};

struct World {
    glm::dvec3 eye{0}, target{0};
    double fov = 40;
    glm::dvec3 background{0};
    std::vector<Paint> materials;
    std::vector<Lamp> lamps;
    /// Sphere i of those asked for; a pure function.
    std::function<Sphere(std::uint64_t)> sphere;
};

enum class Kind : std::uint8_t { random, lattice, cluster, cosmos };
inline constexpr std::string_view kind_names[] = {"random", "lattice", "cluster", "cosmos"};

/// The world of a kind. The same number and seed make the same world.
World make_world(Kind kind, std::uint64_t spheres, std::uint32_t seed);

// The kinds one by one. Each fills the picture alike for any number of spheres: the more there are the smaller they
// are.

/// Strewn evenly in a ball, sizes within a factor of three, 6 % of the room taken.
World random_ball(std::uint64_t spheres, std::uint32_t seed);

/// A cube of equal spheres in rows, filled from the bottom; painted at random.
World lattice(std::uint64_t spheres, std::uint32_t seed);

/// Dense knots with emptiness between them: what a grid of equal cells is bad at.
World clusters(std::uint64_t spheres, std::uint32_t seed);

/// Spiral galaxies of many sizes and tilts; radii of stars follow a power law over two orders of magnitude.
World cosmos(std::uint64_t spheres, std::uint32_t seed);

}  // namespace orrery::worlds
