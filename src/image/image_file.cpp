#include "image/image_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "image/atomic_file.hpp"
#include "image/codec.hpp"
#include "image/decode_limits.hpp"
#include "image/file_bytes.hpp"

namespace orrery {
namespace {

/// Runs `work` and puts the file's name before what it complains about. Out of memory is no fault of the file.
template <typename Work>
auto naming(const std::filesystem::path& file, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& fault) {
        throw std::runtime_error(fmt::format("{}: {}", file.string(), fault.what()));
    }
}

}  // namespace

ImageFormat image_format(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (ending == ".ppm") return ImageFormat::ppm;
    if (ending == ".png") return ImageFormat::png;
    if (ending == ".pfm") return ImageFormat::pfm;
    if (ending == ".exr") return ImageFormat::exr;
    throw std::invalid_argument(
        fmt::format("{}: no image format has the ending \"{}\"; known are .ppm, .png, .pfm and .exr", file.string(),
                    file.extension().string()));
}

std::uint64_t least_file_size(ImageFormat format, std::uint32_t width, std::uint32_t height) {
    const std::uint64_t pixels = std::uint64_t{width} * height;
    switch (format) {
        case ImageFormat::ppm:
            return 3 * pixels;
        case ImageFormat::png:
            return 3 * pixels / greatest_expansion;
        case ImageFormat::pfm:
            return 12 * pixels;
        case ImageFormat::exr:
            return 12 * pixels / greatest_expansion;
    }
    return 0;
}

void write_image(const std::filesystem::path& file, const Image& linear, ToneMap mapper, const Metadata& metadata) {
    const ImageFormat format = image_format(file);
    const Bytes bytes = naming(file, [&] { return encode_image(format, linear, mapper, metadata); });
    write_atomically(file, bytes);
}

Image read_image(const std::filesystem::path& file, std::uint64_t memory) {
    const Bytes bytes = read_file(file, memory);
    return naming(file, [&] { return decode_image(bytes, memory - bytes.size()); });
}

}  // namespace orrery
