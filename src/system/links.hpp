// Where the links of the file system lead.
#pragma once

#include <filesystem>
#include <system_error>

namespace orrery {

/// The file that a name means: symbolic links are followed, also those that lead to nothing yet. Sets `error` where
/// they lead nowhere, or into /proc: /dev/stdout, /dev/fd/3 and the like mean an open file and no place (ENXIO).
std::filesystem::path follow_links(const std::filesystem::path& file, std::error_code& error);

/// Whether the name means an open file and no place, as /dev/stdin does and what a shell puts for <(...).
bool means_open_file(const std::filesystem::path& file);

/// Where a file is: "." where its name has no folder.
inline std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace orrery
