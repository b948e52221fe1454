#include "image/image_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <new>
#include <stdexcept>

#include "image/atomic_file.hpp"
#include "image/codec.hpp"
#include "system/file_descriptor.hpp"

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

/// The content of a regular file of at most so many bytes.
Bytes read_file(const std::filesystem::path& file, std::uint64_t most) {
    // O_NONBLOCK: opening a pipe must not wait for a writer, it is refused below.
    const FileDescriptor input(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!input.is_open()) throw_system_error(file, "cannot open", errno);
    struct stat status = {};
    if (::fstat(input.number(), &status) != 0) throw_system_error(file, "cannot read", errno);
    if (!S_ISREG(status.st_mode)) throw std::runtime_error(fmt::format("{}: not a regular file", file.string()));

    if (static_cast<std::uint64_t>(status.st_size) > most)
        throw std::runtime_error(
            fmt::format("{}: found {} bytes, and {} of memory are left", file.string(), status.st_size, most));

    Bytes bytes(static_cast<std::size_t>(status.st_size));
    std::size_t filled = 0;
    while (filled < bytes.size()) {
        const ssize_t count = ::read(input.number(), bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw_system_error(file, "cannot read", errno);
        if (count == 0) break;  // somebody cut it meanwhile
        filled += static_cast<std::size_t>(count);
    }
    bytes.resize(filled);
    return bytes;
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

void write_image(const std::filesystem::path& file, const Image& linear, const Look& look, const Metadata& metadata) {
    const ImageFormat format = image_format(file);
    const Bytes bytes = naming(file, [&] { return encode_image(format, linear, look, metadata); });
    write_atomically(file, bytes);
}

Image read_image(const std::filesystem::path& file, std::uint64_t memory) {
    const Bytes bytes = read_file(file, memory);
    return naming(file, [&] { return decode_image(bytes, memory - bytes.size()); });
}

}  // namespace orrery
