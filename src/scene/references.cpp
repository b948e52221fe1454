#include "scene/references.hpp"

#include <string_view>

namespace orrery {
namespace {

class Finder {
public:
    explicit Finder(const JsonTree& tree) : tree_(tree) {}

    const JsonValue* member(const JsonValue& object, std::string_view key) const {
        if (object.kind != JsonKind::object) return nullptr;
        for (std::size_t i = 0; i < object.size; ++i) {
            const JsonValue& value = tree_.child(object, i);
            if (tree_.names().text(value.key_name()) == key) return &value;
        }
        return nullptr;
    }

    void insert_text(NameSet& ids, const JsonValue* value) const {
        if (value && value->is_text()) ids.insert(value->name());
    }

    template <class Visit>
    void each(const JsonValue* list, const Visit& visit) const {
        if (!list || list->kind != JsonKind::list) return;
        for (std::size_t i = 0; i < list->size; ++i) visit(tree_.child(*list, i));
    }

private:
    const JsonTree& tree_;
};

}  // namespace

References find_references(const JsonTree& tree) {
    References ids;
    const Finder find(tree);
    const JsonValue* scene = find.member(tree.root(), "scene");
    if (!scene) return ids;

    find.insert_text(ids.cameras, find.member(*scene, "camera"));
    find.each(find.member(*scene, "lights"), [&](const JsonValue& light) { find.insert_text(ids.lights, &light); });
    find.each(find.member(*scene, "primitives"), [&](const JsonValue& primitive) {
        find.insert_text(ids.shapes, find.member(primitive, "shape"));
        find.insert_text(ids.materials, find.member(primitive, "material"));
        find.insert_text(ids.lights, find.member(primitive, "light"));
    });
    return ids;
}

}  // namespace orrery
