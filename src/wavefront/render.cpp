#include "wavefront/render.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "wavefront/wave.hpp"

namespace orrery {

namespace {

/// (pixel, sample) pairs per wave: the queues of 2048 take about half of a 1 MiB L2.
constexpr std::uint32_t default_wave_size = 2048;
/// What one thread's queues may take; Whitted's branch stacks make waves smaller, nothing else does.
constexpr std::size_t queue_limit = std::size_t{4} << 20;

std::uint32_t choose_wave_size(const Plan& plan, std::uint32_t asked) {
    std::uint32_t size = asked != 0 ? std::min(asked, 1u << 20) : default_wave_size;
    while (asked == 0 && size > kernels::widest &&
           WaveStorage::bytes(plan.needs(), plan.settings().depth, size) > queue_limit)
        size /= 2;
    return size;
}

struct Tile {
    std::uint32_t x0, y0, x1, y1;
};

/// Square tiles, numbered row by row. With few samples they are larger, so that a tile fills a wave.
class Tiling {
public:
    Tiling(std::uint32_t width, std::uint32_t height, std::uint32_t samples)
        : width_(width),
          height_(height),
          side_(samples >= 8   ? 16
                : samples >= 2 ? 32
                               : 64) {}
    std::size_t size() const { return std::size_t{across()} * ((height_ + side_ - 1) / side_); }
    Tile operator[](std::size_t i) const {
        const auto x = static_cast<std::uint32_t>(i % across()) * side_;
        const auto y = static_cast<std::uint32_t>(i / across()) * side_;
        return {x, y, std::min(x + side_, width_), std::min(y + side_, height_)};
    }

private:
    std::uint32_t across() const { return (width_ + side_ - 1) / side_; }
    std::uint32_t width_, height_, side_;
};

void trace(Wave& wave) {
    switch (wave.plan.settings().integrator) {
        case Integrator::path_tracing:
            return trace_paths(wave);
        case Integrator::whitted:
            return trace_whitted(wave);
        case Integrator::depth:
            return trace_distances(wave);
    }
}

/// Traces the wave's slots and hands their radiance to the film, in slot order: a pixel's samples are summed in the
/// order of their numbers, whatever the wave size.
void flush(Wave& wave) {
    if (wave.count == 0) return;
    trace(wave);
    const auto& slots = wave.storage.slots;
    for (std::uint32_t s = 0; s < wave.count;) {
        std::uint32_t end = s + 1;
        while (end < wave.count && slots.pixel[end] == slots.pixel[s]) ++end;
        wave.counters.dropped_samples += wave.film.add(slots.pixel[s], slots.radiance + std::size_t{4} * s, end - s);
        s = end;
    }
    wave.count = 0;
}

/// Fills slots with the samples of one pixel from `sample` on, as many as fit. Returns the first sample left.
std::uint32_t fill(Wave& wave, std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
    const Plan& plan = wave.plan;
    const std::uint32_t strata = plan.strata();
    const double cell_width = 2 * plan.half_width() / plan.settings().width / strata;
    const double cell_height = 2 * plan.half_height() / plan.settings().height / strata;
    const double left = (2.0 * x / plan.settings().width - 1) * plan.half_width();
    const double top = (1 - 2.0 * y / plan.settings().height) * plan.half_height();
    const std::uint32_t pixel = y * plan.settings().width + x;
    const std::uint32_t first = wave.count;
    const std::uint32_t count = std::min(plan.samples() - sample, wave.storage.slot_count - first);
    const auto& slots = wave.storage.slots;
    const std::uint32_t end = first + count;
    // A row of cells at a time, so that the inner loop is plain; to uniform samples the pixel is one cell.
    const std::uint32_t row = strata > 1 ? strata : plan.samples();
    const double step = strata > 1 ? cell_width : 0;
    for (std::uint32_t s = first; s < end;) {
        std::uint32_t cell_x = sample % row;
        const auto y_of_row = static_cast<float>(top - sample / row * cell_height);
        for (; s < end && cell_x < row; ++s, ++cell_x) {
            slots.pixel[s] = pixel;
            slots.sample[s] = sample++;
            slots.plane_x[s] = static_cast<float>(left + cell_x * step);
            slots.plane_y[s] = y_of_row;
        }
    }
    wave.count += count;
    return sample;
}

/// All samples of a tile's pixels, a wave at a time. Returns false when interrupted.
bool render_tile(Wave& wave, const Tile& tile, const std::function<bool()>& interrupted) {
    const std::uint32_t samples = wave.plan.samples();
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
        for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
            for (std::uint32_t sample = 0; sample < samples;) {
                if (wave.count == wave.storage.slot_count) {
                    if (interrupted && interrupted()) return false;
                    flush(wave);
                }
                sample = fill(wave, x, y, sample);
            }
        }
    }
    if (interrupted && interrupted()) return false;
    flush(wave);
    return true;
}

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

/// DEPTH's post-process per pixel: 1 - I / (1 + I), written without the cancellation.
void invert_distances(Image& image) {
    for (Rgb& p : image.pixels) {
        const float v = 1.0f / (1.0f + p.r);
        p = {v, v, v};
    }
}

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
    tbb::enumerable_thread_specific<Wave> waves([&] { return Wave(plan, stages, film, wave_size); });
    Progress progress(options, tiles.size());
    std::atomic<bool> stopped = false;

    const auto start = std::chrono::steady_clock::now();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, tiles.size(), 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                Wave& wave = waves.local();
                for (std::size_t i = range.begin(); i != range.end() && !stopped; ++i) {
                    const std::uint64_t before = wave.counters.closest_rays + wave.counters.shadow_rays;
                    if (!render_tile(wave, tiles[i], options.interrupted)) stopped = true;
                    progress.tile_done(wave.counters.closest_rays + wave.counters.shadow_rays - before);
                }
            },
            tbb::simple_partitioner());
    });
    if (stopped) throw Interrupted{};

    RenderStats stats;
    stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    stats.isa = stages.isa;
    stats.threads = threads;
    stats.wave_size = wave_size;
    stats.samples_per_pixel = plan.samples();
    stats.queue_bytes = WaveStorage::bytes(plan.needs(), settings.depth, wave_size);
    stats.bytes_per_ray = stats.queue_bytes / wave_size;
    for (const Wave& wave : waves) {
        for (std::size_t s = 0; s < stats.stage_seconds.size(); ++s)
            stats.stage_seconds[s] += wave.counters.stage_seconds[s];
        stats.closest_rays += wave.counters.closest_rays;
        stats.shadow_rays += wave.counters.shadow_rays;
        stats.dropped_samples += wave.counters.dropped_samples;
    }
    RenderResult result{film.mean(), stats};
    if (settings.integrator == Integrator::depth) invert_distances(result.image);
    return result;
}

}  // namespace orrery
