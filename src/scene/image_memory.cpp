#include "scene/image_memory.hpp"

#include <fmt/format.h>

namespace orrery {

std::optional<std::string> too_many_pixels(std::uint32_t width, std::uint32_t height, std::uint64_t memory,
                                           std::uint64_t bytes_of_pixel) {
    // 65536^2 * 140 is below 2^40; with any 32-bit width and height the pixels alone still fit 64 bits.
    const std::uint64_t pixels = std::uint64_t{width} * height;
    if (pixels <= memory / bytes_of_pixel) return std::nullopt;
    const auto gigabytes = [](double bytes) { return bytes / 1e9; };
    return fmt::format(
        "found {} x {}, {} pixels that take {:.1f} GB, expected an image that fits the {:.1f} GB of memory", width,
        height, pixels, gigabytes(static_cast<double>(pixels) * static_cast<double>(bytes_of_pixel)),
        gigabytes(static_cast<double>(memory)));
}

}  // namespace orrery
