// Tone mappers: linear radiance -> [0, 1]. No gamma (spec section 5).
#pragma once

#include <cstdint>

#include "film/film.hpp"

namespace orrery {

enum class ToneMap : std::uint8_t { sigmoid, linear, none };

/// sigmoid I/(1+I) per channel; linear I/max(I), the maximum per channel over the image (a black channel stays
/// black); none clamps to [0, 1]. What a film cannot hold is still given a meaning: negative and NaN become 0, +inf
/// counts as the largest float.
Image tone_mapped(const Image& linear, ToneMap mapper);

}  // namespace orrery
