// How many pixels this machine has memory for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace orrery {

/// What a pixel costs while an image is made: the film's sums in double and its sample count (32), what it knows of its
/// error (40), the mean in float (12), its tone-mapped copy (12) and the standard error (12).
inline constexpr std::uint64_t bytes_per_pixel = 108;

/// Bytes of physical memory; empty where the system does not tell.
std::optional<std::uint64_t> physical_memory();

/// Why an image of this size cannot be made with `memory` bytes, with the figures; empty where it can.
std::optional<std::string> too_many_pixels(std::uint32_t width, std::uint32_t height, std::uint64_t memory);

}  // namespace orrery
