// PPM, binary (P6): the simplest 8-bit format.
#pragma once

#include "image/bytes.hpp"
#include "image/image_file.hpp"

namespace orrery {

/// Maxval 255; the metadata are comment lines after the magic, "# key: value". Values beyond [0, 1] are clamped.
Bytes encode_ppm(const Image& tone_mapped, const Metadata& metadata);

/// Maxval 1 to 65535, sample / maxval. Throws std::runtime_error, as decode_image does.
Image decode_ppm(ByteView file, std::uint64_t memory = unlimited_memory);

}  // namespace orrery
