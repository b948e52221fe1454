#include "scene/image_memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace orrery {

std::optional<std::uint64_t> physical_memory() {
    // The standard library does not know; sysconf is POSIX, and _SC_PHYS_PAGES is common to Linux, the BSDs and macOS.
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_size = sysconf(_SC_PAGESIZE);
    if (pages <= 0 || page_size <= 0) return std::nullopt;
    return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size);
}

std::optional<std::string> too_many_pixels(std::uint32_t width, std::uint32_t height, std::uint64_t memory) {
    // 65536^2 * 108 is below 2^39; with any 32-bit width and height the pixels alone still fit 64 bits.
    const std::uint64_t pixels = std::uint64_t{width} * height;
    if (pixels <= memory / bytes_per_pixel) return std::nullopt;
    const auto gigabytes = [](double bytes) { return bytes / 1e9; };
    return fmt::format(
        "found {} x {}, {} pixels that take {:.1f} GB, expected an image that fits the {:.1f} GB of memory", width,
        height, pixels, gigabytes(static_cast<double>(pixels) * static_cast<double>(bytes_per_pixel)),
        gigabytes(static_cast<double>(memory)));
}

}  // namespace orrery
