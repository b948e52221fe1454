#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "image/exr.hpp"
#include "image/metadata_text.hpp"

namespace orrery {
namespace {

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
