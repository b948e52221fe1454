#include <png.h>

#include <cstring>
#include <new>
#include <stdexcept>

#include "image/decode_limits.hpp"
#include "image/png.hpp"
#include "image/png_fault.hpp"

namespace orrery {
namespace {

/// A libpng read struct over bytes in memory that lives as long as this object.
class PngReader {
public:
    explicit PngReader(ByteView file)
        : rest(file),
          png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &fault, PngFault::on_error, PngFault::on_warning)) {
        if (png == nullptr) throw std::bad_alloc();
        info = png_create_info_struct(png);
        if (info == nullptr) {
            png_destroy_read_struct(&png, nullptr, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    PngFault fault;
    ByteView rest;
    png_structp png;
    png_infop info = nullptr;
};

void read_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& rest = *static_cast<ByteView*>(png_get_io_ptr(png));
    if (count > rest.size()) png_error(png, "truncated");
    std::memcpy(bytes, rest.data(), count);
    rest = rest.subspan(count);
}

/// Reads up to the samples and asks for RGB of 8 or 16 bits.
void read_header(PngReader& reader) {
    const png_structp png = reader.png;
    reader.fault.guard(png, [&] {
        png_set_read_fn(png, &reader.rest, read_bytes);
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        // Texts and profiles may unpack to a thousand times their size, and nobody asks for them.
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        png_read_info(png, reader.info);
    });
}

/// Returns the bytes of a row after the transformations.
std::size_t ask_for_rgb(PngReader& reader) {
    const png_structp png = reader.png;
    std::size_t row_bytes = 0;
    reader.fault.guard(png, [&] {
        png_set_palette_to_rgb(png);
        png_set_expand_gray_1_2_4_to_8(png);
        png_set_gray_to_rgb(png);
        png_set_strip_alpha(png);
        png_set_interlace_handling(png);
        png_read_update_info(png, reader.info);
        row_bytes = png_get_rowbytes(png, reader.info);
    });
    return row_bytes;
}

float channel_at(const png_byte* row, std::size_t index, bool wide) {
    if (!wide) return static_cast<float>(row[index]) / 255.0f;
    return static_cast<float>(row[2 * index] << 8 | row[2 * index + 1]) / 65535.0f;
}

}  // namespace

Image decode_png(ByteView file, std::uint64_t memory) {
    PngReader reader(file);
    const png_structp png = reader.png;
    read_header(reader);
    const std::uint32_t width = png_get_image_width(png, reader.info);
    const std::uint32_t height = png_get_image_height(png, reader.info);
    check_unpacked_size(png_get_rowbytes(png, reader.info), height, file.size());

    const std::size_t row_bytes = ask_for_rgb(reader);
    const bool wide = png_get_bit_depth(png, reader.info) == 16;
    if (row_bytes != std::size_t{3} * width * (wide ? 2 : 1)) throw std::runtime_error("cannot be turned into RGB");
    check_memory(row_bytes + sizeof(png_bytep) + sizeof(Rgb) * std::uint64_t{width}, height, memory);

    // All rows at once: an interlaced image is complete in its last pass only.
    std::vector<png_byte> samples(row_bytes * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y) rows[y] = samples.data() + y * row_bytes;
    reader.fault.guard(png, [&] {
        png_read_image(png, rows.data());
        png_read_end(png, nullptr);
    });

    Image image{width, height, std::vector<Rgb>(std::size_t{width} * height)};
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {channel_at(samples.data(), 3 * i, wide), channel_at(samples.data(), 3 * i + 1, wide),
                           channel_at(samples.data(), 3 * i + 2, wide)};
    return image;
}

}  // namespace orrery
