#include <fmt/format.h>

#include <algorithm>
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
#include "cli/summary.hpp"
#include "image/atomic_file.hpp"
#include "scene/counted.hpp"
#include "scene/image_memory.hpp"
#include "system/memory.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

struct Stopped {
    int signal;
};

/// Renders under a progress bar until done or until a signal asks to stop.
std::variant<RenderResult, Stopped> render_until_signal(const Plan& plan, const Arguments& arguments,
                                                        const Goal& goal) {
    const Loss loss("orrery: interrupted: the render is lost, no image was written\n");
    const DeferredSignals signals;
    std::optional<ProgressBar> bar(std::in_place, !arguments.quiet);
    RenderOptions options;
    options.threads = arguments.threads;
    options.isa = arguments.isa;
    options.wave_size = arguments.wave_size;
    options.goal = goal;
    options.pass_done = [&](const ImageError& error) { bar->set_error(error.relative.value); };
    options.standard_error = arguments.error_image.has_value();
    options.interrupted = [&] { return signals.caught() != 0; };
    if (bar->shows()) options.progress = [&](double fraction, std::uint64_t rays) { bar->update(fraction, rays); };
    try {
        RenderResult result = render(plan, options);
        if (signals.caught() == 0) return result;
    } catch (const Interrupted&) {
    }
    bar.reset();
    Loss::say();
    return Stopped{signals.caught()};
}

/// One file's failure does not keep the others from being written. Returns those that were.
std::vector<fs::path> write_images(const std::vector<fs::path>& files, const Plan& plan, const Image& image,
                                   const Making& making) {
    std::vector<fs::path> written;
    for (const fs::path& file : files) {
        try {
            write_image(file, image, tone_mapper(plan.settings()), image_metadata(plan, image_format(file), making));
            written.push_back(file);
        } catch (const std::runtime_error& fault) {
            print_error(fault.what());
        }
    }
    return written;
}

/// The images, and that of the errors. Returns the files that were written.
std::vector<fs::path> write_all(const Outputs& outputs, const Plan& plan, const RenderResult& result,
                                const Goal& goal) {
    const Loss loss("orrery: interrupted: images that were not written yet are lost\n");
    Making making{.goal = goal, .samples = result.stats.samples_per_pixel};
    std::vector<fs::path> written = write_images(outputs.images, plan, result.image, making);
    if (outputs.error_image) {
        making.content = "standard error";
        std::ranges::copy(write_images({*outputs.error_image}, plan, result.standard_error, making),
                          std::back_inserter(written));
    }
    return written;
}

void note_fewer_samples(const Plan& plan, const Goal& goal) {
    if (goal.asked() || plan.samples() == plan.settings().samples) return;
    print_message(fmt::format("orrery: note: stratified takes {} per pixel, the square number below the {} asked\n",
                              counted(plan.samples(), "sample"), plan.settings().samples));
}

void write_stats(const Outputs& outputs, const std::string& json) {
    if (outputs.stats_to_standard_output) print_result(json);
    if (outputs.stats) write_atomically(*outputs.stats, std::as_bytes(std::span(json)));
}

}  // namespace

int render_command(const Arguments& arguments) {
    std::optional<Scene> scene = load_scene(arguments);
    if (!scene) return exit_code::misused;
    const Goal goal = goal_of(arguments);
    if (goal.seconds > 0) {
        const auto fault =
            too_many_pixels(scene->settings.width, scene->settings.height, memory_limit(), timed_bytes_per_pixel);
        if (fault) throw UsageError("--time: " + *fault);
    }
    const Outputs outputs = choose_outputs(arguments, *scene);
    require_writable(outputs, *scene);

    const Plan plan = plan_visibly(arguments, std::move(*scene));
    print_warnings(arguments, plan);
    if (!arguments.quiet) note_fewer_samples(plan, goal);
    const auto outcome = render_until_signal(plan, arguments, goal);
    if (const auto* stopped = std::get_if<Stopped>(&outcome)) return exit_code::ended_by(stopped->signal);
    const auto& result = std::get<RenderResult>(outcome);
    const RenderStats& stats = result.stats;

    const std::vector<fs::path> written = write_all(outputs, plan, result, goal);
    if (!arguments.quiet) {
        print_message(summary(plan, goal, stats));
        if (stats.dropped_samples > 0)
            print_warning(fmt::format("{} not finite and dropped", counted(stats.dropped_samples, "sample")));
        if (stats.refused_threads > 0)
            print_warning(fmt::format("the system refused {} of {}; the others did the work", stats.refused_threads,
                                      counted(stats.refused_threads + stats.threads, "thread")));
    }
    if (arguments.profile) print_message(profile_table(stats));
    // Where the statistics take standard output they name the images, and it stays one JSON document.
    if (!outputs.stats_to_standard_output)
        for (const fs::path& file : written) print_name(file);
    write_stats(outputs, statistics_json(plan, goal, stats, written));
    const std::size_t asked = outputs.images.size() + (outputs.error_image ? 1 : 0);
    return written.size() == asked ? exit_code::done : exit_code::failed;
}

}  // namespace orrery
