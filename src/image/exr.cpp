// Written by OpenEXR, read by OpenEXRCore, which checks every size in a header against the file's before it uses it.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <openexr.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>

#include "image/codec.hpp"

namespace orrery {
namespace {

/// A file in memory, open for reading. Its one part is what we read.
class ExrInput {
public:
    explicit ExrInput(ByteView file) : file_(file) {
        exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
        how.error_handler_fn = on_error;
        how.user_data = this;
        how.read_fn = read;
        how.size_fn = size;
        // What is damaged is refused: OpenEXR would look through the file for chunks that its table does not name.
        how.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
        require(exr_start_read(&context, "image", &how));
    }
    ~ExrInput() { exr_finish(&context); }
    ExrInput(const ExrInput&) = delete;
    ExrInput& operator=(const ExrInput&) = delete;

    void require(exr_result_t result) const {
        if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
        if (result != EXR_ERR_SUCCESS)
            throw std::runtime_error(message_[0] != 0 ? message_ : exr_get_default_error_message(result));
    }

    exr_context_t context = nullptr;

private:
    static ExrInput& of(void* user) { return *static_cast<ExrInput*>(user); }
    static std::int64_t size(exr_const_context_t, void* user) {
        return static_cast<std::int64_t>(of(user).file_.size());
    }
    static std::int64_t read(exr_const_context_t, void* user, void* bytes, std::uint64_t count, std::uint64_t offset,
                             exr_stream_error_func_ptr_t) {
        const ByteView rest = of(user).file_.subspan(std::min<std::uint64_t>(offset, of(user).file_.size()));
        const std::size_t there = std::min<std::uint64_t>(count, rest.size());
        if (there > 0) std::memcpy(bytes, rest.data(), there);
        return static_cast<std::int64_t>(there);
    }
    static void on_error(exr_const_context_t context, exr_result_t, const char* message) {
        void* user = nullptr;
        if (exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || user == nullptr) return;
        std::strncpy(of(user).message_, message, sizeof message_ - 1);
    }

    ByteView file_;
    char message_[256] = {};  // not a std::string: no exception passes through a library in C
};

/// Refuses what is not the image we read, and sizes that the file's length does not justify. Returns rows per chunk.
std::uint32_t check_content(const ExrInput& input, std::uint64_t width, std::uint64_t height, std::size_t file_bytes,
                            std::uint64_t memory) {
    const exr_attr_chlist_t* channels = nullptr;
    input.require(exr_get_channels(input.context, 0, &channels));
    const std::span all(channels->entries, static_cast<std::size_t>(channels->num_channels));
    for (const std::string_view name : {"R", "G", "B"})
        if (std::ranges::none_of(all, [&](const auto& channel) { return channel.name.str == name; }))
            throw std::runtime_error(fmt::format("has no channel {}", name));
    std::uint64_t row_bytes = 0;
    for (const exr_attr_chlist_entry_t& channel : all) {
        if (channel.x_sampling != 1 || channel.y_sampling != 1)
            throw std::runtime_error(fmt::format("channel {} is subsampled", channel.name.str));
        row_bytes += width * (channel.pixel_type == EXR_PIXEL_HALF ? 2 : 4);
    }
    if (sizeof(Rgb) * width > std::uint64_t{std::numeric_limits<std::int32_t>::max()})
        throw std::runtime_error("its rows are too long");
    check_unpacked_size(row_bytes, height, file_bytes);

    // A whole chunk is taken even for an image of one row. One of this many bytes is always granted: ZIP needs 12 MiB
    // for a row of 65536 pixels.
    constexpr std::uint64_t granted = std::uint64_t{64} << 20;
    std::int32_t rows = 0;
    input.require(exr_get_scanlines_per_chunk(input.context, 0, &rows));
    const std::uint64_t chunk_bytes = row_bytes * static_cast<std::uint64_t>(rows);
    if (chunk_bytes > granted) check_unpacked_size(row_bytes, static_cast<std::uint64_t>(rows), file_bytes);
    // Twice a chunk, packed and not, beside the pixels.
    check_memory(sizeof(Rgb) * width, height, memory - std::min(2 * chunk_bytes, memory));
    return static_cast<std::uint32_t>(rows);
}

/// Unpacks the chunk of the row `y` of the file, which is row `row` of the image.
void read_chunk(const ExrInput& input, int y, std::uint32_t row, Image& image) {
    exr_chunk_info_t chunk;
    input.require(exr_read_scanline_chunk_info(input.context, 0, y, &chunk));
    exr_decode_pipeline_t pipeline = {};
    input.require(exr_decoding_initialize(input.context, 0, &chunk, &pipeline));
    for (exr_coding_channel_info_t& channel :
         std::span(pipeline.channels, static_cast<std::size_t>(pipeline.channel_count))) {
        Rgb& first = image.at(0, row);
        const std::string_view name = channel.channel_name;
        float* const to = name == "R" ? &first.r : name == "G" ? &first.g : name == "B" ? &first.b : nullptr;
        channel.decode_to_ptr = reinterpret_cast<std::uint8_t*>(to);
        channel.user_pixel_stride = sizeof(Rgb);
        channel.user_line_stride = static_cast<std::int32_t>(sizeof(Rgb) * image.width);
        channel.user_bytes_per_element = sizeof(float);
        channel.user_data_type = EXR_PIXEL_FLOAT;
    }
    exr_result_t result = exr_decoding_choose_default_routines(input.context, 0, &pipeline);
    if (result == EXR_ERR_SUCCESS) result = exr_decoding_run(input.context, 0, &pipeline);
    exr_decoding_destroy(input.context, &pipeline);
    input.require(result);
}

/// An OpenEXR stream into memory. OpenEXR seeks back to fill in the table of chunks.
class MemoryOutput : public Imf::OStream {
public:
    explicit MemoryOutput(Bytes& file) : Imf::OStream("image"), file_(file) {}

