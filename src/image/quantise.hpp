// Tone-mapped values to the 8 bits PPM and PNG store.
#pragma once

#include <cstdint>
#include <vector>

#include "film/film.hpp"

namespace orrery {

/// round(255 x), half up; what lies outside [0, 1] is clamped and NaN is 0. In double the product of a float and 255
/// is exact, so the only rounding is the one asked for.
inline std::uint8_t quantised(float x) {
    if (!(x > 0)) return 0;
    if (x >= 1) return 255;
    return static_cast<std::uint8_t>(255.0 * static_cast<double>(x) + 0.5);
}

/// r, g, b of every pixel, row by row from the top.
inline std::vector<std::uint8_t> quantised(const Image& image) {
    std::vector<std::uint8_t> samples;
    samples.reserve(3 * image.pixels.size());
    for (const Rgb& pixel : image.pixels)
        for (const float channel : {pixel.r, pixel.g, pixel.b}) samples.push_back(quantised(channel));
    return samples;
}

}  // namespace orrery
