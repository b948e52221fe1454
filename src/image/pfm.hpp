// PFM: 32-bit floats behind a line of text. Linear radiance, no room for metadata.
#pragma once

#include "image/bytes.hpp"
#include "image/image_file.hpp"

namespace orrery {

/// "PF", little-endian (scale -1.0), bottom row first.
Bytes encode_pfm(const Image& linear);

/// "PF", or "Pf" whose grey is given to all three channels; both byte orders. The sign of the scale is the byte order;
/// its magnitude, a unit nobody agrees on, is not applied. Throws std::runtime_error, as decode_image does.
Image decode_pfm(ByteView file, std::uint64_t memory = unlimited_memory);

}  // namespace orrery
