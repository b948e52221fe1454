#include <png.h>

#include <new>
#include <stdexcept>
#include <string>

#include "image/metadata_text.hpp"
#include "image/png.hpp"
#include "image/png_fault.hpp"
#include "image/quantise.hpp"

namespace orrery {
namespace {

/// A libpng write struct that lives as long as this object.
class PngWriter {
public:
    PngWriter()
        : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &fault, PngFault::on_error, PngFault::on_warning)) {
        if (png == nullptr) throw std::bad_alloc();
        info = png_create_info_struct(png);
        if (info == nullptr) {
            png_destroy_write_struct(&png, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    PngFault fault;
    png_structp png;
    png_infop info = nullptr;
};

/// The text chunks, and the strings libpng's structs point to.
class PngTexts {
public:
    explicit PngTexts(const Metadata& metadata) {
        strings_.reserve(metadata.size());
        for (const auto& [key, value] : metadata) {
            auto& [text_key, text_value] = strings_.emplace_back(metadata_key(key), metadata_value(value));
            png_text& chunk = chunks.emplace_back();
            const bool latin = is_ascii(text_value);
            chunk.compression = latin ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
            chunk.key = text_key.data();
            chunk.text = text_value.data();
            (latin ? chunk.text_length : chunk.itxt_length) = text_value.size();
        }
    }
    PngTexts(const PngTexts&) = delete;
    PngTexts& operator=(const PngTexts&) = delete;

    std::vector<png_text> chunks;

private:
    Metadata strings_;
};

bool try_append(Bytes& file, ByteView bytes) noexcept {
    try {
        append(file, bytes);
        return true;
    } catch (const std::bad_alloc&) {
        return false;
    }
}

// No exception passes through libpng, which is C, and no longjmp leaves a catch clause.
void write_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto& file = *static_cast<Bytes*>(png_get_io_ptr(png));
    if (!try_append(file, std::as_bytes(std::span(bytes, count)))) png_error(png, "out of memory");
}

}  // namespace

Bytes encode_png(const Image& tone_mapped, const Metadata& metadata) {
    Bytes file;
    const std::vector<std::uint8_t> samples = quantised(tone_mapped);
    const PngTexts texts(metadata);
    PngWriter writer;
    const png_structp png = writer.png;
    writer.fault.guard(png, [&] {
        // libpng's own limit is a million; what fits its 31 bits is an image here.
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_write_fn(png, &file, write_bytes, nullptr);
        png_set_IHDR(png, writer.info, tone_mapped.width, tone_mapped.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_text(png, writer.info, texts.chunks.data(), static_cast<int>(texts.chunks.size()));
        png_write_info(png, writer.info);
        for (std::size_t y = 0; y < tone_mapped.height; ++y)
            png_write_row(png, samples.data() + y * 3 * tone_mapped.width);
        png_write_end(png, nullptr);
    });
    return file;
}

}  // namespace orrery
