#include "system/file_descriptor.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

namespace orrery {

void throw_system_error(const std::filesystem::path& file, std::string_view what, int error) {
    throw std::runtime_error(fmt::format("{}: {}: {}", file.string(), what, std::generic_category().message(error)));
}

}  // namespace orrery
