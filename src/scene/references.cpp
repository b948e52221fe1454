#include "scene/references.hpp"

namespace orrery {
namespace {

const Json& member(const Json& object, std::string_view key) {
    static const Json nothing;
    const auto found = object.find(key);
    return found != object.end() ? *found : nothing;
}

void insert_text(std::set<std::string_view>& ids, const Json& value) {
    if (const auto* id = value.get_ptr<const std::string*>()) ids.insert(*id);
}

const Json::array_t& list_of(const Json& value) {
    static const Json::array_t nothing;
    return value.is_array() ? value.get_ref<const Json::array_t&>() : nothing;
}

}  // namespace

References find_references(const Json& root) {
    References ids;
    const Json& scene = member(root, "scene");
    insert_text(ids.cameras, member(scene, "camera"));
    for (const Json& light : list_of(member(scene, "lights"))) insert_text(ids.lights, light);
    for (const Json& primitive : list_of(member(scene, "primitives"))) {
        insert_text(ids.shapes, member(primitive, "shape"));
        insert_text(ids.materials, member(primitive, "material"));
        insert_text(ids.lights, member(primitive, "light"));
    }
    return ids;
}

}  // namespace orrery
