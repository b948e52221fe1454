#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfPartType.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "image/decode_limits.hpp"
#include "image/exr.hpp"
#include "image/exr_header_check.hpp"

namespace orrery {
namespace {

/// An OpenEXR stream out of memory.
class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(ByteView file) : Imf::IStream("image"), file_(file) {}

    bool read(char* bytes, int count) override {
        const auto wanted = static_cast<std::size_t>(std::max(count, 0));
        if (at_ > file_.size() || wanted > file_.size() - at_) throw std::runtime_error("truncated");
        std::memcpy(bytes, file_.data() + at_, wanted);
        at_ += wanted;
        return at_ < file_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

private:
    ByteView file_;
    std::uint64_t at_ = 0;
};

std::int64_t extent(int least, int most) { return std::int64_t{most} - least + 1; }

std::uint64_t bytes_per_pixel(const Imf::ChannelList& channels) {
    std::uint64_t bytes = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw std::runtime_error(fmt::format("channel {} is subsampled", channel.name()));
        bytes += channel.channel().type == Imf::HALF ? 2 : 4;
    }
    return bytes;
}

std::uint64_t rows_per_chunk(Imf::Compression compression) {
    switch (compression) {
        case Imf::NO_COMPRESSION:
        case Imf::RLE_COMPRESSION:
        case Imf::ZIPS_COMPRESSION:
            return 1;
        case Imf::ZIP_COMPRESSION:
        case Imf::PXR24_COMPRESSION:
            return 16;
        case Imf::PIZ_COMPRESSION:
        case Imf::B44_COMPRESSION:
        case Imf::B44A_COMPRESSION:
        case Imf::DWAA_COMPRESSION:
            return 32;
        case Imf::DWAB_COMPRESSION:
            return 256;
        default:
            throw std::runtime_error("unknown compression");
    }
}

/// Refuses what is not the image we read, and sizes the file's length does not justify.
void check_content(const Imf::Header& header, std::size_t file_bytes, std::uint64_t memory) {
    if (header.hasType() && header.type() != Imf::SCANLINEIMAGE) throw std::runtime_error("not a scan-line image");
    for (const char* name : {"R", "G", "B"})
        if (header.channels().findChannel(name) == nullptr)
            throw std::runtime_error(fmt::format("has no channel {}", name));

    const auto& window = header.dataWindow();
    const std::int64_t width = extent(window.min.x, window.max.x);
    const std::int64_t height = extent(window.min.y, window.max.y);
    if (width < 1 || height < 1) throw std::runtime_error("the data window is empty");
    const std::uint64_t pixel_bytes = bytes_per_pixel(header.channels());
    const std::uint64_t row_bytes = pixel_bytes * static_cast<std::uint64_t>(width);
    check_unpacked_size(row_bytes, static_cast<std::uint64_t>(height), file_bytes);

    // OpenEXR allocates a whole chunk even for an image of one row. A chunk of this many bytes is always granted: ZIP
    // needs 12 MiB for a row of 65536 pixels.
    constexpr std::uint64_t granted = std::uint64_t{64} << 20;
    if (row_bytes * rows_per_chunk(header.compression()) > granted)
        check_unpacked_size(row_bytes, rows_per_chunk(header.compression()), file_bytes);
    // Twice a chunk, packed and not, beside the pixels.
    const std::uint64_t chunks = 2 * row_bytes * rows_per_chunk(header.compression());
    check_memory(sizeof(Rgb) * static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height),
                 memory - std::min(chunks, memory));
}

Imf::Header read_header(MemoryInput& stream, ByteView file) {
    constexpr std::size_t magic_and_version = 8;
    int version = std::to_integer<int>(file[4]) | std::to_integer<int>(file[5]) << 8;
    stream.seekg(magic_and_version);
    Imf::Header header;
    header.readFrom(stream, version);
    stream.seekg(0);
    return header;
}

}  // namespace

Image decode_exr(ByteView file, std::uint64_t memory) {
    check_exr_header(file);
    MemoryInput stream(file);
    check_content(read_header(stream, file), file.size(), memory);
    Imf::InputFile input(stream, 0);

    const auto& window = input.header().dataWindow();
    const auto width = static_cast<std::uint32_t>(extent(window.min.x, window.max.x));
    const auto height = static_cast<std::uint32_t>(extent(window.min.y, window.max.y));
    Image image{width, height, std::vector<Rgb>(std::size_t{width} * height)};
    Imf::FrameBuffer buffer;
    const auto insert = [&](const char* name, float& first) {
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, &first, window, sizeof(Rgb), sizeof(Rgb) * width));
    };
    insert("R", image.pixels.front().r);
    insert("G", image.pixels.front().g);
    insert("B", image.pixels.front().b);
    input.setFrameBuffer(buffer);
    input.readPixels(window.min.y, window.max.y);
    return image;
}

}  // namespace orrery
