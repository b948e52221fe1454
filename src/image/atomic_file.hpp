// Files that appear whole or not at all.
#pragma once

#include <filesystem>

#include "image/bytes.hpp"
#include "image/pending_temporaries.hpp"

namespace orrery {

/// The file that writing to `file` would replace: symbolic links are followed, also those that lead to nothing yet.
/// Throws std::runtime_error where the folder is missing or not writable, or where the target is a directory, not a
/// regular file or write-protected: what a long render wants to know before it starts.
std::filesystem::path writable_target(const std::filesystem::path& file);

/// Writes beside the target, flushes to the disk and renames. A failure at any step, a full disk included, leaves the
/// previous file and no temporary. A new file's mode is what the umask allows, a replaced one keeps its own.
/// Throws std::runtime_error with the path and the system's reason.
void write_atomically(const std::filesystem::path& file, ByteView bytes);

}  // namespace orrery
