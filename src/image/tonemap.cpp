#include "image/tonemap.hpp"

#include <algorithm>
#include <limits>

namespace orrery {
namespace {

/// Non-negative and finite, so that the formulae below need no special cases. NaN fails the comparison and gives 0.
float radiance(float value) { return value > 0 ? std::min(value, std::numeric_limits<float>::max()) : 0.0f; }

/// For huge values 1 + value rounds to value and the quotient is 1; 1 - 1/(1+value) would lose the small ones.
float sigmoid(float value) {
    const float x = radiance(value);
    return x / (1 + x);
}

float clamped(float value) { return std::min(radiance(value), 1.0f); }

/// A channel relative to the greatest of the image; black where the whole channel is.
float relative(float value, float greatest) { return greatest > 0 ? radiance(value) / greatest : 0.0f; }

Rgb channel_maxima(const Image& image) {
    Rgb greatest;
    for (const Rgb& pixel : image.pixels) {
        greatest.r = std::max(greatest.r, radiance(pixel.r));
        greatest.g = std::max(greatest.g, radiance(pixel.g));
        greatest.b = std::max(greatest.b, radiance(pixel.b));
    }
    return greatest;
}

template <typename Curve>
Image mapped(const Image& linear, Curve curve) {
    Image result{linear.width, linear.height, std::vector<Rgb>(linear.pixels.size())};
    std::transform(linear.pixels.begin(), linear.pixels.end(), result.pixels.begin(), curve);
    return result;
}

}  // namespace

Image tone_mapped(const Image& linear, ToneMap mapper) {
    switch (mapper) {
        case ToneMap::sigmoid:
            return mapped(linear, [](const Rgb& p) { return Rgb{sigmoid(p.r), sigmoid(p.g), sigmoid(p.b)}; });
        case ToneMap::linear:
            return mapped(linear, [greatest = channel_maxima(linear)](const Rgb& p) {
                return Rgb{relative(p.r, greatest.r), relative(p.g, greatest.g), relative(p.b, greatest.b)};
            });
        case ToneMap::none:
            break;
    }
    return mapped(linear, [](const Rgb& p) { return Rgb{clamped(p.r), clamped(p.g), clamped(p.b)}; });
}

}  // namespace orrery
