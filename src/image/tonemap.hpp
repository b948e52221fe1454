// Tone mappers: linear radiance -> [0, 1], and [0, 1] to the 8 bits that PPM and PNG store.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.hpp"

namespace orrery {

enum class ToneMap : std::uint8_t { sigmoid, linear, none, srgb };

/// How radiance is shown in 8 bits: times 2^exposure, then mapped.
struct Look {
    Look(ToneMap map, double stops = 0) : mapper(map), exposure(stops) {}  // NOLINT: a mapper is a look

    ToneMap mapper;
    double exposure;
};

/// sigmoid I/(1+I) per channel; linear I/max(I), the maximum per channel over the image (a black channel stays
/// black); none clamps to [0, 1]: these without gamma. srgb clamps and applies the transfer function of IEC 61966-2-1,
/// so that a screen shows the radiance. What a film cannot hold is still given a meaning: negative and NaN become 0,
/// +inf counts as the largest float.
Image tone_mapped(const Image& linear, const Look& look);

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
