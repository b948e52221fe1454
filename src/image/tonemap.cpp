#include "image/tonemap.hpp"

#include <algorithm>
#include <cmath>
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

/// IEC 61966-2-1, of a value in [0, 1].
float srgb(float value) {
    const double v = clamped(value);
    return static_cast<float>(v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

/// `curve` of every channel times `scale`.
template <class Curve>
Image mapped(const Image& linear, float scale, Curve curve) {
    Image result{linear.width, linear.height, std::vector<Rgb>(linear.pixels.size())};
    std::ranges::transform(linear.pixels, result.pixels.begin(), [&](const Rgb& p) {
        return Rgb{curve(p.r * scale), curve(p.g * scale), curve(p.b * scale)};
    });
    return result;
}

Image relative_to_maxima(const Image& linear, float scale) {
    Image result = mapped(linear, scale, radiance);
    Rgb greatest;
    for (const Rgb& p : result.pixels)
        greatest = {std::max(greatest.r, p.r), std::max(greatest.g, p.g), std::max(greatest.b, p.b)};
    for (Rgb& p : result.pixels) p = {relative(p.r, greatest.r), relative(p.g, greatest.g), relative(p.b, greatest.b)};
    return result;
}

}  // namespace

Image tone_mapped(const Image& linear, const Look& look) {
    const auto scale = static_cast<float>(std::exp2(look.exposure));
    switch (look.mapper) {
        case ToneMap::sigmoid:
            return mapped(linear, scale, sigmoid);
        case ToneMap::linear:
            return relative_to_maxima(linear, scale);
        case ToneMap::srgb:
            return mapped(linear, scale, srgb);
        case ToneMap::none:
            break;
    }
    return mapped(linear, scale, clamped);
}

}  // namespace orrery
