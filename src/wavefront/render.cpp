#include "wavefront/render.hpp"

#include <optional>

#include "wavefront/develop.hpp"
#include "wavefront/passes.hpp"
#include "wavefront/workers.hpp"

namespace orrery {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Clock::duration in_seconds(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// Seconds by which a pass may be late: half of what nobody minds.
constexpr double grace = 0.05;

double work_of(const std::vector<Task>& tasks) {
    double samples = 0;
    for (const Task& task : tasks) samples += static_cast<double>(task.samples());
    return samples;
}

/// Every pixel's samples at once, as the plan says.
template <class Real>
void render_at_once(const Plan& plan, Workers<Real>& workers, Progress& progress, RenderStats& stats) {
    const Tiling tiles(plan.settings().width, plan.settings().height, tile_side(plan.samples()));
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < tiles.size(); ++i) tasks.push_back({tiles[i], whole_pattern(plan)});
    progress.begin(0, 1, work_of(tasks));
    workers.run(tasks, progress);
    stats.samples_per_pixel = stats.least_samples = stats.most_samples = plan.samples();
    stats.dropped_samples = workers.dropped_samples();
}

/// Pass after pass until the goal is reached. A pass under way when the time is up is dropped, and the film is what it
/// was before: were each tile kept that was done in time, the slow ones, which are the bright ones, would be missing.
template <class Real>
void render_in_passes(const Plan& plan, const RenderOptions& options, Film& film, Workers<Real>& workers,
                      Cancellation& cancellation, Progress& progress, RenderStats& stats) {
    const Integrator integrator = plan.settings().integrator;
    const Developing how{workers.team(), cancellation};
    const bool timed = options.goal.seconds > 0;
    const auto start = Clock::now();
    Passes passes(plan, options.goal);
    std::vector<ErrorSums> errors(passes.regions().size());
    std::optional<Film> film_before;
    double learning = 0;  // seconds that it takes to learn the error
    for (;;) {
        const Passes before = passes;
        const std::uint64_t dropped_before = workers.dropped_samples();
        if (timed && passes.count() > 0) film_before = film;
        const std::vector<Task> tasks = passes.next(seconds_since(start));
        if (tasks.empty()) break;
        progress.begin(passes.share_before(), passes.share_after(), work_of(tasks));
        if (timed) cancellation.set_deadline(start + in_seconds(options.goal.seconds - learning + grace));
        try {
            workers.run(tasks, progress);
        } catch (const TimeUp&) {
            if (before.count() == 0)
                throw NothingInTime(
                    "not even two samples per pixel fit into the time, so that there is no image; more time, a smaller "
                    "one or a lower depth would help");
            film = std::move(*film_before);
            stats.dropped_samples = dropped_before;
            passes = before;
            passes.stop(StopReason::time);
            break;
        }
        stats.dropped_samples = workers.dropped_samples();
        cancellation.clear_deadline();
        const auto rendered = Clock::now();
        const Image image = develop(film, integrator, how);
        const Image of_pixels = develop_error(film, integrator, how);
        workers.team().each(errors.size(), [&](std::size_t i, unsigned) {
            cancellation.check();
            errors[i] = error_of_tile(film, integrator, image, of_pixels, passes.regions()[i]);
        });
        passes.learn(errors);
        learning = seconds_since(rendered);
        if (options.pass_done) options.pass_done(passes.error());
    }
    cancellation.clear_deadline();
    stats.error = passes.error();
    stats.samples_per_pixel = passes.mean_samples();
    stats.least_samples = passes.least_samples();
    stats.most_samples = passes.most_samples();
    stats.passes = passes.count();
    stats.stopped_by = passes.reason();
}

template <class Real>
RenderResult render_in(const Plan& plan, const RenderOptions& options) {
    Film film(plan.settings().width, plan.settings().height,
              plan.settings().estimator == Estimator::sobol ? Contrasting::one : Contrasting::many);
    Cancellation cancellation(options.interrupted);
    Workers<Real> workers(plan, options, film, cancellation);
    Progress progress(options);
    RenderResult result;
    RenderStats& stats = result.stats;

    if (options.goal.asked()) {
        render_in_passes(plan, options, film, workers, cancellation, progress, stats);
    } else {
        render_at_once(plan, workers, progress, stats);
    }
    workers.report(stats);

    const Integrator integrator = plan.settings().integrator;
    const Developing how{workers.team(), cancellation};
    result.image = develop(film, integrator, how);
    Image errors = develop_error(film, integrator, how);
    if (!options.goal.asked()) stats.error = estimate_error(film, integrator, result.image, errors, how);
    if (options.standard_error) result.standard_error = std::move(errors);
    return result;
}

}  // namespace

RenderResult render(const Plan& plan, const RenderOptions& options) {
    return plan.settings().precision == Precision::binary64 ? render_in<double>(plan, options)
                                                            : render_in<float>(plan, options);
}

}  // namespace orrery
