#include "scene/json_node.hpp"

#include <fmt/format.h>

#include "scene/printable.hpp"

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
    if (parent_->value_->is_array()) return fmt::format("{}/{}", parent_->where(), index_);
    return parent_->where(key_);
}

std::string Node::where(std::string_view key) const { return where() + '/' + pointer_token(key); }

std::string describe(const Json& value) {
    switch (value.type()) {
        case Json::value_t::string:
            return in_quotes(*value.get_ptr<const std::string*>());
        case Json::value_t::boolean:
            return value.get<bool>() ? "true" : "false";
        case Json::value_t::number_integer:
            return fmt::format("{}", value.get<std::int64_t>());
        case Json::value_t::number_unsigned:
            return fmt::format("{}", value.get<std::uint64_t>());
        case Json::value_t::number_float:
            return fmt::format("{}", value.get<double>());
        case Json::value_t::array:
            return fmt::format("a list of {}", value.size());
        case Json::value_t::object:
            return "an object";
        default:
            return "null";
    }
}

}  // namespace orrery
