#include "image/pfm.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "image/decode_limits.hpp"
#include "image/netpbm_header.hpp"

namespace orrery {
namespace {

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
