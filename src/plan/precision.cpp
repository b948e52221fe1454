#include "plan/precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "system/printable.hpp"

namespace orrery {

namespace {

/// Errors are harmless up to this share of what is near. Measured (PT and Whitted, a diffuse or glass ball on a ground
/// 2^17 times its size): the picture's mean is within 0.2 %, and ten times as far on a ground ten times as large.
constexpr double harmless = 1.0 / 128;

}  // namespace

std::optional<CoarsePositions> coarse_positions(const Scene& scene, Precision precision) {
    const Camera& camera = scene.camera;
    const double pixel = 2 * std::tan(camera.fov * std::numbers::pi / 360) / scene.settings.height;  // at distance 1
    double smallest = std::numeric_limits<double>::infinity();
    for (const Primitive& p : scene.primitives) smallest = std::min(smallest, p.radius);

    std::optional<CoarsePositions> worst;
    for (const Primitive& p : scene.primitives) {
        const glm::dvec3 c = glm::abs(p.centre);
        const double error = unit_roundoff(precision) * std::max({p.radius, c.x, c.y, c.z});
        const double distance = std::abs(glm::length(p.centre - camera.position) - p.radius);
        const double detail = std::min(smallest, distance);
        // Less than a pixel is not seen, but from nearby, in a small picture, a pixel is most of a sphere.
        if (error <= std::min(pixel, harmless) * distance || error <= harmless * detail) continue;
        if (!worst || error * worst->detail > worst->error * detail) worst = {p.id, p.radius, error, detail};
    }
    return worst;
}

std::string in_words(const CoarsePositions& coarse, Precision precision) {
    return fmt::format(
        "sphere {} of radius {:.2g}: positions are good to {:.1g} units in {}, details are as small as {:.2g}",
        in_quotes(coarse.id), coarse.radius, coarse.error, name_of(precision), coarse.detail);
}

std::optional<std::string> too_coarse(const Scene& scene, const LengthUnit& unit, Precision precision) {
    if (precision == Precision::binary32)
        if (auto reason = out_of_float_range(scene, unit)) return reason;
    if (const auto coarse = coarse_positions(scene, precision)) return in_words(*coarse, precision);
    return std::nullopt;
}

}  // namespace orrery
