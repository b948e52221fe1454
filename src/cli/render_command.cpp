#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <variant>

#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/metadata.hpp"
#include "cli/outputs.hpp"
#include "cli/profile_table.hpp"
#include "cli/progress.hpp"
#include "cli/signals.hpp"
#include "cli/standard_streams.hpp"
#include "cli/statistics.hpp"
#include "image/atomic_file.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

struct Stopped {
    int signal;
};

/// Renders under a progress bar until done or until a signal asks to stop.
std::variant<RenderResult, Stopped> render_until_signal(const Plan& plan, const Arguments& arguments) {
    const DeferredSignals signals;
    ProgressBar bar(!arguments.quiet);
    RenderOptions options;
    options.threads = arguments.threads;
    options.isa = arguments.isa;
    options.wave_size = arguments.wave_size;
    options.standard_error = arguments.error_image.has_value();
    options.interrupted = [&] { return signals.caught() != 0; };
    if (bar.shows()) options.progress = [&](double fraction, std::uint64_t rays) { bar.update(fraction, rays); };
    try {
        RenderResult result = render(plan, options);
        if (signals.caught() == 0) return result;
    } catch (const Interrupted&) {
    }
    return Stopped{signals.caught()};
}

/// One file's failure does not keep the others from being written. Returns those that were.
std::vector<fs::path> write_images(const std::vector<fs::path>& files, const Plan& plan, const Image& image,
                                   std::string_view content) {
    std::vector<fs::path> written;
    for (const fs::path& file : files) {
        try {
            write_image(file, image, tone_mapper(plan.settings()), image_metadata(plan, image_format(file), content));
            written.push_back(file);
        } catch (const std::runtime_error& fault) {
            print_error(fault.what());
        }
    }
    return written;
}

/// ", error 2.13 % (2.05 to 2.21)", or nothing where nothing is known.
std::string error_text(const RootMeanSquare& error) {
    if (!std::isfinite(error.value)) return "";
    return fmt::format(", error {:.3g} % ({:.3g} to {:.3g})", 100 * error.value, 100 * error.low, 100 * error.high);
}

void print_summary(const Plan& plan, const RenderStats& stats) {
    const RenderSettings& settings = plan.settings();
    print_message(fmt::format("{}: {} x {}, {} samples per pixel in {:.2f} s, {:.1f} Mrays/s ({}, {} threads){}\n",
                              plan.scene().file.string(), settings.width, settings.height, stats.samples_per_pixel,
                              stats.seconds, rays_per_second(stats) / 1e6, isa_name(stats.isa), stats.threads,
                              error_text(stats.error.relative)));
}

void write_stats(const Outputs& outputs, const std::string& json) {
    if (outputs.stats_to_standard_output) print_result(json);
    if (outputs.stats) write_atomically(*outputs.stats, std::as_bytes(std::span(json)));
}

}  // namespace

int render_command(const Arguments& arguments) {
    std::optional<Scene> scene = load_scene(arguments);
    if (!scene) return exit_code::misused;
    const Outputs outputs = choose_outputs(arguments, *scene);
    require_writable(outputs, *scene);

    const Plan plan(std::move(*scene));
    const auto outcome = render_until_signal(plan, arguments);
    if (const auto* stopped = std::get_if<Stopped>(&outcome)) return exit_code::ended_by(stopped->signal);
    const auto& [image, standard_error, stats] = std::get<RenderResult>(outcome);

    std::vector<fs::path> written = write_images(outputs.images, plan, image, "radiance");
    std::size_t asked = outputs.images.size();
    if (outputs.error_image) {
        ++asked;
        std::ranges::copy(write_images({*outputs.error_image}, plan, standard_error, "standard error"),
                          std::back_inserter(written));
    }
    if (!arguments.quiet) {
        print_summary(plan, stats);
        if (stats.dropped_samples > 0)
            print_warning(fmt::format("{} samples were not finite and were dropped", stats.dropped_samples));
    }
    if (arguments.profile) print_message(profile_table(stats));
    // Where the statistics take standard output they name the images, and it stays one JSON document.
    if (!outputs.stats_to_standard_output)
        for (const fs::path& file : written) print_result(file.string() + "\n");
    write_stats(outputs, statistics_json(plan, stats, written));
    return written.size() == asked ? exit_code::done : exit_code::failed;
}

}  // namespace orrery
