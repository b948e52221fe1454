#include "wavefront/workers.hpp"

#include <stdexcept>

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
Workers<Real>::Workers(const Plan& plan, const RenderOptions& options, Ledger& ledger, const Cancellation& cancellation)
    : plan_(plan),
      stages_(supported_stages<Real>(options.isa)),
      ledger_(ledger),
      cancellation_(cancellation),
      wave_size_(choose_wave_size(plan, options.wave_size)),
      first_tick_(tick_count()),
      team_(options.threads),
      waves_(team_.size()) {}

/// Made by the thread that uses it, so that its memory is near.
template <class Real>
Wave<Real>& Workers<Real>::wave_of(unsigned member) {
    std::unique_ptr<Wave<Real>>& wave = waves_[member];
    if (!wave) wave = std::make_unique<Wave<Real>>(plan_, stages_, cancellation_, wave_size_);
    return *wave;
}

template <class Real>
void Workers<Real>::run(Progress& progress, Saver& saver) {
    const std::vector<Task> tasks = ledger_.tasks();
    team_.each(tasks.size(), [&](std::size_t i, unsigned member) {
        const Task& task = tasks[i];
        Wave<Real>& wave = wave_of(member);
        const std::uint64_t rays_before = rays_of(wave.counters), dropped_before = wave.counters.dropped_samples;
        ledger_.take(task, wave.film);
        render_tile(wave, task);
        ledger_.put(task, wave.film, wave.counters.dropped_samples - dropped_before);
        progress.done(task.samples(), rays_of(wave.counters) - rays_before);
        saver.tick();
    });
}

template <class Real>
void Workers<Real>::report(RenderStats& stats) const {
    stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double seconds_per_tick = stats.seconds / static_cast<double>(tick_count() - first_tick_);
    stats.isa = stages_.isa;
    stats.threads = team_.size();
    stats.refused_threads = team_.refused();
    stats.wave_size = wave_size_;
    stats.queue_bytes = queue_bytes(plan_, wave_size_);
    stats.bytes_per_ray = stats.queue_bytes / wave_size_;
    for (const auto& wave : waves_) {
        if (!wave) continue;
        stats.profile.add(profile_of(wave->counters.ticks, seconds_per_tick));
        stats.closest_rays += wave->counters.closest_rays;
        stats.shadow_rays += wave->counters.shadow_rays;
    }
    stats.profile.others = stats.seconds * team_.size();
    for (std::size_t s = 0; s < stage_names.size(); ++s)
        stats.profile.others -= stats.profile.total(static_cast<Stage>(s)).seconds;
}

template class Workers<float>;
template class Workers<double>;

}  // namespace orrery