    void write(const char* bytes, int count) override {
        const ByteView view = std::as_bytes(std::span(bytes, static_cast<std::size_t>(count)));
        if (at_ + view.size() > file_.size()) file_.resize(at_ + view.size());
        std::copy(view.begin(), view.end(), file_.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ += view.size();
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }

private:
    Bytes& file_;
    std::size_t at_ = 0;
};

Imf::Header exr_header(const Image& image, const Metadata& metadata) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const char* channel : {"R", "G", "B"}) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    for (const auto& [key, value] : metadata)
        header.insert("orrery:" + metadata_key(key), Imf::StringAttribute(metadata_value(value)));
    return header;
}

Imf::FrameBuffer frame_buffer(const Image& image, const Imf::Header& header) {
    const Rgb& first = image.pixels.front();
    Imf::FrameBuffer buffer;
    const auto insert = [&](const char* name, const float& channel) {
        buffer.insert(
            name, Imf::Slice::Make(Imf::FLOAT, &channel, header.dataWindow(), sizeof(Rgb), sizeof(Rgb) * image.width));
    };
    insert("R", first.r);
    insert("G", first.g);
    insert("B", first.b);
    return buffer;
}

}  // namespace

Image decode_exr(ByteView file, std::uint64_t memory) {
    const ExrInput input(file);
    int parts = 0;
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
    input.require(exr_get_count(input.context, &parts));
    input.require(exr_get_storage(input.context, 0, &storage));
    if (parts != 1 || storage != EXR_STORAGE_SCANLINE)
        throw std::runtime_error("only single-part scan-line EXR files are read");

    exr_attr_box2i_t window;
    input.require(exr_get_data_window(input.context, 0, &window));
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1) throw std::runtime_error("the data window is empty");
    const std::uint32_t rows = check_content(input, static_cast<std::uint64_t>(width),
                                             static_cast<std::uint64_t>(height), file.size(), memory);
    Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                std::vector<Rgb>(static_cast<std::size_t>(width * height))};
    for (std::uint32_t y = 0; y < image.height; y += rows)
        read_chunk(input, static_cast<int>(window.min.y + std::int64_t{y}), y, image);
    return image;
}

Bytes encode_exr(const Image& linear, const Metadata& metadata) {
    if (std::max(linear.width, linear.height) > std::uint32_t{std::numeric_limits<int>::max()})
        throw std::runtime_error("too large for EXR");
    Bytes file;
    {
        MemoryOutput stream(file);
        // No worker threads of its own: the caller's threads are busy rendering.
        Imf::OutputFile output(stream, exr_header(linear, metadata), 0);
        output.setFrameBuffer(frame_buffer(linear, output.header()));
        output.writePixels(static_cast<int>(linear.height));
    }  // the file is complete once the table of chunks is written, on destruction
    return file;
}

}  // namespace orrery
