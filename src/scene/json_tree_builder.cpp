#include "scene/json_tree_builder.hpp"

#include <fmt/format.h>

#include "scene/json_node.hpp"

namespace orrery {

bool JsonTreeBuilder::open(JsonKind kind) {
    if (frames_.size() == deepest_nesting) return false;
    frames_.push_back({.kind = kind, .base = values_.size(), .places = nullptr});
    return true;
}

void JsonTreeBuilder::close() {
    const auto [kind, base] = std::pair(frames_.back().kind, frames_.back().base);
    const std::uint64_t first = tree_.count_;
    const auto size = static_cast<std::uint32_t>(values_.size() - base);
    for (std::size_t i = base; i < values_.size(); ++i) {
        const std::size_t at = tree_.count_ % JsonTree::block;
        if (at == 0) tree_.blocks_.push_back(std::make_unique_for_overwrite<JsonValue[]>(JsonTree::block));
        tree_.blocks_.back()[at] = values_[i];
        ++tree_.count_;
    }
    values_.resize(base);
    frames_.pop_back();
    put(kind, first, size);
}

bool JsonTreeBuilder::key(std::string_view text) {
    Frame& object = frames_.back();
    object.key = tree_.names_.number(text);
    object.place = place_of(object);
    return object.place == values_.size();
}

/// The place of the member that has the object's current key; the end where none has.
std::size_t JsonTreeBuilder::place_of(Frame& object) {
    constexpr std::size_t few = 16;
    const auto key = static_cast<std::uint32_t>(object.key);
    if (values_.size() - object.base < few) {
        for (std::size_t i = object.base; i < values_.size(); ++i)
            if (values_[i].key == key) return i;
        return values_.size();
    }
    if (!object.places) {
        object.places = std::make_unique<Places>();
        for (std::size_t i = object.base; i < values_.size(); ++i) object.places->emplace(+values_[i].key, i);
    }
    return object.places->emplace(key, values_.size()).first->second;
}

void JsonTreeBuilder::put(JsonKind kind, std::uint64_t bits, std::uint32_t size) {
    JsonValue value;
    value.kind = kind;
    value.size = size;
    value.bits = bits;
    if (frames_.empty()) {
        tree_.root_ = value;
        return;
    }
    const Frame& parent = frames_.back();
    if (parent.kind == JsonKind::object) {
        value.key = static_cast<std::uint32_t>(parent.key) & 0x1FFFFFFF;
        if (parent.place < values_.size()) {
            values_[parent.place] = value;
            return;
        }
    }
    values_.push_back(value);
}

std::string JsonTreeBuilder::where() const {
    std::string pointer;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        const Frame& frame = frames_[i];
        if (frame.kind == JsonKind::object) {
            pointer += '/' + pointer_token(tree_.names_.text(frame.key));
        } else {
            const std::size_t end = i + 1 < frames_.size() ? frames_[i + 1].base : values_.size();
            pointer += fmt::format("/{}", end - frame.base);
        }
    }
    return pointer;
}

}  // namespace orrery
