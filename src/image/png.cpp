#include <png.h>

#include <csetjmp>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "image/codec.hpp"

namespace orrery {
namespace {

// libpng reports errors by longjmp, which must not pass a C++ destructor. Here is the one place that calls setjmp.

/// The error handlers of a libpng struct: the reason is kept, the work given up.
class PngFault {
public:
    /// To be given to png_create_*_struct, with the PngFault as the error pointer.
    [[noreturn]] static void on_error(png_structp png, png_const_charp message);
    /// Warnings concern what is repaired or not used; a library does not write to standard error.
    static void on_warning(png_structp, png_const_charp) {}

    /// Runs `work`, which calls libpng; throws std::runtime_error where libpng gave up. Between setjmp and longjmp no
    /// object with a destructor may come to life, so what `work` needs is made before and captured by reference.
    template <typename Work>
    void guard(png_structp png, const Work& work) {
        static_assert(std::is_trivially_destructible_v<Work>);
        if (setjmp(png_jmpbuf(png)) != 0) raise();
        work();
    }

private:
    [[noreturn]] void raise() const;

    char message_[128] = {};  // not a std::string: on_error is left by longjmp
};

void PngFault::on_error(png_structp png, png_const_charp message) {
    auto* const fault = static_cast<PngFault*>(png_get_error_ptr(png));
    std::strncpy(fault->message_, message, sizeof fault->message_ - 1);
    png_longjmp(png, 1);
}

void PngFault::raise() const { throw std::runtime_error(std::string("libpng: ") + message_); }

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

Bytes encode_png(const Image& tone_mapped, const Metadata& metadata, bool srgb) {
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
        if (srgb) png_set_sRGB(png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
        png_set_text(png, writer.info, texts.chunks.data(), static_cast<int>(texts.chunks.size()));
        png_write_info(png, writer.info);
        for (std::size_t y = 0; y < tone_mapped.height; ++y)
            png_write_row(png, samples.data() + y * 3 * tone_mapped.width);
        png_write_end(png, nullptr);
    });
    return file;
}

}  // namespace orrery
