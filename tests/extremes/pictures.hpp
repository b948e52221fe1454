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

/// A way to compute a picture that has bits of its own.
struct Pipeline {
    const char* mode;
    Isa isa;
    Precision precision;
};
inline std::vector<Pipeline> pipelines() {
    std::vector<Pipeline> all{{"float", best_isa(), Precision::binary32}};
    if (best_isa() != Isa::sse2 && isa_supported(Isa::sse2))
        all.push_back({"float, SSE2", Isa::sse2, Precision::binary32});
    all.push_back({"double", best_isa(), Precision::binary64});
    return all;
}

inline RenderResult render(Scene scene, const Pipeline& how) {
    scene.settings.precision = how.precision;
    RenderOptions options;
    options.threads = 1;
    options.isa = how.isa;
    return orrery::render(Plan(std::move(scene)), options);
}

}  // namespace orrery::extremes
