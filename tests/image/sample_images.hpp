// Images to write and read back.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "image/image.hpp"

namespace orrery::test {

/// Values no two of which are alike in a small image, from 0 to beyond 1, with fractions a half could not hold.
Image gradient(std::uint32_t width, std::uint32_t height);

/// Values k / 255 only, which 8-bit formats give back exactly.
Image eight_bit_gradient(std::uint32_t width, std::uint32_t height);

/// One pixel, odd sizes, the longest row and the longest column a scene may ask for.
const std::vector<std::pair<std::uint32_t, std::uint32_t>>& sizes();

}  // namespace orrery::test
