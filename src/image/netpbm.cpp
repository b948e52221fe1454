// PPM and PFM: a few words between white space, and then the samples.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "image/codec.hpp"

namespace orrery {
namespace {

constexpr std::string_view white_space = " \t\n\v\f\r";
// Far above any number in a header: garbage is not echoed at full length.
constexpr std::size_t longest_word = 32;

/// Reads header words from the front of a file. Every fault is a std::runtime_error.
class NetpbmHeader {
public:
    enum class Comments { allowed, unknown };  ///< PPM has comments, PFM has none

    NetpbmHeader(ByteView file, Comments comments)
        : text_(reinterpret_cast<const char*>(file.data()), file.size()), comments_(comments) {}

    /// The next word; the one white-space character (or comment) that ends it is consumed, so that after the last word
    /// `samples` starts at the first sample even when that looks like white space.
    std::string_view word();

    /// The next word as a whole number in [least, most].
    std::uint32_t number(const char* what, std::uint32_t least, std::uint32_t most);

    /// What follows the header; faults unless it holds `pixels` of `bytes_per_pixel`.
    ByteView samples(std::uint64_t pixels, std::size_t bytes_per_pixel) const;

private:
    bool at_blank() const;
    /// Passes over one white-space character, or over a comment with the newline that ends it.
    void skip_blank();

    std::string_view text_;
    Comments comments_;
    std::size_t at_ = 0;
};

bool NetpbmHeader::at_blank() const {
    if (at_ == text_.size()) return false;
    return white_space.find(text_[at_]) != white_space.npos || (text_[at_] == '#' && comments_ == Comments::allowed);
}

void NetpbmHeader::skip_blank() {
    const std::size_t end = text_[at_] == '#' ? text_.find('\n', at_) : at_;
    at_ = end == text_.npos ? text_.size() : end + 1;
}

std::string_view NetpbmHeader::word() {
    while (at_blank()) skip_blank();
    const std::size_t start = at_;
    while (at_ < text_.size() && !at_blank()) ++at_;
    if (at_ == text_.size()) throw std::runtime_error("truncated in the header");
    const std::string_view found = text_.substr(start, at_ - start);
    if (found.size() > longest_word) throw std::runtime_error("a word in the header is too long");
    skip_blank();
    return found;
}

std::uint32_t NetpbmHeader::number(const char* what, std::uint32_t least, std::uint32_t most) {
    const std::string_view digits = word();
    std::uint32_t value = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (fault != std::errc{} || end != digits.data() + digits.size() || value < least || value > most)
        throw std::runtime_error(fmt::format("{} is not a whole number from {} to {}", what, least, most));
    return value;
}

ByteView NetpbmHeader::samples(std::uint64_t pixels, std::size_t bytes_per_pixel) const {
    const ByteView rest = std::as_bytes(std::span(text_)).subspan(at_);
    // Divided, not multiplied: the header may claim more than 64 bits can count.
    if (pixels > rest.size() / bytes_per_pixel)
        throw std::runtime_error(fmt::format("truncated: {} pixels of {} bytes are announced, {} bytes are there",
                                             pixels, bytes_per_pixel, rest.size()));
    return rest.first(static_cast<std::size_t>(pixels) * bytes_per_pixel);
}

// By shifts, so that neither direction depends on the byte order of this machine.
std::array<std::byte, 4> little_endian(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return {std::byte(bits & 0xff), std::byte(bits >> 8 & 0xff), std::byte(bits >> 16 & 0xff), std::byte(bits >> 24)};
}

float float_at(ByteView bytes, std::endian order) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i)
        bits = bits << 8 | std::to_integer<std::uint32_t>(bytes[order == std::endian::big ? i : 3 - i]);
    return std::bit_cast<float>(bits);
}

std::endian byte_order(std::string_view scale) {
    if (scale.starts_with('+')) scale.remove_prefix(1);  // which from_chars does not know
    float value = 0;
    const auto [end, fault] = std::from_chars(scale.data(), scale.data() + scale.size(), value);
    if (fault != std::errc{} || end != scale.data() + scale.size() || !std::isfinite(value) || value == 0)
        throw std::runtime_error("the scale is not a number other than 0");
    return value < 0 ? std::endian::little : std::endian::big;
}

}  // namespace

