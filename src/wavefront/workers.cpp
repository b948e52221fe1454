#include "wavefront/workers.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

#include "wavefront/stage_timer.hpp"

namespace orrery {
namespace {

template <class Real>
const kernels::Stages<Real>& supported_stages(Isa isa) {
    if (!isa_supported(isa)) throw std::invalid_argument("this machine does not run " + std::string(isa_name(isa)));
    return kernels::stages_for<Real>(isa);
}

std::uint64_t rays_of(const WaveCounters& counters) { return counters.closest_rays + counters.shadow_rays; }

}  // namespace

template <class Real>
Workers<Real>::Workers(const Plan& plan, const RenderOptions& options, Film& film)
    : plan_(plan),
      options_(options),
      stages_(supported_stages<Real>(options.isa)),
      threads_(options.threads != 0 ? options.threads : static_cast<unsigned>(tbb::info::default_concurrency())),
      wave_size_(choose_wave_size(plan, options.wave_size)),
      first_tick_(TickClock::now()),
      limit_(tbb::global_control::max_allowed_parallelism, threads_),
      arena_(static_cast<int>(threads_)),
      waves_([this, &film] { return Wave<Real>(plan_, stages_, film, wave_size_); }) {}

template <class Real>
void Workers<Real>::run(std::span<const Task> tasks, Progress& progress) {
    std::atomic<bool> stopped = false;
    arena_.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, tasks.size(), 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                Wave<Real>& wave = waves_.local();
                for (std::size_t i = range.begin(); i != range.end() && !stopped; ++i) {
                    const std::uint64_t before = rays_of(wave.counters);
                    if (!render_tile(wave, tasks[i], options_.interrupted)) stopped = true;
                    progress.done(tasks[i].samples(), rays_of(wave.counters) - before);
                }
            },
            tbb::simple_partitioner());
    });
    if (stopped) throw Interrupted{};
}

template <class Real>
void Workers<Real>::report(RenderStats& stats) const {
    stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double seconds_per_tick = stats.seconds / static_cast<double>(TickClock::now() - first_tick_);
    stats.isa = stages_.isa;
    stats.threads = threads_;
    stats.wave_size = wave_size_;
    stats.queue_bytes = queue_bytes(plan_, wave_size_);
    stats.bytes_per_ray = stats.queue_bytes / wave_size_;
    for (const Wave<Real>& wave : waves_) {
        stats.profile.add(profile_of(wave.counters, seconds_per_tick));
        stats.closest_rays += wave.counters.closest_rays;
        stats.shadow_rays += wave.counters.shadow_rays;
        stats.dropped_samples += wave.counters.dropped_samples;
    }
    stats.profile.others = stats.seconds * threads_;
    for (std::size_t s = 0; s < stage_names.size(); ++s)
        stats.profile.others -= stats.profile.total(static_cast<Stage>(s)).seconds;
}

template class Workers<float>;
template class Workers<double>;

}  // namespace orrery
