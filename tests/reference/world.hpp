// Rays, the spheres they hit, and the camera they come from (scenes/README.md).
#pragma once

#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "reference/random.hpp"
#include "scene/scene.hpp"

namespace orrery::reference {

inline constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

struct Ray {
    glm::dvec3 origin{0};
    glm::dvec3 direction{0, 0, 1};  ///< unit length
    std::size_t left = nothing;     ///< the sphere whose surface `origin` lies on
};

struct Hit {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t sphere = nothing;  ///< `nothing`: the ray meets the enclosing volume
    bool inside = false;           ///< hit from within the sphere
};

/// First sphere along the ray.
Hit closest_hit(const std::vector<Primitive>& spheres, const Ray& ray);

/// The point hit, put back on its sphere: O + tD strays from it by rounding in t times its size.
glm::dvec3 surface_point(const Primitive& sphere, const Ray& ray, double distance);

/// A ray through a uniform point of pixel (x, y), or of the lens and that point in focus.
Ray camera_ray(const Scene& scene, std::uint32_t x, std::uint32_t y, Random& random);

/// What DEPTH sees where nothing is hit: more than any hit distance from any point of the lens.
double greatest_distance(const Scene& scene);

}  // namespace orrery::reference
