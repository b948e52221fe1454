// A JSON value together with the way to it, so that a fault can name its place.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace orrery {

using Json = nlohmann::json;

/// A value and its chain of parents. The pointer is spelt out only when a fault asks for it: a good file of a million
/// spheres builds no strings. A node refers to its parent, which must outlive it.
class Node {
public:
    explicit Node(const Json& root) : value_(&root) {}
    /// A member of the object `parent`.
    Node(const Node& parent, std::string_view key, const Json& value) : value_(&value), parent_(&parent), key_(key) {}
    /// Element `index` of the list `parent`.
    Node(const Node& parent, std::size_t index) : value_(&(*parent.value_)[index]), parent_(&parent), index_(index) {}

    const Json& value() const { return *value_; }
    bool is_list() const { return value_->is_array(); }
    bool is_object() const { return value_->is_object(); }
    std::size_t size() const { return value_->size(); }  ///< of a list or an object

    /// The text it holds, where it holds one; it lives as long as the tree.
    std::optional<std::string_view> text() const {
        const auto* text = value_->get_ptr<const std::string*>();
        return text ? std::optional<std::string_view>(*text) : std::nullopt;
    }

    /// RFC 6901 pointer from the root, e.g. "/scene/primitives/3/material".
    std::string where() const;

    /// where() of a key of this object, be it there or not.
    std::string where(std::string_view key) const;

    /// The value as a message names it after "found": `-1.5`, `"grey"`, `a list of 3`, `an object`, `null`.
    std::string describe() const;

private:
    const Json* value_;
    const Node* parent_ = nullptr;
    std::string_view key_;
    std::size_t index_ = 0;
};

/// A key as a token of a pointer: "~" and "/" escaped, anything unprintable escaped, long keys shortened.
std::string pointer_token(std::string_view key);

}  // namespace orrery
