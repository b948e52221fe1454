#include "openexr_core_reader.hpp"

#include <openexr.h>

#include <stdexcept>

namespace orrery::test {
namespace {

void require(exr_result_t result) {
    if (result != EXR_ERR_SUCCESS) throw std::runtime_error(exr_get_default_error_message(result));
}

/// A file open for reading; part 0 of it is what these tests look at.
class CoreFile {
public:
    explicit CoreFile(const std::filesystem::path& file) { require(exr_start_read(&context, file.c_str(), nullptr)); }
    ~CoreFile() { exr_finish(&context); }
    CoreFile(const CoreFile&) = delete;
    CoreFile& operator=(const CoreFile&) = delete;

    exr_context_t context = nullptr;
};

/// What unpacks one chunk.
class Decoder {
public:
    Decoder(const CoreFile& file, const exr_chunk_info_t& chunk) : context_(file.context) {
        require(exr_decoding_initialize(context_, 0, &chunk, &pipeline));
    }
    ~Decoder() { exr_decoding_destroy(context_, &pipeline); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    exr_decode_pipeline_t pipeline = {};

private:
    exr_const_context_t context_;
};

float& component(Rgb& pixel, const std::string& channel) {
    if (channel == "R") return pixel.r;
    if (channel == "G") return pixel.g;
    if (channel == "B") return pixel.b;
    throw std::runtime_error("channel " + channel);
}

/// Unpacks the chunk that starts at row `y` of the image.
void read_chunk(const CoreFile& file, int first_y, std::uint32_t y, Image& image) {
    exr_chunk_info_t chunk;
    require(exr_read_scanline_chunk_info(file.context, 0, first_y + static_cast<int>(y), &chunk));
    Decoder decoder(file, chunk);
    exr_decode_pipeline_t& pipeline = decoder.pipeline;
    for (int i = 0; i < pipeline.channel_count; ++i) {
        exr_coding_channel_info_t& channel = pipeline.channels[i];
        channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(&component(image.at(0, y), channel.channel_name));
        channel.user_pixel_stride = sizeof(Rgb);
        channel.user_line_stride = static_cast<std::int32_t>(sizeof(Rgb) * image.width);
        channel.user_bytes_per_element = 4;
        channel.user_data_type = EXR_PIXEL_FLOAT;
    }
    require(exr_decoding_choose_default_routines(file.context, 0, &pipeline));
    require(exr_decoding_run(file.context, 0, &pipeline));
}

}  // namespace

CoreExr read_with_core(const std::filesystem::path& path) {
    const CoreFile file(path);
    CoreExr result;

    const exr_attr_chlist_t* channels = nullptr;
    require(exr_get_channels(file.context, 0, &channels));
    for (int i = 0; i < channels->num_channels; ++i) {
        result.channels.emplace_back(channels->entries[i].name.str);
        result.all_float &= channels->entries[i].pixel_type == EXR_PIXEL_FLOAT;
    }
    std::int32_t count = 0;
    require(exr_get_attribute_count(file.context, 0, &count));
    for (std::int32_t i = 0; i < count; ++i) {
        const exr_attribute_t* attribute = nullptr;
        require(exr_get_attribute_by_index(file.context, 0, EXR_ATTR_LIST_FILE_ORDER, i, &attribute));
        result.attributes.emplace_back(attribute->name, attribute->type_name);
    }

    exr_attr_box2i_t window;
    require(exr_get_data_window(file.context, 0, &window));
    Image& image = result.image;
    image.width = static_cast<std::uint32_t>(window.max.x - window.min.x + 1);
    image.height = static_cast<std::uint32_t>(window.max.y - window.min.y + 1);
    image.pixels.resize(std::size_t{image.width} * image.height);
    std::int32_t rows = 0;
    require(exr_get_scanlines_per_chunk(file.context, 0, &rows));
    for (std::uint32_t y = 0; y < image.height; y += static_cast<std::uint32_t>(rows))
        read_chunk(file, window.min.y, y, image);
    return result;
}

std::string core_string_attribute(const std::filesystem::path& path, const std::string& name) {
    const CoreFile file(path);
    std::int32_t length = 0;
    const char* text = nullptr;
    require(exr_attr_get_string(file.context, 0, name.c_str(), &length, &text));
    return {text, static_cast<std::size_t>(length)};
}

}  // namespace orrery::test
