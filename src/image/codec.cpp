#include "image/codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace orrery {
namespace {

constexpr std::size_t longest_key = 79;

// Not std::isprint and friends: what an image file holds must not depend on the locale.
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }
bool is_beyond_ascii(char c) { return static_cast<unsigned char>(c) >= 0x80; }

}  // namespace

Bytes encode_image(ImageFormat format, const Image& linear, const Look& look, const Metadata& metadata) {
    if (linear.width == 0 || linear.height == 0) throw std::runtime_error("the image has no pixels");
    if (linear.pixels.size() != std::size_t{linear.width} * linear.height)
        throw std::runtime_error("the image has not as many pixels as its size says");
    switch (format) {
        case ImageFormat::ppm:
            return encode_ppm(tone_mapped(linear, look), metadata);
        case ImageFormat::png:
            return encode_png(tone_mapped(linear, look), metadata, look.mapper == ToneMap::srgb);
        case ImageFormat::pfm:
            return encode_pfm(linear);
        case ImageFormat::exr:
            return encode_exr(linear, metadata);
    }
    throw std::runtime_error("unknown image format");
}

Image decode_image(ByteView file, std::uint64_t memory) {
    if (starts_with(file, "P6")) return decode_ppm(file, memory);
    if (starts_with(file, "PF") || starts_with(file, "Pf")) return decode_pfm(file, memory);
    if (starts_with(file, "\x89PNG")) return decode_png(file, memory);
    if (starts_with(file, "\x76\x2f\x31\x01")) return decode_exr(file, memory);
    throw std::runtime_error("not a PPM (P6), PNG, PFM or EXR file");
}

std::string metadata_key(std::string_view key) {
    std::string result(key.substr(0, longest_key));
    std::replace_if(
        result.begin(), result.end(), [](char c) { return is_control(c) || is_beyond_ascii(c); }, '_');
    result.erase(result.find_last_not_of(' ') + 1);
    result.erase(0, result.find_first_not_of(' '));
    return result.empty() ? "Comment" : result;
}

std::string metadata_value(std::string_view value) {
    std::string result(value);
    std::replace_if(result.begin(), result.end(), is_control, ' ');
    return result;
}

bool is_ascii(std::string_view text) { return std::none_of(text.begin(), text.end(), is_beyond_ascii); }

void check_unpacked_size(std::uint64_t row_bytes, std::uint64_t rows, std::size_t file_bytes) {
    const std::uint64_t most = greatest_expansion * file_bytes;
    // Divided, not multiplied: the product may exceed 64 bits.
    if (rows > 0 && row_bytes > most / rows)
        throw std::runtime_error(
            fmt::format("{} rows of {} bytes cannot come out of {} bytes", rows, row_bytes, file_bytes));
}

void check_memory(std::uint64_t row_bytes, std::uint64_t rows, std::uint64_t memory) {
    if (rows == 0 || row_bytes <= memory / rows) return;
    const double gigabytes = static_cast<double>(row_bytes) * static_cast<double>(rows) / 1e9;
    throw std::runtime_error(fmt::format("its {} rows of pixels take {:.1f} GB, and {:.1f} GB of memory are left", rows,
                                         gigabytes, static_cast<double>(memory) / 1e9));
}

}  // namespace orrery
