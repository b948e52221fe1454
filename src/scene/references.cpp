#include "scene/references.hpp"

namespace orrery {
namespace {

const Json* member(const Json& object, std::string_view key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

const Json::array_t& members(const Json& object, std::string_view key) {
    static const Json::array_t none;
    const Json* list = member(object, key);
    const auto* array = list ? list->get_ptr<const Json::array_t*>() : nullptr;
    return array ? *array : none;
}

void insert_text(std::set<std::string_view>& ids, const Json* value) {
    if (value && value->is_string()) ids.insert(*value->get_ptr<const std::string*>());
}

}  // namespace

References find_references(const Json& root) {
    References ids;
    const Json* scene = member(root, "scene");
    if (!scene) return ids;

    insert_text(ids.cameras, member(*scene, "camera"));
    for (const Json& light : members(*scene, "lights")) insert_text(ids.lights, &light);
    for (const Json& primitive : members(*scene, "primitives")) {
        insert_text(ids.shapes, member(primitive, "shape"));
        insert_text(ids.materials, member(primitive, "material"));
        insert_text(ids.lights, member(primitive, "light"));
    }
    return ids;
}

}  // namespace orrery
