// The reference's own random numbers: one splitmix64 stream per pixel.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace orrery::reference {

class Random {
public:
    /// A pure function of both, so an image does not depend on which thread renders which pixel.
    Random(std::uint64_t seed, std::uint64_t stream) : state_(mix(mix(seed) + stream)) {}

    /// Uniform on [0, 1).
    double uniform() { return static_cast<double>(mix(state_ += 0x9e3779b97f4a7c15u) >> 11) * 0x1p-53; }

    /// Uniform on the unit sphere.
    glm::dvec3 on_sphere() {
        const double z = 2 * uniform() - 1, azimuth = 2 * std::numbers::pi * uniform();
        const double radius = std::sqrt(1 - z * z);
        return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
    }

    /// Uniform over the unit directions whose angle with `axis` (of any length) has a cosine of `least_cosine` or more.
    glm::dvec3 in_cone(const glm::dvec3& axis, double least_cosine) {
        const glm::dvec3 z = glm::normalize(axis);
        const glm::dvec3 x =
            glm::normalize(glm::cross(z, std::abs(z.x) < 0.5 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0}));
        const double cosine = 1 - uniform() * (1 - least_cosine), azimuth = 2 * std::numbers::pi * uniform();
        const double sine = std::sqrt(1 - cosine * cosine);
        return cosine * z + sine * (std::cos(azimuth) * x + std::sin(azimuth) * glm::cross(z, x));
    }

    /// Uniform in the unit disk z = 0.
    glm::dvec3 in_disk() {
        for (;;) {
            const glm::dvec3 p{2 * uniform() - 1, 2 * uniform() - 1, 0};
            if (glm::dot(p, p) < 1) return p;
        }
    }

private:
    static std::uint64_t mix(std::uint64_t x) {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }
    std::uint64_t state_;
};

}  // namespace orrery::reference
