// Images to bytes and back, without files.
#pragma once

#include "image/bytes.hpp"
#include "image/image_file.hpp"

namespace orrery {

/// The whole file in memory, so that nothing on disk is touched before all of it is known. `mapper` concerns the
/// 8-bit formats only. Throws std::runtime_error, what exr.hpp says, and std::bad_alloc.
Bytes encode_image(ImageFormat format, const Image& linear, ToneMap mapper, const Metadata& metadata);

/// By the first bytes, whatever the file is called. Throws as encode_image, and std::runtime_error where decoding takes
/// more than so much `memory`, which is known before any is taken.
Image decode_image(ByteView file, std::uint64_t memory = unlimited_memory);

}  // namespace orrery
