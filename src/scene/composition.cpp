#include "scene/composition.hpp"

#include <algorithm>
#include <utility>

namespace orrery {
namespace {

/// Reads the primitives, and remembers what the lights need to know of them.
class Primitives {
public:
    Primitives(const Registries& registries, Report& report, Scene& scene)
        : registries_(registries), report_(report), scene_(scene) {}

    void read(const Node& list) {
        // A list that names the same few shapes over and over is mostly wrong.
        scene_.primitives.reserve(std::min(list.size(), registries_.shapes.entries.size()));
        for (std::size_t i = 0; i < list.size(); ++i) read_one(list, i);
    }

    /// Whether an emissive primitive carries the light. True as well when a faulty primitive might have been meant to.
    bool carries(std::string_view light) const { return some_carrier_unknown_ || carried_.contains(light); }

private:
    enum class Type { geometric, emissive };

    void read_one(const Node& list, std::size_t index) {
        const Node node(list, index);
        Fields fields(node, "a primitive object", report_);
        const auto label = fields.has("id") ? fields.text("id", "a string") : std::nullopt;
        const auto type = fields.choice<Type>("type", {{"geometric", Type::geometric}, {"emissive", Type::emissive}});
        const auto shape = fields.any("shape", "the id of a shape");
        const auto material = fields.any("material", "the id of a material");
        const Sphere* sphere = shape ? look_up(*shape, registries_.shapes, fields, report_) : nullptr;
        const Material* surface = material ? look_up(*material, registries_.materials, fields, report_) : nullptr;
        const AreaLight* light = nullptr;
        if (type == Type::emissive) light = read_light(fields, shape ? shape->text() : std::nullopt);
        if (!type) {
            fields.ignore("light");
            some_carrier_unknown_ = true;
        }
        fields.finish();
        if (!sphere || !surface || !type || (*type == Type::emissive && !light)) return;

        Primitive primitive;
        if (label) primitive.id = *label;
        primitive.centre = sphere->centre;
        primitive.radius = sphere->radius;
        primitive.material = material_index(*material, *surface);
        if (light) primitive.emission = light->radiance;
        scene_.primitives.push_back(std::move(primitive));
    }

    const AreaLight* read_light(Fields& fields, std::optional<std::string_view> shape) {
        const auto node = fields.any("light", "the id of an area light");
        const Light* light = node ? look_up(*node, registries_.lights, fields, report_) : nullptr;
        const auto* area = light ? std::get_if<AreaLight>(light) : nullptr;
        if (!area) some_carrier_unknown_ = true;
        if (!light) return nullptr;

        const std::string_view id = *node->text();
        if (!area) {
            fields.fault("light",
                         fmt::format("found the point light {}, expected the id of an area light", in_quotes(id)));
            return nullptr;
        }
        carried_.insert(id);
        if (shape && area->shape != *shape) {
            fields.fault("light",
                         fmt::format("found {}, a light of shape {}, expected one of this primitive's shape {}",
                                     in_quotes(id), in_quotes(area->shape), in_quotes(*shape)));
            return nullptr;
        }
        return area;
    }

    /// Materials enter the scene on first use, so that none is there that no primitive wears.
    std::uint32_t material_index(const Node& id, const Material& material) {
        const auto next = static_cast<std::uint32_t>(scene_.materials.size());
        const auto [index, is_new] = material_indices_.try_emplace(*id.text(), next);
        if (is_new) {
            scene_.materials.push_back(material);
            scene_.materials.back().id = *id.text();
        }
        return index->second;
    }

    const Registries& registries_;
    Report& report_;
    Scene& scene_;
    std::map<std::string_view, std::uint32_t> material_indices_;
    std::set<std::string_view> carried_;
    bool some_carrier_unknown_ = false;
};

void read_lights(const Node& list, const Registries& registries, const Primitives& primitives, Fields& owner,
                 Report& report, Scene& scene) {
    std::set<std::string_view> listed;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Node node(list, i);
        const Light* light = look_up(node, registries.lights, owner, report);
        if (!light) continue;
        const std::string_view id = *node.text();
        if (!listed.insert(id).second) {
            report.add(
                Severity::warning, node.where(),
                fmt::format("found the light {} a second time, expected it once; it shines once", in_quotes(id)));
            continue;
        }
        if (const auto* point = std::get_if<PointLight>(light)) {
            scene.point_lights.push_back(*point);
            scene.point_lights.back().id = id;
        } else if (!primitives.carries(id)) {
            owner.fault_at(node,
                           fmt::format("found the area light {}, which no primitive carries, expected an emissive "
                                       "primitive with this light",
                                       in_quotes(id)));
        }
    }
}

}  // namespace

void read_composition(Fields& fields, const Registries& registries, Report& report, Scene& scene) {
    const auto camera_id = fields.any("camera", "the id of a camera");
    if (camera_id) {
        if (const Camera* camera = look_up(*camera_id, registries.cameras, fields, report)) scene.camera = *camera;
    }
    const auto lights = fields.list("lights", "a list of light ids (empty will do)");
    const auto list = fields.list("primitives", "a list of primitives (empty will do)");
    Primitives primitives(registries, report, scene);
    if (list) primitives.read(*list);
    if (lights && list) read_lights(*lights, registries, primitives, fields, report, scene);
    if (fields.has("background")) {
        if (const auto background = fields.triple("background", range::radiance)) scene.background = *background;
    }
}

}  // namespace orrery
