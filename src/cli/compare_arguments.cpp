#include "cli/compare_arguments.hpp"

#include <fmt/format.h>

#include "cli/help.hpp"
#include "cli/option.hpp"
#include "cli/values.hpp"

namespace orrery {
namespace {

constexpr const char* example =
    "Prints, one \"name value\" a line: the mean squared error and its root (mse, rmse); the mean of "
    "(a - b)^2 / (b^2 + 0.01), B being the reference (mrse); the largest |a - b| and its pixel; the |a - b| that 99.9 "
    "% "
    "of the values do not exceed; the mean of a - b, over all and by channel. With standard errors also how many of "
    "them "
    "the mean differs (z): beyond 4 it is hardly noise. An image without --error counts as exact. Pixels that are not "
    "finite are counted and left out; a limit is then exceeded.\n"
    "\n"
    "Example: has the picture changed?\n"
    "  {} compare new.exr reference.exr --max-rmse 0.001 --difference difference.png\n"
    "\n"
    "Exit code: 0 compared and within the limits, 1 the work failed (a file that cannot be read), 2 bad usage or "
    "images "
    "of different size, 3 a limit is exceeded.";

void add_file(CLI::App& app, const char* name, const char* group, const std::string& help,
              std::optional<std::filesystem::path>& file) {
    add_option(app, name, "FILE", help, [&](const std::string& text) { file = text; })->group(group);
}

void add_limit(CLI::App& app, const char* name, const std::string& help, std::optional<double>& limit) {
    add_option(app, name, "X", help, [&](const std::string& text) { limit = parse_limit(text); })->group("Limits");
}

}  // namespace

void add_comparison(CLI::App& app, ComparisonRequest& request) {
    add_option(app, "A", "FILE", "An image: PFM or EXR (linear radiance), PNG or PPM (v / 255)",
               [&](const std::string& text) { request.a = text; })
        ->required()
        ->group("Images");
    add_option(app, "B", "FILE", "The image to compare it with: the reference",
               [&](const std::string& text) { request.b = text; })
        ->required()
        ->group("Images");
    add_file(app, "--error-a", "Images", "Standard errors of A's pixels: an image as render's --error-image writes it",
             request.error_a);
    add_file(app, "--error-b", "Images", "Standard errors of B's pixels", request.error_b);
    add_limit(app, "--max-rmse", "Greatest rmse allowed", request.max_rmse);
    add_limit(app, "--max-mrse", "Greatest mrse allowed", request.max_mrse);
    add_file(app, "--difference", "Reports",
             "Image to write: a - b in .pfm or .exr; in .png or .ppm |a - b|, of which the 99.9th percentile and what "
             "is above are white",
             request.difference);
    add_option(app, "--json", "FILE",
               "Write the figures as JSON, too; - is standard output, which then holds that alone",
               [&](const std::string& text) { request.json = text; })
        ->group("Reports");
    app.footer(fmt::format(example, typed_command()));
}

}  // namespace orrery
