#include "wavefront/render.hpp"

#include <tbb/parallel_for.h>

#include "wavefront/develop.hpp"
#include "wavefront/passes.hpp"
#include "wavefront/workers.hpp"

namespace orrery {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

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
}

/// Pass after pass until the goal is reached.
template <class Real>
void render_in_passes(const Plan& plan, const RenderOptions& options, const Film& film, Workers<Real>& workers,
                      Progress& progress, RenderStats& stats) {
    const Integrator integrator = plan.settings().integrator;
    const auto start = Clock::now();
    Passes passes(plan, options.goal);
    std::vector<ErrorSums> errors(passes.regions().size());
    for (auto tasks = passes.next(0); !tasks.empty(); tasks = passes.next(seconds_since(start))) {
        progress.begin(passes.share_before(), passes.share_after(), work_of(tasks));
        workers.run(tasks, progress);
        const Image image = develop(film, integrator);
        workers.execute([&] {
            const Image of_pixels = develop_error(film, integrator);
            tbb::parallel_for(std::size_t{0}, errors.size(), [&](std::size_t i) {
                errors[i] = error_of_tile(film, integrator, image, of_pixels, passes.regions()[i]);
            });
        });
        passes.learn(errors);
        if (options.pass_done) options.pass_done(passes.error());
    }
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
    Workers<Real> workers(plan, options, film);
    Progress progress(options);
    RenderResult result;
    RenderStats& stats = result.stats;

    if (options.goal.asked()) {
        render_in_passes(plan, options, film, workers, progress, stats);
    } else {
        render_at_once(plan, workers, progress, stats);
    }
    workers.report(stats);

    const Integrator integrator = plan.settings().integrator;
    result.image = develop(film, integrator);
    workers.execute([&] {
        Image errors = develop_error(film, integrator);
        if (!options.goal.asked()) stats.error = estimate_error(film, integrator, result.image, errors);
        if (options.standard_error) result.standard_error = std::move(errors);
    });
    return result;
}

}  // namespace

RenderResult render(const Plan& plan, const RenderOptions& options) {
    return plan.settings().precision == Precision::binary64 ? render_in<double>(plan, options)
                                                            : render_in<float>(plan, options);
}

}  // namespace orrery
