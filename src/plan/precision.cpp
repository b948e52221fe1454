#include "plan/precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "plan/unit.hpp"
#include "system/printable.hpp"

namespace orrery {

namespace {

/// Errors are harmless up to this share of what is near.
constexpr double harmless = 1.0 / 16;

}  // namespace

std::optional<CoarsePositions> coarse_positions(const Scene& scene, Precision precision) {
    const double unit_roundoff = precision == Precision::binary64 ? 0x1p-53 : 0x1p-24;
    const Camera& camera = scene.camera;
    const double pixel = 2 * std::tan(camera.fov * std::numbers::pi / 360) / scene.settings.height;  // at distance 1
    double smallest = std::numeric_limits<double>::infinity();
    for (const Primitive& p : scene.primitives) smallest = std::min(smallest, p.radius);

    std::optional<CoarsePositions> worst;
    for (const Primitive& p : scene.primitives) {
        const glm::dvec3 c = glm::abs(p.centre);
        const double error = unit_roundoff * std::max({p.radius, c.x, c.y, c.z});
        const double distance = std::abs(glm::length(p.centre - camera.position) - p.radius);
        const double detail = std::min(smallest, distance);
        if (error <= pixel * distance || error <= harmless * detail) continue;
        if (!worst || error * worst->detail > worst->error * detail) worst = {p.id, p.radius, error, detail};
    }
    return worst;
}

std::string in_words(const CoarsePositions& coarse, Precision precision) {
    return fmt::format(
        "sphere {} of radius {:.2g}: positions are good to {:.1g} units in {}, details are as small as {:.2g}",
        in_quotes(coarse.id), coarse.radius, coarse.error, precision == Precision::binary64 ? "double" : "float",
        coarse.detail);
}

std::string reason_of_precision(const Scene& scene) {
    if (const auto reason = out_of_float_range(scene, length_unit(scene))) return *reason;
    if (const auto coarse = coarse_positions(scene, Precision::binary32)) return in_words(*coarse, Precision::binary32);
    return scene.settings.precision == Precision::binary64 ? "asked for; float would do"
                                                           : "float is good enough for positions in this scene";
}

}  // namespace orrery
