#include "sample_images.hpp"

namespace orrery::test {
namespace {

template <typename Value>
Image filled(std::uint32_t width, std::uint32_t height, Value value) {
    Image image{width, height, std::vector<Rgb>(std::size_t{width} * height)};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) image.at(x, y) = {value(x, y, 0u), value(x, y, 1u), value(x, y, 2u)};
    return image;
}

}  // namespace

Image gradient(std::uint32_t width, std::uint32_t height) {
    return filled(width, height, [](std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
        return static_cast<float>((x * 3 + y * 31 + channel) % 1009) / 307.0f;
    });
}

Image eight_bit_gradient(std::uint32_t width, std::uint32_t height) {
    return filled(width, height, [](std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
        return static_cast<float>((x * 3 + y * 31 + channel * 7) % 256) / 255.0f;
    });
}

const std::vector<std::pair<std::uint32_t, std::uint32_t>>& sizes() {
    static const std::vector<std::pair<std::uint32_t, std::uint32_t>> list{
        {1, 1}, {2, 1}, {1, 2}, {3, 5}, {17, 33}, {127, 1}, {31, 16}, {65536, 1}, {1, 65536}};
    return list;
}

}  // namespace orrery::test
