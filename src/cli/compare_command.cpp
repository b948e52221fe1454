#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "cli/commands.hpp"
#include "cli/comparison_text.hpp"
#include "cli/exit_code.hpp"
#include "cli/outputs.hpp"
#include "cli/standard_streams.hpp"
#include "cli/version.hpp"
#include "image/atomic_file.hpp"
#include "image/image_file.hpp"
#include "system/memory.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

bool to_standard_output(const std::optional<std::string>& file) { return file == "-"; }

/// All that can be known to fail before the images are read.
void check_outputs(const ComparisonRequest& request) {
    std::vector<fs::path> read = {request.a, request.b}, written;
    for (const auto& error : {request.error_a, request.error_b})
        if (error) read.push_back(*error);
    if (request.difference) {
        require_known_ending(*request.difference, "--difference");
        written.push_back(*request.difference);
    }
    if (request.json && !to_standard_output(request.json)) written.emplace_back(*request.json);
    require_different_files(read, written);
    for (const fs::path& file : written) AtomicFile{file};
}

/// Reads images as long as there is memory for them.
class Reader {
public:
    Image read(const fs::path& file) {
        Image image = read_image(file, left_);
        left_ -= std::min<std::uint64_t>(left_, image.pixels.size() * sizeof(Rgb));
        return image;
    }
    std::optional<Image> read_if(const std::optional<fs::path>& file) {
        return file ? std::optional(read(*file)) : std::nullopt;
    }
    /// Throws std::runtime_error where what is left is not enough to compare so many pixels.
    void require_room_for(std::uint64_t pixels) const {
        if (pixels <= left_ / comparison_bytes_per_pixel) return;
        throw std::runtime_error(fmt::format("comparing {} pixels takes {:.1f} GB, and {:.1f} GB of memory are left",
                                             pixels, static_cast<double>(pixels * comparison_bytes_per_pixel) / 1e9,
                                             static_cast<double>(left_) / 1e9));
    }

private:
    std::uint64_t left_ = memory_limit();
};

void require_size_of(const Image& a, const ComparisonRequest& request, const Image& other, const fs::path& file) {
    if (other.width == a.width && other.height == a.height) return;
    throw UsageError(fmt::format("{}: found {} x {} pixels, expected {} x {} as in {}", file.string(), other.width,
                                 other.height, a.width, a.height, request.a.string()));
}

void write_difference(const fs::path& file, const ComparisonRequest& request, const Image& a, const Image& b,
                      const Comparison& comparison) {
    const ImageFormat format = image_format(file);
    const bool is_signed = format == ImageFormat::pfm || format == ImageFormat::exr;
    // Where hardly a value differs, the largest difference stands for the percentile, which is zero.
    const double scale = comparison.percentile > 0 ? comparison.percentile : comparison.largest;
    const Metadata metadata = {
        {"difference", fmt::format("{} - {}", request.a.filename().string(), request.b.filename().string())},
        {"scale", is_signed ? "1" : fmt::format("absolute, over {}", scale)},
        {"version", fmt::format("orrery {}", version())}};
    write_image(file, is_signed ? difference(a, b) : visible_difference(a, b, scale), ToneMap::none, metadata);
}

/// Says which limits are exceeded; whether any is.
bool exceeds_limits(const Comparison& c, const ComparisonRequest& request) {
    bool exceeds = false;
    const auto check = [&](const char* name, double value, const std::optional<double>& limit) {
        if (!limit || value <= *limit) return;
        print_error(fmt::format("{} is {}, expected at most {}", name, value, *limit));
        exceeds = true;
    };
    check("rmse", c.rmse, request.max_rmse);
    check("mrse", c.mrse, request.max_mrse);
    if ((request.max_rmse || request.max_mrse) && c.not_finite_a + c.not_finite_b > 0) {
        print_error(fmt::format("{} pixels of A and {} of B are not finite, which no limit allows", c.not_finite_a,
                                c.not_finite_b));
        exceeds = true;
    }
    return exceeds;
}

}  // namespace

int compare_command(const Arguments& arguments) {
    const ComparisonRequest& request = arguments.comparison;
    check_outputs(request);
    Reader reader;
    const Image a = reader.read(request.a), b = reader.read(request.b);
    const std::optional<Image> error_a = reader.read_if(request.error_a), error_b = reader.read_if(request.error_b);
    require_size_of(a, request, b, request.b);
    if (error_a) require_size_of(a, request, *error_a, *request.error_a);
    if (error_b) require_size_of(a, request, *error_b, *request.error_b);
    reader.require_room_for(a.pixels.size());

    const Comparison comparison = compare(a, b, error_a ? &*error_a : nullptr, error_b ? &*error_b : nullptr);
    if (request.difference) write_difference(*request.difference, request, a, b, comparison);
    const std::string json = comparison_json(comparison, request);
    if (to_standard_output(request.json)) {
        print_result(json);
    } else {
        if (request.json) write_atomically(*request.json, std::as_bytes(std::span(json)));
        print_result(comparison_lines(comparison));
    }
    return exceeds_limits(comparison, request) ? exit_code::differs : exit_code::done;
}

}  // namespace orrery
