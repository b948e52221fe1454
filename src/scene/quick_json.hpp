// JSON text -> tree, as fast as a parser goes that explains nothing.
#pragma once

#include <optional>
#include <string_view>

#include "scene/json_tree.hpp"

namespace orrery {

/// The value that sound text spells. Empty where the text may have a fault, a repeated key or too deep a nesting
/// included: parse_json() then finds out what it is, and now and then that there is none.
std::optional<JsonTree> parse_quickly(std::string_view text);

}  // namespace orrery