Bytes encode_ppm(const Image& tone_mapped, const Metadata& metadata) {
    std::string header = "P6\n";
    for (const auto& [key, value] : metadata)
        header += fmt::format("# {}: {}\n", metadata_key(key), metadata_value(value));
    header += fmt::format("{} {}\n255\n", tone_mapped.width, tone_mapped.height);

    Bytes file;
    file.reserve(header.size() + 3 * tone_mapped.pixels.size());
    append(file, header);
    const std::vector<std::uint8_t> samples = quantised(tone_mapped);
    append(file, std::as_bytes(std::span(samples)));
    return file;
}

Image decode_ppm(ByteView file, std::uint64_t memory) {
    constexpr auto largest = std::numeric_limits<std::uint32_t>::max();
    NetpbmHeader header(file, NetpbmHeader::Comments::allowed);
    if (header.word() != "P6") throw std::runtime_error("not a binary PPM (P6)");
    const std::uint32_t width = header.number("width", 1, largest);
    const std::uint32_t height = header.number("height", 1, largest);
    const std::uint32_t maxval = header.number("maxval", 1, 65535);

    const std::size_t sample_bytes = maxval < 256 ? 1 : 2;
    const std::uint64_t pixels = std::uint64_t{width} * height;
    const ByteView samples = header.samples(pixels, 3 * sample_bytes);
    check_memory(sizeof(Rgb) * std::uint64_t{width}, height, memory);

    const auto channel = [&](std::size_t index) {
        std::uint32_t sample = 0;  // most significant byte first
        for (std::size_t i = 0; i < sample_bytes; ++i)
            sample = sample << 8 | std::to_integer<std::uint32_t>(samples[index * sample_bytes + i]);
        if (sample > maxval) throw std::runtime_error(fmt::format("sample {} exceeds maxval {}", sample, maxval));
        return static_cast<float>(sample) / static_cast<float>(maxval);
    };
    Image image{width, height, std::vector<Rgb>(static_cast<std::size_t>(pixels))};
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {channel(3 * i), channel(3 * i + 1), channel(3 * i + 2)};
    return image;
}

Bytes encode_pfm(const Image& linear) {
    const std::string header = fmt::format("PF\n{} {}\n-1.0\n", linear.width, linear.height);
    Bytes file;
    file.reserve(header.size() + 12 * linear.pixels.size());
    append(file, header);
    for (std::uint32_t y = linear.height; y-- > 0;)
        for (std::uint32_t x = 0; x < linear.width; ++x) {
            const Rgb& pixel = linear.at(x, y);
            for (const float channel : {pixel.r, pixel.g, pixel.b}) append(file, little_endian(channel));
        }
    return file;
}

Image decode_pfm(ByteView file, std::uint64_t memory) {
    constexpr auto largest = std::numeric_limits<std::uint32_t>::max();
    NetpbmHeader header(file, NetpbmHeader::Comments::unknown);
    const std::string_view magic = header.word();
    if (magic != "PF" && magic != "Pf") throw std::runtime_error("not a PFM (PF or Pf)");
    const std::size_t channels = magic == "PF" ? 3 : 1;
    const std::uint32_t width = header.number("width", 1, largest);
    const std::uint32_t height = header.number("height", 1, largest);
    const std::endian order = byte_order(header.word());
    const std::uint64_t pixels = std::uint64_t{width} * height;
    ByteView samples = header.samples(pixels, 4 * channels);
    check_memory(sizeof(Rgb) * std::uint64_t{width}, height, memory);

    const auto next = [&] {
        const float value = float_at(samples, order);
        samples = samples.subspan(4);
        return value;
    };
    Image image{width, height, std::vector<Rgb>(static_cast<std::size_t>(pixels))};
    for (std::uint32_t y = height; y-- > 0;)
        for (std::uint32_t x = 0; x < width; ++x) {
            Rgb& pixel = image.at(x, y);
            pixel.r = next();
            pixel.g = channels == 3 ? next() : pixel.r;
            pixel.b = channels == 3 ? next() : pixel.r;
        }
    return image;
}

}  // namespace orrery
