#include <fmt/format.h>

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
std::vector<fs::path> write_images(const std::vector<fs::path>& files, const Plan& plan, const Image& image) {
    std::vector<fs::path> written;
    for (const fs::path& file : files) {
        try {
            write_image(file, image, tone_mapper(plan.settings()), image_metadata(plan, image_format(file)));
            written.push_back(file);
        } catch (const std::runtime_error& fault) {
            print_error(fault.what());
        }
    }
    return written;
}

void print_summary(const Plan& plan, const RenderStats& stats) {
    const RenderSettings& settings = plan.settings();
    print_message(fmt::format("{}: {} x {}, {} samples per pixel in {:.2f} s, {:.1f} Mrays/s ({}, {} threads)\n",
                              plan.scene().file.string(), settings.width, settings.height, stats.samples_per_pixel,
                              stats.seconds, rays_per_second(stats) / 1e6, isa_name(stats.isa), stats.threads));
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
    const auto& [image, stats] = std::get<RenderResult>(outcome);

    const std::vector<fs::path> written = write_images(outputs.images, plan, image);
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
    return written.size() == outputs.images.size() ? exit_code::done : exit_code::failed;
}

}  // namespace orrery
