// Image files out and in: PPM (P6), PNG (8 bit), PFM, EXR (float), by the ending of the name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "image/image.hpp"
#include "image/tonemap.hpp"

namespace orrery {

/// What made the image: (key, value) pairs, written where the format has room (PNG tEXt, PPM comment, EXR
/// attributes). Never a time or a date: the same seed gives the same file, byte for byte.
using Metadata = std::vector<std::pair<std::string, std::string>>;

enum class ImageFormat { ppm, png, pfm, exr };

/// By the ending, case-insensitive. Throws std::invalid_argument naming the known endings.
ImageFormat image_format(const std::filesystem::path& file);

/// The fewest bytes that a file of such an image has, whatever the pixels are.
std::uint64_t least_file_size(ImageFormat format, std::uint32_t width, std::uint32_t height);

/// Writes `linear` to `file`. PPM and PNG are tone mapped and stored as round(255 x); PFM (little-endian, bottom row
/// first) and EXR hold linear values. Written to a temporary beside the target, flushed and renamed: a reader never
/// sees half an image and a failure leaves the previous file and no temporary.
/// Throws std::runtime_error with the path and the system's reason.
void write_image(const std::filesystem::path& file, const Image& linear, const Look& look, const Metadata& metadata);

inline constexpr std::uint64_t unlimited_memory = std::numeric_limits<std::uint64_t>::max();

/// Reads any of the four back (8-bit values as v / 255). Throws std::runtime_error naming file and fault; a fault is
/// also what would take more than so many bytes of `memory`, the file's own and those of its pixels.
Image read_image(const std::filesystem::path& file, std::uint64_t memory = unlimited_memory);

}  // namespace orrery
