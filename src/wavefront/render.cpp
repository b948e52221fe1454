#include "wavefront/render.hpp"

#include <algorithm>
#include <limits>

#include "wavefront/develop.hpp"
#include "wavefront/ledger.hpp"
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

/// Whatever is asked of every pixel, at once.
template <class Real>
void render_at_once(Ledger& ledger, Workers<Real>& workers, Saver& saver, Progress& progress) {
    const Ledger::Samples samples = ledger.samples();
    progress.begin(0, 1, samples.taken + samples.asked, samples.taken);
    workers.run(progress, saver);
}

/// Pass after pass until the goal is reached. A pass under way when the time is up is dropped, and the film is what it
/// was before: were each tile kept that was done in time, the slow ones, which are the bright ones, would be missing.
template <class Real>
void render_in_passes(const Plan& plan, const RenderOptions& options, Ledger& ledger, Workers<Real>& workers,
                      Saver& saver, Cancellation& cancellation, Progress& progress, RenderStats& stats) {
    const Integrator integrator = plan.settings().integrator;
    const Developing how{workers.team(), cancellation};
    const bool timed = options.goal.seconds > 0;
    const auto start = Clock::now() - in_seconds(saver.seconds());
    Passes passes(plan, options.goal, ledger.state());
    std::vector<ErrorSums> errors(passes.regions().size());
    double learning = 0;  // seconds that it takes to learn the error
    for (bool resumed = passes.count() > 0;; resumed = false) {
        const Passes before = passes;
        const bool may_drop = timed && before.count() > 0 && !resumed;
        if (may_drop) ledger.mark();
        if (!resumed && !passes.next(seconds_since(start), ledger.state())) break;
        const double asked = ledger.samples().asked;
        progress.begin(passes.share_before(), passes.share_after(), asked);
        if (timed && !resumed) cancellation.set_deadline(start + in_seconds(options.goal.seconds - learning + grace));
        try {
            workers.run(progress, saver);
        } catch (const TimeUp&) {
            if (!may_drop)
                throw NothingInTime(
                    "not even two samples per pixel fit into the time, so that there is no image; more time, a smaller "
                    "one or a lower depth would help");
            ledger.go_back();
            passes = before;
            passes.stop(StopReason::time);
            break;
        }
        cancellation.clear_deadline();
        const auto rendered = Clock::now();
        const Image image = develop(ledger.film(), integrator, how);
        const Image of_pixels = develop_error(ledger.film(), integrator, how);
        workers.team().each(errors.size(), [&](std::size_t i, unsigned) {
            cancellation.check();
            errors[i] = error_of_tile(ledger.film(), integrator, image, of_pixels, passes.regions()[i]);
        });
        passes.learn(errors);
        learning = seconds_since(rendered);
        if (options.pass_done) options.pass_done(passes.error());
    }
    ledger.unmark();
    cancellation.clear_deadline();
    stats.error = passes.error();
    stats.passes = passes.count();
    stats.stopped_by = passes.reason();
}

template <class Real>
RenderResult render_in(const Plan& plan, const RenderOptions& options, Ledger& ledger) {
    Cancellation cancellation(options.interrupted);
    Workers<Real> workers(plan, options, ledger, cancellation);
    Progress progress(options);
    Saver saver(options.keep, ledger);
    RenderResult result;
    RenderStats& stats = result.stats;

    ledger.state().finished = false;
    try {
        if (options.goal.asked()) {
            render_in_passes(plan, options, ledger, workers, saver, cancellation, progress, stats);
        } else {
            render_at_once(ledger, workers, saver, progress);
        }
    } catch (...) {
        saver.finish(saver.seconds());
        throw;
    }
    ledger.state().finished = true;
    // Time that is left could not be used: another run shall not try again.
    saver.finish(stats.stopped_by == StopReason::time ? std::max(saver.seconds(), options.goal.seconds)
                                                      : saver.seconds());
    workers.report(stats);
    const Ledger::Samples samples = ledger.samples();
    stats.samples_per_pixel = samples.mean();
    stats.least_samples = samples.least;
    stats.most_samples = samples.most;
    stats.dropped_samples = samples.dropped;
    if (ledger.state().shard.of > 1) {
        constexpr RootMeanSquare unknown{std::numeric_limits<double>::infinity(), 0,
                                         std::numeric_limits<double>::infinity()};
        stats.error = {unknown, unknown};
        return result;
    }

    const Integrator integrator = plan.settings().integrator;
    const Developing how{workers.team(), cancellation};
    result.image = develop(ledger.film(), integrator, how);
    Image errors = develop_error(ledger.film(), integrator, how);
    if (!options.goal.asked()) stats.error = estimate_error(ledger.film(), integrator, result.image, errors, how);
    if (options.standard_error) result.standard_error = std::move(errors);
    return result;
}

}  // namespace

std::unique_ptr<Ledger> begin_film(const Plan& plan, const Goal& goal, Shard shard) {
    const RenderSettings& settings = plan.settings();
    FilmState state = goal.asked() ? Passes::layout() : FilmState{.side = tile_side(plan.samples())};
    state.shard = shard;
    const Window window = settings.window();
    auto ledger =
        std::make_unique<Ledger>(Film(window.width(), window.height(), contrasting_of(settings)), std::move(state));
    if (goal.asked()) return ledger;
    const Pattern all = whole_pattern(plan);
    std::vector<FilmRegion>& regions = ledger->state().regions;
    for (std::size_t i = 0; i < regions.size(); ++i)
        if (shard.has(i)) regions[i].strata = all.strata, regions[i].visits = all.visits;
    return ledger;
}

RenderResult render(const Plan& plan, const RenderOptions& options, Ledger& ledger) {
    return plan.settings().precision == Precision::binary64 ? render_in<double>(plan, options, ledger)
                                                            : render_in<float>(plan, options, ledger);
}

RenderResult render(const Plan& plan, const RenderOptions& options) {
    return render(plan, options, *begin_film(plan, options.goal));
}

}  // namespace orrery
