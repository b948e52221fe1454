#include <fmt/format.h>

#include <memory>
#include <span>
#include <variant>

#include "cli/commands.hpp"
#include "cli/film_store.hpp"
#include "cli/film_subject.hpp"
#include "cli/help.hpp"
#include "cli/images.hpp"
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
#include "system/printable.hpp"

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

constexpr double usual_film_every = 60;  // seconds

struct Stopped {
    int signal;
};

/// Of a save that failed the older film is left, and the render goes on.
bool try_to_save(const fs::path& file, const Ledger& ledger, const FilmSubject& subject) {
    try {
        save_film(file, ledger, subject);
        return true;
    } catch (const std::exception& fault) {
        print_warning(fmt::format("the film is not saved: {}", fault.what()));
        return false;
    }
}

/// Renders under a progress bar until done or until a signal asks to stop. `saved`: whether the film asked for holds
/// what was done.
std::variant<RenderResult, Stopped> render_until_signal(const Plan& plan, const Request& request, const Goal& goal,
                                                        const FilmSubject& subject, Ledger& ledger, bool& saved) {
    const std::string film = request.film ? printable_whole(request.film->string()) : "";
    const std::string sudden = request.film
                                   ? fmt::format("orrery: interrupted: the film {} is as it was saved last\n", film)
                                   : "orrery: interrupted: the render is lost, no image was written\n";
    const Loss loss(sudden.c_str());
    const DeferredSignals signals(request.film.has_value());
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
    if (request.film) {
        options.keep.save = [&](const Ledger& now) { saved = try_to_save(*request.film, now, subject); };
        options.keep.every = request.film_every.value_or(usual_film_every);
        // Of a large image that nobody gave a period for, saving shall not cost more than this.
        if (!request.film_every) options.keep.most_share = 0.01;
    }
    try {
        RenderResult result = render(plan, options, ledger);
        if (signals.caught() == 0) return result;
    } catch (const Interrupted&) {
    }
    bar.reset();
    if (saved) {
        print_message(
            fmt::format("orrery: interrupted: the film {} has what was done; the same command goes on\n", film));
    } else {
        Loss::say();
    }
    return Stopped{signals.caught()};
}

void note_fewer_samples(const Plan& plan, const Goal& goal) {
    if (goal.asked() || plan.samples() == plan.settings().samples) return;
    const auto [estimator, kind] = plan.settings().estimator == Estimator::stratified
                                       ? std::pair{"stratified", "square"}
                                       : std::pair{"sobol", "even"};
    print_message(fmt::format("orrery: note: {} takes {} per pixel, the {} number below the {} asked\n", estimator,
                              counted(plan.samples(), "sample"), kind, plan.settings().samples));
}

/// "x.film: goes on from 37 % of its samples"
std::string begun_text(const fs::path& film, const Ledger& ledger) {
    const Ledger::Samples samples = ledger.samples();
    const double all = samples.taken + samples.asked;
    const std::string passes = ledger.state().halves ? fmt::format(", {:.1f} per pixel", samples.mean()) : "";
    return fmt::format("{}: goes on from {:.3g} % of the samples asked so far{}", film.string(),
                       all > 0 ? 100 * samples.taken / all : 0, passes);
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
        const auto fault = too_many_pixels(scene->settings.window().width(), scene->settings.window().height(),
                                           memory_limit(), timed_bytes_per_pixel);
        if (fault) throw UsageError("--time: " + *fault);
    }
    const Outputs outputs = choose_outputs(request, scene->settings, {scene->file});
    require_writable(outputs, scene->settings);

    const Plan plan = plan_visibly(request, std::move(*scene));
    print_warnings(request, plan);
    if (!request.quiet) note_fewer_samples(plan, goal);
    const FilmSubject subject = film_subject(plan, goal, request.isa, request.exposure.value_or(0));
    const Shard shard = request.shard.value_or(Shard{});
    const bool resumed = outputs.film && fs::exists(*outputs.film);
    const std::unique_ptr<Ledger> ledger =
        resumed ? resume_film(*outputs.film, plan, goal, shard, subject) : begin_film(plan, goal, shard);
    if (resumed && !request.quiet) print_line(begun_text(*outputs.film, *ledger));

    bool saved = false;
    const auto outcome = render_until_signal(plan, request, goal, subject, *ledger, saved);
    if (const auto* stopped = std::get_if<Stopped>(&outcome)) return exit_code::ended_by(stopped->signal);
    const auto& result = std::get<RenderResult>(outcome);
    const RenderStats& stats = result.stats;

    const Making making{.scene = plan.scene().file.filename().string(),
                        .version = std::string(version()),
                        .settings = plan.settings(),
                        .goal = goal,
                        .exposure = request.exposure.value_or(0),
                        .samples = stats.samples_per_pixel};
    const std::vector<fs::path> written = write_images(outputs, result.image, result.standard_error, making);
    const std::size_t images = outputs.images.size() + (outputs.error_image ? 1 : 0);
    if (written.size() < images) {
        if (saved) {
            print_line(develop_hint(*outputs.film));
        } else {
            rescue_film(outputs.images.front(), *ledger, subject);
        }
    }
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
        for (const fs::path& file : request.shard ? std::vector{*outputs.film} : written) print_name(file);
    write_stats(outputs, statistics_json(plan, goal, stats, written));
    return written.size() == images && (saved || !outputs.film) ? exit_code::done : exit_code::failed;
}

void add_film(CLI::App& app, Request& request) {
    const char* group = "Film (a render that can be stopped, continued and divided)";
    add_option(app, "--film", "FILE",
               "Keep what is rendered in FILE, saved now and then, at a signal and at the end; where it is there "
               "already, go on with it",
               [&](const std::string& text) { request.film = text; })
        ->group(group);
    add_option(app, "--film-every", "TIME",
               fmt::format("Save so often, such as 30s or 10m (default: {:.0f}s, and less often where that would take "
                           "more than 1 % of the time)",
                           usual_film_every),
               [&](const std::string& text) { request.film_every = parse_duration(text); })
        ->group(group);
    add_option(app, "--shard", "K/N",
               "Render the K-th of N parts and write no image; develop makes it of the films of all",
               [&](const std::string& text) { request.shard = parse_shard(text); })
        ->group(group);
}

void add_reports(CLI::App& app, Request& request) {
    add_error_image(app, request);
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
    add_outputs(app, *request, " (default: the scene's output)");
    add_settings(app, *request);
    add_exposure(app, *request, "0");
    add_crop(app, *request);
    add_film(app, *request);
    add_reports(app, *request);
    add_quiet(app, request->quiet);
    app.footer(fmt::format(example, typed_command()));
    return [request] { return render_scene(*request); };
}

}  // namespace orrery
