#include "plan/require_valid.hpp"

#include <cmath>
#include <stdexcept>

#include "kernels/tables.hpp"

namespace orrery {

namespace {

void require(bool holds, const char* fault) {
    if (!holds) throw std::invalid_argument(fault);
}

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_light(const glm::dvec3& v) { return finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0; }
bool is_fraction(const glm::dvec3& v) { return is_light(v) && v.x <= 1 && v.y <= 1 && v.z <= 1; }
// Written so that what is no number fails.
bool positive(double x) { return x > 0 && std::isfinite(x); }

// Far beyond what a file may hold; but cubes of lengths have to be numbers, of double at least (unit.hpp).
bool is_place(const glm::dvec3& v) { return std::abs(v.x) <= 1e90 && std::abs(v.y) <= 1e90 && std::abs(v.z) <= 1e90; }
bool is_length(double x) { return x >= 1e-90 && x <= 1e90; }

void require_settings(const RenderSettings& s) {
    require(s.width > 0 && s.height > 0 && s.samples > 0, "an image needs pixels and samples");
    require(s.integrator != Integrator::whitted || s.depth <= 20, "Whitted ray tracing goes to depth 20");
}

void require_camera(const Camera& c) {
    require(is_place(c.position) && is_place(c.target) && c.position != c.target, "the camera looks nowhere");
    require(c.fov > 0 && c.fov < 180, "a field of view lies between 0 and 180 degrees");
    require(positive(c.aspect), "an aspect is positive");
    require(c.aperture >= 0 && std::isfinite(c.aperture), "an aperture is not negative");
    require(c.aperture == 0 || positive(c.focal_distance), "a lens needs a focal distance");
}

}  // namespace

void require_valid(const Scene& scene) {
    require_settings(scene.settings);
    require_camera(scene.camera);
    require(scene.materials.size() <= kernels::surface_material_mask, "more than 2^24 materials");
    require(is_light(scene.background), "a background is finite and not negative");
    for (const Material& m : scene.materials) {
        require(is_fraction(m.rho) && is_fraction(m.rho_t), "a reflectance lies in [0, 1]");
        require(positive(m.eta), "an index of refraction is positive");
        require(m.roughness >= 0 && m.roughness < 1, "a roughness lies in [0, 1)");
    }
    for (const Primitive& p : scene.primitives) {
        require(is_place(p.centre) && is_length(p.radius), "a sphere needs a centre and a positive radius");
        require(p.material < scene.materials.size(), "a primitive names no material");
        require(!p.emission || is_light(*p.emission), "emission is finite and not negative");
    }
    for (const PointLight& l : scene.point_lights)
        require(is_place(l.position) && is_light(l.intensity), "a point light's intensity is finite and not negative");
}

}  // namespace orrery
