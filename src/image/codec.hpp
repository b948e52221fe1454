// Images to bytes and back, without files; and what the four formats share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/image_file.hpp"

namespace orrery {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

inline void append(Bytes& bytes, ByteView more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

inline void append(Bytes& bytes, std::string_view text) { append(bytes, std::as_bytes(std::span(text))); }

inline bool starts_with(ByteView bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::string_view(reinterpret_cast<const char*>(bytes.data()), magic.size()) == magic;
}

/// The whole file in memory, so that nothing on disk is touched before all of it is known. `look` concerns the
/// 8-bit formats only. Throws std::runtime_error, what encode_exr does, and std::bad_alloc.
Bytes encode_image(ImageFormat format, const Image& linear, const Look& look, const Metadata& metadata);

/// By the first bytes, whatever the file is called. Throws as encode_image, and std::runtime_error where decoding takes
/// more than so much `memory`, which is known before any is taken.
Image decode_image(ByteView file, std::uint64_t memory = unlimited_memory);

// PPM, binary (P6): the simplest 8-bit format.

/// Maxval 255; the metadata are comment lines after the magic, "# key: value". Values beyond [0, 1] are clamped.
Bytes encode_ppm(const Image& tone_mapped, const Metadata& metadata);

/// Maxval 1 to 65535, sample / maxval. Throws std::runtime_error, as decode_image does.
Image decode_ppm(ByteView file, std::uint64_t memory = unlimited_memory);

// PNG through libpng: 8-bit RGB out, whatever libpng can turn into RGB in.

/// 8-bit RGB, not interlaced, no gamma or colour chunks but, of values that are `srgb`, the one that says so; the
/// metadata are tEXt chunks, or iTXt where a value goes
/// beyond ASCII. Throws std::runtime_error with libpng's reason.
Bytes encode_png(const Image& tone_mapped, const Metadata& metadata, bool srgb = false);

/// Grey, palette, RGB, with or without alpha (which is ignored), 1 to 16 bits, sample / greatest sample. Gamma chunks
/// are not applied. Throws std::runtime_error, as decode_image does.
Image decode_png(ByteView file, std::uint64_t memory = unlimited_memory);

// PFM: 32-bit floats behind a line of text. Linear radiance, no room for metadata.

/// "PF", little-endian (scale -1.0), bottom row first.
Bytes encode_pfm(const Image& linear);

/// "PF", or "Pf" whose grey is given to all three channels; both byte orders. The sign of the scale is the byte order;
/// its magnitude, a unit nobody agrees on, is not applied. Throws std::runtime_error, as decode_image does.
Image decode_pfm(ByteView file, std::uint64_t memory = unlimited_memory);

// OpenEXR through its library: 32-bit float R, G, B, linear radiance.

/// Scan lines, ZIP (lossless); the metadata are string attributes named "orrery:" + key, a prefix that keeps them
/// apart from the format's own. No date is stored and nothing depends on the number of threads.
/// Throws std::runtime_error or OpenEXR's Iex::BaseExc, both of them std::exceptions.
Bytes encode_exr(const Image& linear, const Metadata& metadata);

/// The data window of a scan-line file with channels R, G and B, half or float. Tiled, deep and multi-part files are
/// refused. Throws as encode_exr, and as decode_image where memory is short.
Image decode_exr(ByteView file, std::uint64_t memory = unlimited_memory);

// One rule for metadata in all formats, so that the same keys and values are found in each.

/// A key every format can hold: printable ASCII, 1 to 79 characters (the limit of a PNG keyword), without spaces at
/// its ends. An empty key becomes PNG's keyword for everything else, "Comment".
std::string metadata_key(std::string_view key);

/// A value that fits one line of a PPM header: control characters, newlines first of all, become spaces. Bytes beyond
/// ASCII pass, so UTF-8 survives.
std::string metadata_value(std::string_view value);

/// Whether PNG's tEXt, which is Latin-1, would show this UTF-8 text as it was meant.
bool is_ascii(std::string_view text);

// How large an image a compressed file may claim to hold.

/// Deflate, the densest packing of these formats, makes at most 1032 bytes of one (RFC 1951: a match of 258 bytes in
/// two bits). Whatever announces more than that is a lie that would only cost memory.
inline constexpr std::uint64_t greatest_expansion = 1032;

/// Throws std::runtime_error where `rows` of `row_bytes` cannot come out of a file of `file_bytes`.
void check_unpacked_size(std::uint64_t row_bytes, std::uint64_t rows, std::size_t file_bytes);

/// Throws std::runtime_error with the figures where `rows` of `row_bytes`, all that decoding takes, exceed `memory`.
void check_memory(std::uint64_t row_bytes, std::uint64_t rows, std::uint64_t memory);

}  // namespace orrery
