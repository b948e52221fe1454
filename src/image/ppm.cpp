#include "image/ppm.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "image/decode_limits.hpp"
#include "image/metadata_text.hpp"
#include "image/netpbm_header.hpp"
#include "image/quantise.hpp"

namespace orrery {

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

}  // namespace orrery
