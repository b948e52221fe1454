#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "cli/process.hpp"
#include "cli/reports.hpp"
#include "image/atomic_file.hpp"
#include "image/compare.hpp"
#include "image/image_file.hpp"
#include "system/memory.hpp"

namespace orrery {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// What `orrery compare` is to compare, what it may find, and where that goes.
struct ComparisonRequest {
    std::filesystem::path a, b;  ///< b is the reference
    std::optional<std::filesystem::path> error_a, error_b;
    std::optional<double> max_rmse, max_mrse;
    std::optional<std::filesystem::path> difference;
    std::optional<std::string> json;  ///< a file, or "-" for standard output
};

constexpr const char* example =
    "Prints, one \"name value\" a line: the mean squared error and its root (mse, rmse); the mean of "
    "(a - b)^2 / (b^2 + 0.01), B being the reference (mrse); the largest |a - b| and its pixel; the |a - b| that "
    "99.9 % of the values do not exceed; the mean of a - b, over all and by channel. With standard errors also how "
    "many of them the mean differs (z): beyond 4 it is hardly noise. An image without --error counts as exact. Pixels "
    "that are not finite are counted and left out; a limit is then exceeded.\n"
    "\n"
    "Example: has the picture changed?\n"
    "  {} compare new.exr reference.exr --max-rmse 0.001 --difference difference.png\n"
    "\n"
    "Exit code: 0 compared and within the limits, 1 the work failed (a file that cannot be read), 2 bad usage or "
    "images of different size, 3 a limit is exceeded.";

void add_file(CLI::App& app, const char* name, const char* group, const std::string& help,
              std::optional<fs::path>& file) {
    add_option(app, name, "FILE", help, [&](const std::string& text) { file = text; })->group(group);
}

void add_limit(CLI::App& app, const char* name, const std::string& help, std::optional<double>& limit) {
    add_option(app, name, "X", help, [&](const std::string& text) { limit = parse_limit(text); })->group("Limits");
}

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

/// All figures by name: one list for lines and JSON.
Json figures(const Comparison& c) {
    Json json = {
        {"pixels", c.pixels},
        {"not_finite_a", c.not_finite_a},
        {"not_finite_b", c.not_finite_b},
        {"mse", c.mse},
        {"rmse", c.rmse},
        {"mrse", c.mrse},
        {"largest_error", c.largest},
        {"largest_error_x", c.largest_x},
        {"largest_error_y", c.largest_y},
        {"percentile_99.9_error", c.percentile},
        {"mean_difference", c.mean_difference},
    };
    constexpr const char* names[] = {"r", "g", "b"};
    const auto by_channel = [&](const char* figure, const double(&values)[3]) {
        for (std::size_t i = 0; i < 3; ++i) json[fmt::format("{}_{}", figure, names[i])] = values[i];
    };
    by_channel("mean_difference", c.channel_difference);
    if (const auto& s = c.significance) {
        json["without_error"] = c.without_error;
        json["standard_error"] = s->error;
        by_channel("standard_error", s->channel_error);
        json["z"] = s->z;
        by_channel("z", s->channel_z);
    }
    return json;
}

/// "name value" lines: "mse 0.0001". Numbers read back to the same double.
std::string comparison_lines(const Comparison& comparison) {
    const Json json = figures(comparison);
    std::string lines;
    for (const auto& figure : json.items()) {
        const Json& value = figure.value();
        const auto add = [&](auto number) {
            fmt::format_to(std::back_inserter(lines), "{} {}\n", figure.key(), number);
        };
        if (value.is_number_float()) {
            add(value.get<double>());
        } else {
            add(value.get<std::uint64_t>());
        }
    }
    return lines;
}

/// An object of the same names, the files compared among them. What is not finite is null.
std::string comparison_json(const Comparison& comparison, const ComparisonRequest& request) {
    Json json = {{"a", request.a.string()}, {"b", request.b.string()}};
    json.update(figures(comparison));
    return json_text(json);
}

int compare_images(const ComparisonRequest& request) {
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

}  // namespace

Work add_compare(CLI::App& app) {
    const auto request = std::make_shared<ComparisonRequest>();
    add_option(app, "A", "FILE", "An image: PFM or EXR (linear radiance), PNG or PPM (v / 255)",
               [request](const std::string& text) { request->a = text; })
        ->required()
        ->group("Images");
    add_option(app, "B", "FILE", "The image to compare it with: the reference",
               [request](const std::string& text) { request->b = text; })
        ->required()
        ->group("Images");
    add_file(app, "--error-a", "Images", "Standard errors of A's pixels: an image as render's --error-image writes it",
             request->error_a);
    add_file(app, "--error-b", "Images", "Standard errors of B's pixels", request->error_b);
    add_limit(app, "--max-rmse", "Greatest rmse allowed", request->max_rmse);
    add_limit(app, "--max-mrse", "Greatest mrse allowed", request->max_mrse);
    add_file(app, "--difference", "Reports",
             "Image to write: a - b in .pfm or .exr; in .png or .ppm |a - b|, of which the 99.9th percentile and what "
             "is above are white",
             request->difference);
    add_option(app, "--json", "FILE",
               "Write the figures as JSON, too; - is standard output, which then holds that alone",
               [request](const std::string& text) { request->json = text; })
        ->group("Reports");
    app.footer(fmt::format(example, typed_command()));
    return [request] { return compare_images(*request); };
}

}  // namespace orrery
