// Any bytes as an image file of one format: decoded or refused with a message, and what is decoded survives being
// encoded and decoded again.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "image/codec.hpp"

namespace {

/// The format this program is built for: decode_ORRERY_FORMAT.
#define ORRERY_JOIN(a, b) a##b
#define ORRERY_DECODER(format) ORRERY_JOIN(decode_, format)
constexpr auto decode = orrery::ORRERY_DECODER(ORRERY_FORMAT);
constexpr auto format = orrery::ImageFormat::ORRERY_FORMAT;
/// What decoding may take: more than any input here is worth, and less than libFuzzer allows.
constexpr std::uint64_t memory = std::uint64_t{256} << 20;

orrery::Image again(const orrery::Image& image) {
    return decode(encode_image(format, image, orrery::ToneMap::none, {}), memory);
}

/// As far as the format's files hold pixels: 8 bits, of which a file with 16 loses some when it is written again.
bool same(float a, float b) {
    constexpr bool exact = format == orrery::ImageFormat::pfm || format == orrery::ImageFormat::exr;
    return a == b || (exact ? std::isnan(a) && std::isnan(b) : std::abs(a - b) <= 0.5001f / 255);
}
bool same(const orrery::Image& a, const orrery::Image& b) {
    if (a.width != b.width || a.height != b.height || a.pixels.size() != b.pixels.size()) return false;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (!same(a.pixels[i].r, b.pixels[i].r) || !same(a.pixels[i].g, b.pixels[i].g) ||
            !same(a.pixels[i].b, b.pixels[i].b))
            return false;
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace orrery;
    Image image;
    try {
        image = decode(std::as_bytes(std::span(data, size)), memory);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& refusal) {
        if (std::strlen(refusal.what()) == 0) std::abort();
        return 0;
    }
    if (image.pixels.empty() || image.pixels.size() != std::size_t{image.width} * image.height) std::abort();
    if (!same(image, again(image))) std::abort();
    return 0;
}
