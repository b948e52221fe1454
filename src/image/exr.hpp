// OpenEXR through its library: 32-bit float R, G, B, linear radiance.
#pragma once

#include "image/bytes.hpp"
#include "image/image_file.hpp"

namespace orrery {

/// Scan lines, ZIP (lossless); the metadata are string attributes named "orrery:" + key, a prefix that keeps them
/// apart from the format's own. No date is stored and nothing depends on the number of threads.
/// Throws std::runtime_error or OpenEXR's Iex::BaseExc, both of them std::exceptions.
Bytes encode_exr(const Image& linear, const Metadata& metadata);

/// The data window of a scan-line file with channels R, G and B, half or float. Tiled, deep and multi-part files are
/// refused. Throws as encode_exr, and as decode_image where memory is short.
Image decode_exr(ByteView file, std::uint64_t memory = unlimited_memory);

}  // namespace orrery
