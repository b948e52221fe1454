// A JSON value together with the way to it, so that a fault can name its place.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "scene/json_tree.hpp"

namespace orrery {

/// A value and its chain of parents. The pointer is spelt out only when a fault asks for it: a good file of a million
/// spheres builds no strings. A node refers to its parent, which must outlive it.
class Node {
public:
    explicit Node(const JsonTree& tree) : tree_(&tree), value_(&tree.root()) {}
    /// A member of the object `parent`, be it `value` or missing there.
    Node(const Node& parent, std::string_view key, const JsonValue& value)
        : tree_(parent.tree_), value_(&value), parent_(&parent), key_(key) {}
    /// Element `index` of the list `parent`.
    Node(const Node& parent, std::size_t index)
        : tree_(parent.tree_), value_(&tree_->child(*parent.value_, index)), parent_(&parent), index_(index) {}

    const JsonValue& value() const { return *value_; }
    bool is_list() const { return value_->kind == JsonKind::list; }
    bool is_object() const { return value_->kind == JsonKind::object; }
    std::size_t size() const { return value_->size; }  ///< of a list or an object

    const JsonValue& member(std::size_t index) const { return tree_->child(*value_, index); }
    std::string_view key(const JsonValue& member) const { return text(member.key_name()); }

    std::optional<Name> name() const { return value_->is_text() ? std::optional(value_->name()) : std::nullopt; }
    std::string_view text(Name name) const { return tree_->names().text(name); }

    /// RFC 6901 pointer from the root, e.g. "/scene/primitives/3/material".
    std::string where() const;

    /// where() of a key of this object, be it there or not.
    std::string where(std::string_view key) const;

    /// The value as a message names it after "found": `-1.5`, `"grey"`, `a list of 3`, `an object`, `null`.
    std::string describe() const;

private:
    const JsonTree* tree_;
    const JsonValue* value_;
    const Node* parent_ = nullptr;
    std::string_view key_;
    std::size_t index_ = 0;
};

/// A key as a token of a pointer: "~" and "/" escaped, anything unprintable escaped, long keys shortened.
std::string pointer_token(std::string_view key);

}  // namespace orrery
