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
    if (const auto word = text()) return in_quotes(*word);
    if (is_list()) return fmt::format("a list of {}", size());
    if (is_object()) return "an object";
    // The library writes a whole number of type double with ".0".
    return value_->is_number_float() ? fmt::format("{}", value_->get<double>()) : value_->dump();
}

}  // namespace orrery
