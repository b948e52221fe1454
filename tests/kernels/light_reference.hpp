// Densities of light sampling per solid angle, from the geometry (output/REPORT.md, task 3) and in double.
#pragma once

#include <glm/geometric.hpp>
#include <numbers>

#include "geometry.hpp"

namespace orrery::kernel_tests {

/// The part of the sphere of directions a ball subtends from outside: 2 pi (1 - cos a), sin a = r / d.
inline double solid_angle(const glm::dvec3& from, const glm::dvec3& centre, double radius) {
    const double half_angle = std::asin(radius / glm::length(centre - from));
    return 4 * std::numbers::pi * std::sin(half_angle / 2) * std::sin(half_angle / 2);
}

/// Density at `direction` of sampling the ball from `from`; the direction must meet it.
inline double light_density(kernels::LightStrategy strategy, const glm::dvec3& from, const glm::dvec3& direction,
                            const glm::dvec3& centre, double radius) {
    const bool inside = glm::length(from - centre) < radius;
    if (strategy == kernels::LightStrategy::cone && !inside) return 1 / solid_angle(from, centre, radius);
    // Uniform over the surface: 1/A, times d^2 / cos from area to solid angle, at the point first met.
    const Roots r = roots(from, direction, centre, radius);
    const double t = inside ? r.far : r.near;
    const glm::dvec3 n = (from + t * direction - centre) / radius;
    return t * t / (4 * std::numbers::pi * radius * radius * std::abs(glm::dot(n, glm::normalize(direction))));
}

}  // namespace orrery::kernel_tests
