// A ray against spheres the way a textbook has it, in extended precision: what `intersect`, `shadow` and the segments
// are compared with. Nothing here is how the kernels do it.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "world.hpp"

namespace orrery::kernel_tests {

/// Both solutions of |o + t d - c|^2 = r^2, and how badly conditioned they are: the error of a root found in floats is
/// a few 2^-24 of `reach`. That is the distance to the centre, f, times 1 + r/s + f/q: the half chord s inherits the
/// rounding of the perpendicular, and the root c/q the cancellation in c = f^2 - r^2 close to a large sphere.
struct Roots {
    bool real = false;
    double near = 0, far = 0;
    double reach = 0;
    double slack = 0;  ///< how far the line passes inside the sphere's outline, in units of 2^-24 |o - c|
};

inline Roots roots(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& centre, double radius) {
    using Wide = long double;
    const Wide fx = Wide{o.x} - centre.x, fy = Wide{o.y} - centre.y, fz = Wide{o.z} - centre.z;
    const Wide a = Wide{d.x} * d.x + Wide{d.y} * d.y + Wide{d.z} * d.z;
    const Wide b = fx * d.x + fy * d.y + fz * d.z;
    const Wide ff = fx * fx + fy * fy + fz * fz;
    const Wide discriminant = b * b - a * (ff - Wide{radius} * radius);
    const Wide distance = std::sqrt(ff);
    Roots r;
    const Wide passes = std::sqrt(std::max(Wide{0}, ff - b * b / a));
    r.slack = static_cast<double>((radius - passes) / (Wide{0x1p-24} * distance));
    if (discriminant <= 0) return r;
    const Wide s = std::sqrt(discriminant);
    r.real = true;
    r.near = static_cast<double>((-b - s) / a);
    r.far = static_cast<double>((-b + s) / a);
    const Wide scale = std::max(distance, Wide{radius});
    r.reach = static_cast<double>(scale * (1 + radius / s + scale / (std::abs(b) + s)));
    return r;
}

/// The closest hit in (t_min, t_max) of a ray that leaves `left`.
struct Meeting {
    double t = std::numeric_limits<double>::infinity();
    std::uint32_t id = kernels::no_sphere;  ///< with inside_bit
    double reach = 0;
    /// Within float rounding the line grazes some sphere, an end of the segment lies on it, or two hits are equally
    /// far: floats may answer either way.
    bool open = false;
};

inline Meeting meet(const World& world, const glm::dvec3& o, const glm::dvec3& d, std::uint32_t left, double t_min = 0,
                    double t_max = std::numeric_limits<double>::infinity(), std::uint32_t skip = kernels::no_sphere) {
    constexpr double graze = 16;  // units of rounding
    Meeting best;
    best.t = t_max;
    const auto offer = [&](double t, std::uint32_t id, double reach) {
        const double rounding = graze * 0x1p-24 * reach;
        if (std::abs(t - t_min) < rounding || std::abs(t - best.t) < rounding) best.open = true;
        if (t > t_min && t < best.t) best.t = t, best.id = id, best.reach = reach;
    };
    for (std::uint32_t k = 0; k < world.spheres.count; ++k) {
        if (k == skip) continue;
        const Roots r = roots(o, d, world.centre(k), world.radius(k));
        if (k == (left & kernels::no_sphere)) {
            // Of the sphere it leaves it meets the far side if it goes inward, and nothing else. The origin lies on the
            // sphere up to a rounding of its own coordinates, which the root inherits at the angle of incidence.
            if ((left & kernels::inside_bit) == 0) continue;
            const double half_chord = (r.far - r.near) / 2;
            if (r.real) offer(r.far, left, (glm::length(o) + world.radius(k)) * (1 + world.radius(k) / half_chord));
            if (!r.real || std::abs(r.slack) < graze) best.open = true;
            continue;
        }
        if (std::abs(r.slack) < graze) best.open = true;
        if (!r.real) continue;
        offer(r.near, k, r.reach);
        offer(r.far, k | kernels::inside_bit, r.reach);
    }
    return best;
}

}  // namespace orrery::kernel_tests
