#include "scene/valid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "scene/range.hpp"
#include "scene/settings.hpp"

namespace orrery {

namespace {

void require(bool holds, std::string_view what, std::string_view expected) {
    if (!holds) throw std::invalid_argument(fmt::format("{}: expected {}", what, expected));
}

void require_in(const Range& range, std::string_view what, double value) {
    if (const auto expected = expectation(range, value))
        throw std::invalid_argument(fmt::format("{}: found {}, expected {}", what, value, *expected));
}
void require_in(const Range& range, std::string_view what, const glm::dvec3& values) {
    for (int c = 0; c < 3; ++c) require_in(range, what, values[c]);
}

void require_settings(const RenderSettings& settings) {
    for (const Setting& setting : all_settings()) {
        const SettingValue value = setting.member.get(settings);
        const auto fits = [&](std::uint32_t x) {
            return setting.kind == SettingKind::word ? x < setting.words.size() : x >= setting.low && x <= setting.high;
        };
        require(fits(value[0]) && (setting.kind != SettingKind::size || fits(value[1])), setting.option,
                expected_text(setting));
    }
    for (const Conflict& conflict : conflicts(settings))
        throw std::invalid_argument(fmt::format("{}: {}", conflict.setting.option, conflict.message));
}

void require_camera(const Camera& c) {
    require_in(range::field_of_view, "fov", c.fov);
    require_in(range::ratio, "aspect", c.aspect);
    require_in(range::coordinate, "camera position", c.position);
    require_in(range::coordinate, "target", c.target);
    require(glm::distance(c.position, c.target) >= range::length.smallest, "target", "another point than the camera's");
    require_in(range::length_or_zero, "aperture", c.aperture);
    if (c.aperture > 0) require_in(range::length, "focal distance", c.focal_distance);
}

void require_material(const Material& m) {
    require_in(range::reflectance, "reflectance", m.rho);
    require_in(range::reflectance, "transmittance", m.rho_t);
    require_in(range::ratio, "eta", m.eta);
    require_in(range::roughness, "roughness", m.roughness);
    const bool rough = m.kind == MaterialKind::glossy || m.kind == MaterialKind::translucent;
    require(!rough || m.roughness > 0, "roughness", "more than 0 of a rough material");
}

}  // namespace

void require_valid(const Scene& scene) {
    require_settings(scene.settings);
    require_camera(scene.camera);
    std::ranges::for_each(scene.materials, require_material);
    for (const Primitive& p : scene.primitives) {
        require_in(range::coordinate, "centre", p.centre);
        require_in(range::length, "radius", p.radius);
        require(p.material < scene.materials.size(), "material", "one of the scene's");
        if (p.emission) require_in(range::radiance, "emission", *p.emission);
    }
    for (const PointLight& l : scene.point_lights) {
        require_in(range::coordinate, "light position", l.position);
        require_in(range::radiance, "intensity", l.intensity);
    }
    require_in(range::radiance, "background", scene.background);
}

}  // namespace orrery
