// A whole file into memory.
#pragma once

#include <cstdint>
#include <filesystem>

#include "image/bytes.hpp"

namespace orrery {

/// The content of a regular file of at most so many bytes. Throws std::runtime_error with the path and the reason.
Bytes read_file(const std::filesystem::path& file, std::uint64_t most);

}  // namespace orrery
