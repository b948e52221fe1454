#include "cli/version.hpp"

namespace orrery {

std::string_view version() { return ORRERY_VERSION; }

}  // namespace orrery
