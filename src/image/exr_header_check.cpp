#include "image/exr_header_check.hpp"

#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace orrery {
namespace {

constexpr std::size_t longest_name = 255;

/// Takes fields off the front of a piece of the file.
class Fields {
public:
    explicit Fields(ByteView bytes) : rest_(bytes) {}

    bool empty() const { return rest_.empty(); }

    std::uint32_t number() {
        const ByteView bytes = take(4);
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
        return value;
    }

    /// A name that ends with a zero byte.
    std::string_view name() {
        const ByteView window = rest_.first(std::min(rest_.size(), longest_name + 1));
        const auto end = std::find(window.begin(), window.end(), std::byte{0});
        if (end == window.end()) throw std::runtime_error("a name in the header does not end");
        const ByteView taken = take(static_cast<std::size_t>(end - window.begin()) + 1);
        return {reinterpret_cast<const char*>(taken.data()), taken.size() - 1};
    }

    ByteView take(std::size_t count) {
        if (count > rest_.size()) throw std::runtime_error("truncated in the header");
        const ByteView taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }

private:
    ByteView rest_;
};

struct FixedSize {
    std::string_view type;
    std::size_t bytes;
};

// clang-format off
constexpr FixedSize fixed_sizes[] = {
    {"int", 4},   {"float", 4},  {"double", 8},
    {"v2i", 8},   {"v2f", 8},    {"v2d", 16},
    {"v3i", 12},  {"v3f", 12},   {"v3d", 24},
    {"m33f", 36}, {"m33d", 72},  {"m44f", 64}, {"m44d", 128},
    {"box2i", 16},      {"box2f", 16},    {"chromaticities", 32},
    {"compression", 1}, {"lineOrder", 1}, {"envmap", 1},  {"deepImageState", 1},
    {"keycode", 28},    {"timecode", 8},  {"rational", 8}, {"tiledesc", 9}};
// clang-format on

/// Whether a list of channels ends where its attribute does.
bool is_channel_list(ByteView value) {
    constexpr std::size_t type_linearity_and_sampling = 16;
    Fields fields(value);
    while (!fields.name().empty()) fields.take(type_linearity_and_sampling);
    return fields.empty();
}

bool is_preview(ByteView value) {
    Fields fields(value);
    const std::uint64_t width = fields.number();
    const std::uint64_t height = fields.number();
    constexpr std::size_t size_fields = 8, bytes_per_pixel = 4;
    const std::size_t pixels = (value.size() - size_fields) / bytes_per_pixel;
    // Divided, not multiplied: the product may exceed 64 bits.
    return value.size() % bytes_per_pixel == 0 &&
           (width == 0 ? pixels == 0 : pixels % width == 0 && pixels / width == height);
}

bool is_string_vector(ByteView value) {
    Fields fields(value);
    while (!fields.empty()) fields.take(fields.number());
    return true;
}

/// Whether the value is as long as OpenEXR will take it to be. Types it does not know it passes over by size.
bool is_as_long_as_its_type(std::string_view type, ByteView value) {
    if (type == "chlist") return is_channel_list(value);
    if (type == "preview") return is_preview(value);
    if (type == "stringvector") return is_string_vector(value);
    if (type == "floatvector") return value.size() % sizeof(float) == 0;
    for (const FixedSize& fixed : fixed_sizes)
        if (fixed.type == type) return fixed.bytes == value.size();
    return true;
}

}  // namespace

void check_exr_header(ByteView file) {
    Fields fields(file);
    if (fields.number() != static_cast<std::uint32_t>(Imf::MAGIC)) throw std::runtime_error("not an EXR");
    const int version = static_cast<int>(fields.number());
    if (Imf::isTiled(version) || Imf::isMultiPart(version) || Imf::isNonImage(version))
        throw std::runtime_error("only single-part scan-line EXR files are read");
    // An empty name ends the header.
    for (std::string_view name = fields.name(); !name.empty(); name = fields.name()) {
        const std::string_view type = fields.name();
        const ByteView value = fields.take(fields.number());
        if (!is_as_long_as_its_type(type, value))
            throw std::runtime_error(fmt::format("an attribute of {} bytes is no {}", value.size(), type));
    }
}

}  // namespace orrery
