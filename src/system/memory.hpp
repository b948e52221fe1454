// How much memory there is for this process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>

namespace orrery {

/// The least limit of memory on the control groups (v1 and v2) that this process is in, and on those around them, as
/// far as they can be seen from here: a container's. Empty where none is set. `root` is where /proc and the file
/// systems it names are looked for.
std::optional<std::uint64_t> control_group_memory(const std::filesystem::path& root = "/");

/// Bytes that this process may use: the machine's, or less where a control group allows less. The largest number where
/// the system does not tell.
std::uint64_t memory_limit();

/// Keeps the process below that: what asks for more gets std::bad_alloc, and not the end without a word that the
/// system has for it. Threads get stacks of a MiB instead of eight, which would count in full. Once, at the start.
void keep_within_memory();

}  // namespace orrery
