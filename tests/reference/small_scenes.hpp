// Scenes small enough to know the image of.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "reference/reference.hpp"
#include "scene/scene.hpp"

namespace orrery::reference {

/// A camera that looks from `eye` to `target` through one pixel so narrow that all its samples see the same point.
inline Scene looking(const glm::dvec3& eye, const glm::dvec3& target, std::uint32_t depth,
                     Integrator integrator = Integrator::path_tracing) {
    Scene scene;
    scene.camera.position = eye;
    scene.camera.target = target;
    scene.camera.fov = 1e-6;
    scene.settings.integrator = integrator;
    scene.settings.width = scene.settings.height = 1;
    scene.settings.depth = depth;
    scene.settings.samples = 2;
    return scene;
}

inline Material diffuse(const glm::dvec3& rho) { return {.id = "diffuse", .rho = rho}; }
inline Material mirror(double rho) { return {.id = "mirror", .kind = MaterialKind::specular, .rho = glm::dvec3{rho}}; }
inline Material glossy(double rho, double roughness) {
    return {.id = "glossy", .kind = MaterialKind::glossy, .rho = glm::dvec3{rho}, .roughness = roughness};
}
/// Translucent where it is rough.
inline Material glass(double rho, double eta, double roughness = 0) {
    const MaterialKind kind = roughness > 0 ? MaterialKind::translucent : MaterialKind::dielectric;
    const glm::dvec3 both{rho};
    return {.id = "glass", .kind = kind, .rho = both, .rho_t = both, .eta = eta, .roughness = roughness};
}

inline Primitive& add_sphere(Scene& scene, const glm::dvec3& centre, double radius, const Material& material) {
    scene.materials.push_back(material);
    const auto index = static_cast<std::uint32_t>(scene.materials.size() - 1);
    return scene.primitives.emplace_back(Primitive{"sphere", centre, radius, index, {}});
}

/// A light that reflects nothing.
inline void add_light(Scene& scene, const glm::dvec3& centre, double radius, const glm::dvec3& radiance) {
    add_sphere(scene, centre, radius, diffuse(glm::dvec3{0})).emission = radiance;
}

/// Whole image, one channel.
inline statistics::Estimate estimate(const Scene& scene, const Options& options = {}, std::size_t channel = 0) {
    return render(scene, options).mean()[channel];
}

/// How many standard errors an estimate is off.
inline double deviation(const statistics::Estimate& value, double truth) {
    return (value.mean - truth) / value.standard_error();
}

}  // namespace orrery::reference
