// PNG through libpng: 8-bit RGB out, whatever libpng can turn into RGB in.
#pragma once

#include "image/bytes.hpp"
#include "image/image_file.hpp"

namespace orrery {

/// 8-bit RGB, not interlaced, no gamma or colour chunks; the metadata are tEXt chunks, or iTXt where a value goes
/// beyond ASCII. Throws std::runtime_error with libpng's reason.
Bytes encode_png(const Image& tone_mapped, const Metadata& metadata);

/// Grey, palette, RGB, with or without alpha (which is ignored), 1 to 16 bits, sample / greatest sample. Gamma chunks
/// are not applied. Throws std::runtime_error, as decode_image does.
Image decode_png(ByteView file, std::uint64_t memory = unlimited_memory);

}  // namespace orrery
