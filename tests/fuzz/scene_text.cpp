#include "scene_text.hpp"

#include <nlohmann/json.hpp>

#include "scene/settings.hpp"
#include "support/setting_json.hpp"

namespace orrery::fuzz {

namespace {

using Json = nlohmann::ordered_json;

Json triple(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json camera(const Camera& c) {
    Json json{{"id", "camera"},
              {"type", c.aperture > 0 ? "lens-based" : "pinhole"},
              {"fov", c.fov},
              {"aspect", c.aspect},
              {"position", triple(c.position)},
              {"target", triple(c.target)}};
    if (c.aperture > 0) json["alpha"] = c.aperture, json["focal distance"] = c.focal_distance;
    return json;
}

Json material(const Material& m) {
    constexpr const char* types[] = {"diffuse", "specular reflection", "glossy reflection", "fresnel dielectric",
                                     "fresnel dielectric"};
    Json json{{"id", m.id}, {"type", types[static_cast<std::size_t>(m.kind)]}};
    const bool dielectric = m.kind == MaterialKind::dielectric || m.kind == MaterialKind::translucent;
    json[dielectric ? "rhoR" : "rho"] = triple(m.rho);
    if (dielectric) json["rhoT"] = triple(m.rho_t), json["eta"] = m.eta;
    if (m.roughness > 0) json["roughness"] = m.roughness;
    return json;
}

Json renderer(const RenderSettings& settings) {
    Json json;
    for (const Setting& setting : all_settings())
        json[std::string(setting.key)] = test::in_file<Json>(setting, setting.member.get(settings));
    return json;
}

}  // namespace

std::string scene_text(const Scene& scene) {
    Json materials = Json::array(), shapes = Json::array(), lights = Json::array(), listed = Json::array(),
         primitives = Json::array();
    for (const Material& m : scene.materials) materials.push_back(material(m));
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& p = scene.primitives[i];
        const std::string number = std::to_string(i), shape = "s" + number, light = "a" + number;
        shapes.push_back({{"id", shape}, {"type", "sphere"}, {"centre", triple(p.centre)}, {"radius", p.radius}});
        Json primitive{{"id", p.id},
                       {"type", p.emission ? "emissive" : "geometric"},
                       {"shape", shape},
                       {"material", scene.materials[p.material].id}};
        if (p.emission) {
            lights.push_back({{"id", light}, {"type", "area"}, {"shape", shape}, {"power", triple(*p.emission)}});
            listed.push_back(light);
            primitive["light"] = light;
        }
        primitives.push_back(std::move(primitive));
    }
    for (std::size_t i = 0; i < scene.point_lights.size(); ++i) {
        const PointLight& l = scene.point_lights[i];
        const std::string id = "l" + std::to_string(i);
        lights.push_back(
            {{"id", id}, {"type", "point"}, {"position", triple(l.position)}, {"power", triple(l.intensity)}});
        listed.push_back(id);
    }
    const Json root{{"cameras", Json::array({camera(scene.camera)})},
                    {"materials", materials},
                    {"shapes", shapes},
                    {"lights", lights},
                    {"scene",
                     {{"camera", "camera"},
                      {"lights", listed},
                      {"primitives", primitives},
                      {"background", triple(scene.background)},
                      {"renderer", renderer(scene.settings)}}}};
    return root.dump(1);
}

}  // namespace orrery::fuzz
