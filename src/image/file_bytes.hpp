// A whole file into memory.
#pragma once

#include <filesystem>

#include "image/bytes.hpp"

namespace orrery {

/// The content of a regular file. Throws std::runtime_error with the path and the system's reason.
Bytes read_file(const std::filesystem::path& file);

}  // namespace orrery
