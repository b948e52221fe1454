#include "plan/unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace orrery {

namespace {

constexpr int float_span = 60;           // of lengths, in powers of two
constexpr double float_power = 0x1p120;  // an intensity may be so large, or its inverse so small

double farthest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

LengthUnit length_unit(const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = farthest(scene.camera.position) + scene.camera.aperture / 2;
    for (const Primitive& p : scene.primitives) {
        smallest = std::min(smallest, p.radius);
        largest = std::max(largest, farthest(p.centre) + p.radius);
    }
    for (const PointLight& light : scene.point_lights) largest = std::max(largest, farthest(light.position));
    if (scene.primitives.empty()) smallest = largest;
    if (largest == 0) return {};
    const int sum = std::ilogb(smallest) + std::ilogb(largest);
    return {std::ldexp(1.0, (sum - (sum & 1)) / 2), smallest, largest};
}

std::optional<std::string> out_of_float_range(const Scene& scene, const LengthUnit& unit) {
    if (unit.largest > 0 && std::ilogb(unit.largest) - std::ilogb(unit.smallest) > float_span)
        return fmt::format("lengths from {:.2g} to {:.2g} are too far apart for the exponents of float", unit.smallest,
                           unit.largest);
    for (const PointLight& light : scene.point_lights) {
        for (int c = 0; c < 3; ++c) {
            const double power = unit.intensity(light.intensity[c]);
            if (power == 0 || (power < float_power && power > 1 / float_power)) continue;
            return fmt::format(
                "a point light of {:.2g} W/sr among lengths from {:.2g} to {:.2g} is out of float's range",
                light.intensity[c], unit.smallest, unit.largest);
        }
    }
    return std::nullopt;
}

}  // namespace orrery
