// JSON as the program writes it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace orrery {

/// Indented, with a newline at its end. In ASCII: names of files may hold what a terminal should not see, and need not
/// be UTF-8, which JSON must be.
inline std::string json_text(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace orrery
