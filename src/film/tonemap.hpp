// Tone mappers: linear radiance -> [0, 1]. No gamma (spec section 5).
#pragma once

#include "film/film.hpp"

namespace orrery {

enum class ToneMap : std::uint8_t { sigmoid, linear, none };

/// sigmoid I/(1+I) per channel; linear I/max(I), the maximum per channel over the image (a black channel stays
/// black); none clamps to [0, 1].
Image tone_mapped(const Image& linear, ToneMap mapper);

}  // namespace orrery
