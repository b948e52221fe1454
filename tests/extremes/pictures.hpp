// Whole pictures, where an extreme is one of the pipeline and not of a formula.
#pragma once

#include <glm/vec3.hpp>

#include "wavefront/render.hpp"

namespace orrery::extremes {

inline Scene picture(const glm::dvec3& eye, const glm::dvec3& target, double fov, std::uint32_t size) {
    Scene scene;
    scene.camera.position = eye;
    scene.camera.target = target;
    scene.camera.fov = fov;
    scene.settings.width = scene.settings.height = size;
    return scene;
}

inline Material diffuse(double rho) { return {.id = "diffuse", .rho = glm::dvec3{rho}}; }
inline Material mirror(double rho) { return {.id = "mirror", .kind = MaterialKind::specular, .rho = glm::dvec3{rho}}; }

inline Primitive& add_sphere(Scene& scene, const glm::dvec3& centre, double radius, const Material& material) {
    scene.materials.push_back(material);
    const auto index = static_cast<std::uint32_t>(scene.materials.size() - 1);
    return scene.primitives.emplace_back(Primitive{"sphere", centre, radius, index, {}});
}
inline void add_lamp(Scene& scene, const glm::dvec3& centre, double radius, const glm::dvec3& radiance,
                     const Material& material) {
    add_sphere(scene, centre, radius, material).emission = radiance;
}
inline void add_point_light(Scene& scene, const glm::dvec3& position, const glm::dvec3& intensity) {
    scene.point_lights.push_back({"point", position, intensity});
}

/// One of those that agree to the byte, and SSE2.
inline std::vector<Isa> differing_isas() {
    std::vector<Isa> isas{best_isa()};
    if (best_isa() != Isa::sse2 && isa_supported(Isa::sse2)) isas.push_back(Isa::sse2);
    return isas;
}

inline RenderResult render(const Scene& scene, Isa isa) {
    RenderOptions options;
    options.threads = 1;
    options.isa = isa;
    return orrery::render(Plan(scene), options);
}

}  // namespace orrery::extremes
