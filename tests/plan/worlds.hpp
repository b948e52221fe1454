// Worlds for planning: nothing here is ever rendered, so nothing needs to look like anything.
#pragma once

#include <array>

#include "plan/plan.hpp"

namespace orrery::test {

using glm::dvec3;

inline constexpr std::array<MaterialKind, 5> all_kinds = {MaterialKind::diffuse, MaterialKind::specular,
                                                          MaterialKind::glossy, MaterialKind::dielectric,
                                                          MaterialKind::translucent};

inline Scene empty_world() {
    Scene scene;
    scene.settings.width = scene.settings.height = 4;
    scene.settings.samples = 4;
    scene.settings.depth = 5;
    scene.settings.roulette_from = 0;
    scene.settings.precision = Precision::binary32;
    return scene;
}

inline Primitive& add(Scene& scene, MaterialKind kind) {
    Material material;
    material.kind = kind;
    material.rho = material.rho_t = dvec3{0.5};
    material.eta = 1.5;
    material.roughness = kind == MaterialKind::glossy || kind == MaterialKind::translucent ? 0.3 : 0;
    scene.materials.push_back(material);
    const auto count = static_cast<std::uint32_t>(scene.materials.size());
    return scene.primitives.emplace_back(Primitive{"", {0, 0, 3.0 * count}, 1, count - 1, {}});
}

/// A sphere of each kind.
inline Scene world(std::initializer_list<MaterialKind> kinds) {
    Scene scene = empty_world();
    for (const MaterialKind kind : kinds) add(scene, kind);
    return scene;
}

inline void add_area_light(Scene& scene, const dvec3& radiance = dvec3{1}) {
    add(scene, MaterialKind::diffuse).emission = radiance;
}

inline void add_point_light(Scene& scene, const dvec3& intensity = dvec3{1}) {
    scene.point_lights.push_back({"", {0, 5, 0}, intensity});
}

/// A length of the tables, in the scene's unit.
inline double of_scene(const Plan& plan, double length) { return length * plan.unit().length; }
inline dvec3 of_scene(const Plan& plan, const dvec3& lengths) { return lengths * plan.unit().length; }

inline Needs needs_of(const Scene& scene) { return Plan(scene).needs(); }

inline constexpr std::uint32_t bit(kernels::Scattering kind) { return 1u << static_cast<unsigned>(kind); }

}  // namespace orrery::test
