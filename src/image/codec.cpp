#include "image/codec.hpp"

#include <stdexcept>

#include "image/exr.hpp"
#include "image/pfm.hpp"
#include "image/png.hpp"
#include "image/ppm.hpp"

namespace orrery {

Bytes encode_image(ImageFormat format, const Image& linear, ToneMap mapper, const Metadata& metadata) {
    if (linear.width == 0 || linear.height == 0) throw std::runtime_error("the image has no pixels");
    if (linear.pixels.size() != std::size_t{linear.width} * linear.height)
        throw std::runtime_error("the image has not as many pixels as its size says");
    switch (format) {
        case ImageFormat::ppm:
            return encode_ppm(tone_mapped(linear, mapper), metadata);
        case ImageFormat::png:
            return encode_png(tone_mapped(linear, mapper), metadata);
        case ImageFormat::pfm:
            return encode_pfm(linear);
        case ImageFormat::exr:
            return encode_exr(linear, metadata);
    }
    throw std::runtime_error("unknown image format");
}

Image decode_image(ByteView file, std::uint64_t memory) {
    if (starts_with(file, "P6")) return decode_ppm(file, memory);
    if (starts_with(file, "PF") || starts_with(file, "Pf")) return decode_pfm(file, memory);
    if (starts_with(file, "\x89PNG")) return decode_png(file, memory);
    if (starts_with(file, "\x76\x2f\x31\x01")) return decode_exr(file, memory);
    throw std::runtime_error("not a PPM (P6), PNG, PFM or EXR file");
}

}  // namespace orrery
