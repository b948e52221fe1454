// Bytes -> JSON tree: syntax, nesting and repeated keys.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "scene/json_node.hpp"
#include "scene/report.hpp"

namespace orrery {

/// Deepest nesting of lists and objects accepted. A scene needs five; the limit keeps whatever walks the tree
/// recursively within the stack.
inline constexpr std::size_t deepest_nesting = 100;

/// Takes a tree down from its leaves, in place: the library's destructor allocates, and where memory is short
/// std::bad_alloc out of a destructor would end the program. Recursive, within deepest_nesting.
struct TakeDown {
    void operator()(Json* root) const noexcept;
};
using JsonTree = std::unique_ptr<Json, TakeDown>;

/// The value that `text` spells. Null after a syntax error (reported as "line:column", columns in characters), a
/// number beyond the range of a double, or nesting too deep. A key given twice in one object is an error, too, but
/// reading goes on with the last of its values.
JsonTree parse_json(std::string_view text, Report& report);

}  // namespace orrery
