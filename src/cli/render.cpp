#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <variant>

#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/options.hpp"
#include "cli/outputs.hpp"
#include "cli/process.hpp"
#include "cli/progress.hpp"
#include "cli/reports.hpp"
#include "cli/request.hpp"
#include "image/atomic_file.hpp"
#include "scene/counted.hpp"
#include "scene/image_memory.hpp"
#include "system/memory.hpp"

namespace orrery {
namespace {

constexpr const char* example =
    "Example: a quick look, then the real thing in two formats\n"
    "  {0} render scenes/assignment_08.json --size 256x256 --spp 16 -o look.png\n"
    "  {0} render scenes/assignment_08.json --error 2% -o image.png -o image.exr\n"
    "\n"
    "Standard output names the images written, one on a line. Exit code: 0 written, 1 the work failed, 2 bad usage or "
    "a bad scene.";

namespace fs = std::filesystem;

struct Stopped {
    int signal;
};

/// Renders under a progress bar until done or until a signal asks to stop.
std::variant<RenderResult, Stopped> render_until_signal(const Plan& plan, const Request& request, const Goal& goal) {
    const Loss loss("orrery: interrupted: the render is lost, no image was written\n");
    const DeferredSignals signals;
    std::optional<ProgressBar> bar(std::in_place, !request.quiet);
    RenderOptions options;
    options.threads = request.threads;
    options.isa = request.isa;
    options.wave_size = request.wave_size;
    options.goal = goal;
    options.pass_done = [&](const ImageError& error) { bar->set_error(error.relative.value); };
    options.standard_error = request.error_image.has_value();
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

int render_scene(const Request& request) {
    std::optional<Scene> scene = load_scene(request);
    if (!scene) return exit_code::misused;
    const Goal goal = goal_of(request);
    if (goal.seconds > 0) {
        const auto fault =
            too_many_pixels(scene->settings.width, scene->settings.height, memory_limit(), timed_bytes_per_pixel);
        if (fault) throw UsageError("--time: " + *fault);
    }
    const Outputs outputs = choose_outputs(request, *scene);
    require_writable(outputs, *scene);

    const Plan plan = plan_visibly(request, std::move(*scene));
    print_warnings(request, plan);
    if (!request.quiet) note_fewer_samples(plan, goal);
    const auto outcome = render_until_signal(plan, request, goal);
    if (const auto* stopped = std::get_if<Stopped>(&outcome)) return exit_code::ended_by(stopped->signal);
    const auto& result = std::get<RenderResult>(outcome);
    const RenderStats& stats = result.stats;

    const std::vector<fs::path> written = write_all(outputs, plan, result, goal);
    if (!request.quiet) {
        print_message(summary(plan, goal, stats));
        if (stats.dropped_samples > 0)
            print_warning(fmt::format("{} not finite and dropped", counted(stats.dropped_samples, "sample")));
        if (stats.refused_threads > 0)
            print_warning(fmt::format("the system refused {} of {}; the others did the work", stats.refused_threads,
                                      counted(stats.refused_threads + stats.threads, "thread")));
    }
    if (request.profile) print_message(profile_table(stats));
    // Where the statistics take standard output they name the images, and it stays one JSON document.
    if (!outputs.stats_to_standard_output)
        for (const fs::path& file : written) print_name(file);
    write_stats(outputs, statistics_json(plan, goal, stats, written));
    const std::size_t asked = outputs.images.size() + (outputs.error_image ? 1 : 0);
    return written.size() == asked ? exit_code::done : exit_code::failed;
}

void add_outputs(CLI::App& app, Request& request) {
    add_option(app, "-o,--output", "FILE",
               "Image to write: .ppm or .png (8 bit, tone mapped), .pfm or .exr (linear radiance); repeat it for more "
               "(default: the scene's output)",
               [&](const std::string& text) { request.outputs.emplace_back(text); })
        // Each -o is read on its own: a list option of CLI11 would also swallow the SCENE after it.
        ->trigger_on_parse()
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->group("Image");
}

void add_reports(CLI::App& app, Request& request) {
    add_option(app, "--error-image", "FILE", "Write every pixel's standard error, linear: .pfm or .exr",
               [&](const std::string& text) { request.error_image = text; })
        ->group("Reports");
    add_option(app, "--stats", "FILE.json",
               "Write times, ray counts, the image's error and the plan as JSON; - is standard output",
               [&](const std::string& text) { request.stats = text; })
        ->group("Reports");
    app.add_flag("--profile", request.profile, "Print where the time went, by stage and bounce")->group("Reports");
}

}  // namespace

Work add_render(CLI::App& app) {
    const auto request = std::make_shared<Request>();
    add_scene(app, *request);
    add_outputs(app, *request);
    add_settings(app, *request);
    add_reports(app, *request);
    add_quiet(app, request->quiet);
    app.footer(fmt::format(example, typed_command()));
    return [request] { return render_scene(*request); };
}

}  // namespace orrery
