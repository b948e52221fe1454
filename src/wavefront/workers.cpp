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
Workers<Real>::Workers(const Plan& plan, const RenderOptions& options, Film& film, const Cancellation& cancellation)
    : plan_(plan),
      stages_(supported_stages<Real>(options.isa)),
      film_(film),
      cancellation_(cancellation),
      wave_size_(choose_wave_size(plan, options.wave_size)),
      first_tick_(tick_count()),
      team_(options.threads),
      waves_(team_.size()) {}

/// Made by the thread that uses it, so that its memory is near.
template <class Real>
Wave<Real>& Workers<Real>::wave_of(unsigned member) {
    std::unique_ptr<Wave<Real>>& wave = waves_[member];
    if (!wave) wave = std::make_unique<Wave<Real>>(plan_, stages_, film_, cancellation_, wave_size_);
    return *wave;
}

template <class Real>
void Workers<Real>::run(std::span<const Task> tasks, Progress& progress) {
    team_.each(tasks.size(), [&](std::size_t i, unsigned member) {
        Wave<Real>& wave = wave_of(member);
        const std::uint64_t before = rays_of(wave.counters);
        render_tile(wave, tasks[i]);
        progress.done(tasks[i].samples(), rays_of(wave.counters) - before);
    });
}

template <class Real>
std::uint64_t Workers<Real>::dropped_samples() const {
    std::uint64_t sum = 0;
    for (const auto& wave : waves_) sum += wave ? wave->counters.dropped_samples : 0;
    return sum;
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
