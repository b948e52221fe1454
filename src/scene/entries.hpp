// The four registries: what a camera, material, shape or light entry holds.
#pragma once

#include <glm/vec3.hpp>
#include <variant>

#include "scene/references.hpp"
#include "scene/registry.hpp"
#include "scene/scene.hpp"

namespace orrery {

struct Sphere {
    glm::dvec3 centre{0};
    double radius = 1;
};

struct AreaLight {
    std::string_view shape;  ///< an id
    glm::dvec3 radiance{0};
};

using Light = std::variant<PointLight, AreaLight>;

struct Registries {
    Registry<Camera> cameras;
    Registry<Material> materials;
    Registry<Sphere> shapes;
    Registry<Light> lights;
};

/// Reads all four. Faults of entries outside `used` are warnings.
Registries read_registries(Fields& root, const References& used, Report& report);

}  // namespace orrery
