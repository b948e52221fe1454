#include "wavefront/render.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>

#include "wavefront/develop.hpp"
#include "wavefront/stage_timer.hpp"
#include "wavefront/tile.hpp"
#include "wavefront/wave.hpp"

namespace orrery {

namespace {

/// Tells the caller how far the render is, at most ten times a second and from one thread at a time.
class Progress {
public:
    Progress(const RenderOptions& options, std::size_t tiles) : options_(options), tiles_(tiles) {}
    void tile_done(std::uint64_t rays) {
        const std::size_t done = ++done_;
        const std::uint64_t total = rays_ += rays;
        if (!options_.progress) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        const auto now = Clock::now();
        if (!lock || (done < tiles_ && now - last_ < std::chrono::milliseconds(100))) return;
        last_ = now;
        options_.progress(static_cast<double>(done) / static_cast<double>(tiles_), total);
    }

private:
    using Clock = std::chrono::steady_clock;
    const RenderOptions& options_;
    std::size_t tiles_;
    std::atomic<std::size_t> done_ = 0;
    std::atomic<std::uint64_t> rays_ = 0;
    std::mutex mutex_;
    Clock::time_point last_{};
};

}  // namespace

RenderResult render(const Plan& plan, const RenderOptions& options) {
    if (!isa_supported(options.isa))
        throw std::invalid_argument("this machine does not run " + std::string(isa_name(options.isa)));
    const RenderSettings& settings = plan.settings();
    const unsigned threads =
        options.threads != 0 ? options.threads : static_cast<unsigned>(tbb::info::default_concurrency());
    const auto& stages = kernels::stages_for(options.isa);
    const std::uint32_t wave_size = choose_wave_size(plan, options.wave_size);

    Film film(settings.width, settings.height);
    const Tiling tiles(settings.width, settings.height, plan.samples());
    const Pattern pattern = whole_pattern(plan);
    tbb::enumerable_thread_specific<Wave> waves([&] { return Wave(plan, stages, film, wave_size); });
    Progress progress(options, tiles.size());
    std::atomic<bool> stopped = false;

    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t first_tick = TickClock::now();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, tiles.size(), 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                Wave& wave = waves.local();
                for (std::size_t i = range.begin(); i != range.end() && !stopped; ++i) {
                    const std::uint64_t before = wave.counters.closest_rays + wave.counters.shadow_rays;
                    if (!render_tile(wave, tiles[i], pattern, options.interrupted)) stopped = true;
                    progress.tile_done(wave.counters.closest_rays + wave.counters.shadow_rays - before);
                }
            },
            tbb::simple_partitioner());
    });
    if (stopped) throw Interrupted{};

    RenderStats stats;
    stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double seconds_per_tick = stats.seconds / static_cast<double>(TickClock::now() - first_tick);
    stats.isa = stages.isa;
    stats.threads = threads;
    stats.wave_size = wave_size;
    stats.samples_per_pixel = plan.samples();
    stats.queue_bytes = WaveStorage::bytes(plan.needs(), settings.depth, wave_size);
    stats.bytes_per_ray = stats.queue_bytes / wave_size;
    for (const Wave& wave : waves) {
        stats.profile.add(profile_of(wave.counters, seconds_per_tick));
        stats.closest_rays += wave.counters.closest_rays;
        stats.shadow_rays += wave.counters.shadow_rays;
        stats.dropped_samples += wave.counters.dropped_samples;
    }
    stats.profile.others = stats.seconds * threads;
    for (std::size_t s = 0; s < stage_names.size(); ++s)
        stats.profile.others -= stats.profile.total(static_cast<Stage>(s)).seconds;
    RenderResult result;
    result.image = develop(film, settings.integrator);
    if (options.standard_error) result.standard_error = develop_error(film, settings.integrator);
    arena.execute([&] { stats.error = estimate_error(film, settings.integrator, result.image); });
    result.stats = stats;
    return result;
}

}  // namespace orrery
