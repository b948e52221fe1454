// An image in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace orrery {

/// Linear RGB, unbounded, >= 0 for radiance.
struct Rgb {
    float r = 0, g = 0, b = 0;
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// Row-major pixels, (0,0) top left.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Rgb> pixels;  ///< width * height

    Rgb& at(std::uint32_t x, std::uint32_t y) { return pixels[std::size_t{y} * width + x]; }
    const Rgb& at(std::uint32_t x, std::uint32_t y) const { return pixels[std::size_t{y} * width + x]; }
};

}  // namespace orrery
