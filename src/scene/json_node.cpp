#include "scene/json_node.hpp"

#include <fmt/format.h>

#include "system/printable.hpp"

namespace orrery {

std::string pointer_token(std::string_view key) {
    std::string token;
    for (const char c : printable(key)) {
        if (c == '~') {
            token += "~0";
        } else if (c == '/') {
            token += "~1";
        } else {
            token += c;
        }
    }
    return token;
}

std::string Node::where() const {
    if (parent_ == nullptr) return "";
    if (parent_->is_list()) return fmt::format("{}/{}", parent_->where(), index_);
    return parent_->where(key_);
}

std::string Node::where(std::string_view key) const { return where() + '/' + pointer_token(key); }

std::string Node::describe() const {
    switch (value_->kind) {
        case JsonKind::text:
            return in_quotes(text(value_->name()));
        case JsonKind::boolean:
            return value_->bits != 0 ? "true" : "false";
        case JsonKind::negative:
            return fmt::format("{}", static_cast<std::int64_t>(value_->bits));
        case JsonKind::natural:
            return fmt::format("{}", value_->bits);
        case JsonKind::real:
            return fmt::format("{}", value_->number());
        case JsonKind::list:
            return fmt::format("a list of {}", size());
        case JsonKind::object:
            return "an object";
        case JsonKind::null:
            break;
    }
    return "null";
}

}  // namespace orrery
