#include "wavefront/tile.hpp"

#include <stdexcept>

namespace orrery {

namespace {

/// (pixel, sample) pairs per wave: the queues of 2048 take about half of a 1 MiB L2. In double they take all of it, and
/// half as many are no faster.
constexpr std::uint32_t default_wave_size = 2048;
/// What one thread's queues may take; Whitted's branch stacks make waves smaller, nothing else does.
constexpr std::size_t queue_limit = std::size_t{4} << 20;

template <class Real>
void trace(Wave<Real>& wave) {
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
template <class Real>
void flush(Wave<Real>& wave, const Tile& tile) {
    if (wave.count == 0) return;
    const std::uint32_t width = wave.plan.settings().width;
    const Window window = wave.plan.settings().window();
    const std::uint32_t left = window.x0 + tile.x0, top = window.y0 + tile.y0;
    wave.cancellation.check();
    trace(wave);
    const auto& slots = wave.storage.slots;
    for (std::uint32_t s = 0; s < wave.count;) {
        std::uint32_t end = s + 1;
        while (end < wave.count && slots.pixel[end] == slots.pixel[s]) ++end;
        const Real* const radiance = slots.radiance + std::size_t{4} * s;
        const auto pixel = static_cast<std::uint32_t>(slots.pixel[s]);
        const std::uint32_t x = pixel % width - left, y = pixel / width - top;
        const std::size_t place = std::size_t{y} * tile.width() + x;
        wave.counters.dropped_samples += wave.film.add(place, radiance, end - s);
        wave.contrasts.add(wave.film, place, radiance, end - s);
        s = end;
    }
    wave.count = 0;
}

/// Fills slots with the samples of one pixel of the image from the `begin`-th of the pattern on, as many as fit.
/// Returns the first left.
template <class Real>
std::uint32_t fill(Wave<Real>& wave, std::uint32_t x, std::uint32_t y, const Pattern& pattern, std::uint32_t begin) {
    const Plan& plan = wave.plan;
    const bool one_cell = pattern.strata == 1;
    const double cell_width = plan.cell_width(pattern.strata), cell_height = plan.cell_height(pattern.strata);
    const double left = (2.0 * x / plan.settings().width - 1) * plan.half_width();
    const double top = (1 - 2.0 * y / plan.settings().height) * plan.half_height();
    const std::uint32_t pixel = y * plan.settings().width + x;
    const std::uint32_t first = wave.count;
    const std::uint32_t count = std::min(pattern.samples() - begin, wave.storage.slot_count - first);
    const auto& slots = wave.storage.slots;
    const std::uint32_t end = first + count;
    // A row of cells at a time, so that the inner loop is plain; all visits to a single cell are one row.
    const std::uint32_t row = one_cell ? pattern.samples() : pattern.strata;
    const std::uint32_t visits = one_cell ? 1 : pattern.visits;
    const double step = one_cell ? 0 : cell_width;
    for (std::uint32_t s = first; s < end;) {
        std::uint32_t cell_x = begin % row;
        const auto y_of_row = static_cast<Real>(top - begin / row / visits * cell_height);
        for (; s < end && cell_x < row; ++s, ++cell_x) {
            slots.pixel[s] = pixel;
            slots.sample[s] = pattern.first + begin++;
            slots.plane_x[s] = static_cast<Real>(left + cell_x * step);
            slots.plane_y[s] = y_of_row;
        }
    }
    wave.count += count;
    return begin;
}

}  // namespace

std::uint32_t choose_wave_size(const Plan& plan, std::uint32_t asked) {
    if (asked > largest_wave) throw std::invalid_argument("too large a wave");
    std::uint32_t size = asked != 0 ? asked : default_wave_size;
    while (asked == 0 && size > kernels::widest && queue_bytes(plan, size) > queue_limit) size /= 2;
    return size;
}

template <class Real>
void render_tile(Wave<Real>& wave, const Task& task) {
    const auto& [tile, pattern, region] = task;
    wave.camera = wave.tables.camera;
    wave.camera.cell_width = static_cast<Real>(wave.plan.cell_width(pattern.strata));
    wave.camera.cell_height = static_cast<Real>(-wave.plan.cell_height(pattern.strata));
    wave.contrasts.begin(pattern.strata, pattern.visits > 1);
    const Window window = wave.plan.settings().window();
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
        for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
            if (!tile.has(x, y)) continue;
            for (std::uint32_t sample = 0; sample < pattern.samples();) {
                if (wave.count == wave.storage.slot_count) flush(wave, tile);
                sample = fill(wave, window.x0 + x, window.y0 + y, pattern, sample);
            }
        }
    }
    flush(wave, tile);
}

template void render_tile(Wave<float>&, const Task&);
template void render_tile(Wave<double>&, const Task&);

}  // namespace orrery
