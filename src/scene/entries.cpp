#include "scene/entries.hpp"

#include <glm/geometric.hpp>

namespace orrery {
namespace {

/// Below this a perturbation is lost when added to a unit direction in single precision, and the density of the lobe,
/// of order 1 / roughness^2, leaves its range.
constexpr double least_roughness = 1e-6;

std::optional<Camera> read_camera(Fields& fields) {
    enum class Type { pinhole, lens };
    const auto type = fields.choice<Type>("type", {{"pinhole", Type::pinhole}, {"lens-based", Type::lens}});
    const auto fov = fields.number("fov", range::field_of_view);
    const auto aspect = fields.number("aspect", range::ratio);
    const auto position = fields.triple("position", range::coordinate);
    const auto target = fields.triple("target", range::coordinate);
    fields.ignore("distance");  // image-plane distance: it scales with the plane and changes nothing

    // A camera of unknown type gets no remark about the fields of a lens.
    std::optional<double> aperture = 0, focal_distance = 1;
    if (type == Type::lens) {
        aperture = fields.number("alpha", range::length_or_zero);
        focal_distance = fields.number("focal distance", range::length);
    } else if (!type) {
        fields.ignore("alpha");
        fields.ignore("focal distance");
    }

    if (position && target && glm::distance(*position, *target) < range::length.smallest) {
        fields.fault("target", "found the camera's own position, expected another point to look at");
        return std::nullopt;
    }
    if (!type || !fov || !aspect || !position || !target || !aperture || !focal_distance) return std::nullopt;
    return Camera{*position, *target, *fov, *aspect, *aperture, *focal_distance};
}

std::optional<double> read_roughness(Fields& fields) {
    const auto roughness = fields.number("roughness", range::roughness);
    if (roughness && *roughness > 0 && *roughness < least_roughness) {
        fields.warn("roughness",
                    fmt::format("found {}, which is taken for 0: single precision loses a roughness below {}",
                                *roughness, least_roughness));
        return 0;
    }
    return roughness;
}

std::optional<Material> read_material(Fields& fields) {
    // The type as written; a roughness of zero makes it a simpler kind.
    const auto type = fields.choice<MaterialKind>("type", {{"diffuse", MaterialKind::diffuse},
                                                           {"specular reflection", MaterialKind::specular},
                                                           {"glossy reflection", MaterialKind::glossy},
                                                           {"fresnel dielectric", MaterialKind::dielectric}});
    if (!type) {
        for (const char* key : {"rho", "rhoR", "rhoT", "eta", "roughness"}) fields.ignore(key);
        return std::nullopt;
    }
    Material material;
    material.kind = *type;
    if (*type != MaterialKind::dielectric) {
        const auto rho = fields.triple("rho", range::reflectance);
        const auto roughness = *type == MaterialKind::glossy ? read_roughness(fields) : 0;
        if (!rho || !roughness) return std::nullopt;
        material.rho = *rho;
        material.roughness = *roughness;
        if (*type == MaterialKind::glossy && *roughness == 0) material.kind = MaterialKind::specular;
        return material;
    }
    const auto rho_r = fields.triple("rhoR", range::reflectance);
    const auto rho_t = fields.triple("rhoT", range::reflectance);
    const auto eta = fields.number("eta", range::ratio);
    const auto roughness = fields.has("roughness") ? read_roughness(fields) : 0;
    if (!rho_r || !rho_t || !eta || !roughness) return std::nullopt;
    material.rho = *rho_r;
    material.rho_t = *rho_t;
    material.eta = *eta;
    material.roughness = *roughness;
    if (*roughness > 0) material.kind = MaterialKind::translucent;
    return material;
}

std::optional<Sphere> read_shape(Fields& fields) {
    enum class Type { sphere };
    const auto type = fields.choice<Type>("type", {{"sphere", Type::sphere}});
    const auto centre = fields.triple("centre", range::coordinate);
    const auto radius = fields.number("radius", range::length);
    if (!type || !centre || !radius) return std::nullopt;
    return Sphere{*centre, *radius};
}

std::optional<Light> read_light(Fields& fields, const Registry<Sphere>& shapes, Report& report) {
    enum class Type { point, area };
    const auto type = fields.choice<Type>("type", {{"point", Type::point}, {"area", Type::area}});
    const auto power = fields.triple("power", range::radiance);
    if (!type) {
        fields.ignore("position");
        fields.ignore("shape");
        return std::nullopt;
    }
    if (*type == Type::point) {
        const auto position = fields.triple("position", range::coordinate);
        if (!power || !position) return std::nullopt;
        return PointLight{.id = {}, .position = *position, .intensity = *power};
    }
    const auto shape = fields.any("shape", "the id of a shape");
    if (!shape) return std::nullopt;
    look_up(*shape, shapes, fields, report);
    const auto id = shape->text();
    if (!power || !id || !shapes.entries.contains(*id)) return std::nullopt;
    return AreaLight{*id, *power};
}

}  // namespace

Registries read_registries(Fields& root, const References& used, Report& report) {
    Registries registries;
    registries.cameras = read_registry<Camera>(root, "cameras", "camera", used.cameras, report, read_camera);
    registries.materials =
        read_registry<Material>(root, "materials", "material", used.materials, report, read_material);
    registries.shapes = read_registry<Sphere>(root, "shapes", "shape", used.shapes, report, read_shape);
    registries.lights = read_registry<Light>(root, "lights", "light", used.lights, report, [&](Fields& fields) {
        return read_light(fields, registries.shapes, report);
    });
    return registries;
}

}  // namespace orrery
