// How many pixels this machine has memory for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace orrery {

/// What a pixel costs on the film: sums in double and a count of samples (32), what it knows of its error (48), and
/// with Sobol's sequences the difference of the two (24).
inline constexpr std::uint64_t film_bytes_per_pixel = 104;

/// What a pixel costs while an image is made: on the film, the mean in float (12), its tone-mapped copy (12) and the
/// standard error (12).
inline constexpr std::uint64_t bytes_per_pixel = film_bytes_per_pixel + 36;
/// With a goal of time also the film before the pass under way, which is dropped when the time is up.
inline constexpr std::uint64_t timed_bytes_per_pixel = bytes_per_pixel + film_bytes_per_pixel;

/// Why an image of this size cannot be made with `memory` bytes, with the figures; empty where it can.
std::optional<std::string> too_many_pixels(std::uint32_t width, std::uint32_t height, std::uint64_t memory,
                                           std::uint64_t bytes_of_pixel = bytes_per_pixel);

}  // namespace orrery
