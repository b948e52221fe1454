#pragma once

#include <string_view>

namespace orrery {

/// The project's version as CMakeLists.txt states it, "1.2.3".
std::string_view version();

}  // namespace orrery
