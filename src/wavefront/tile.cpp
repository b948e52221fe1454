#include "wavefront/tile.hpp"

namespace orrery {

namespace {

/// (pixel, sample) pairs per wave: the queues of 2048 take about half of a 1 MiB L2.
constexpr std::uint32_t default_wave_size = 2048;
/// What one thread's queues may take; Whitted's branch stacks make waves smaller, nothing else does.
constexpr std::size_t queue_limit = std::size_t{4} << 20;

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

}  // namespace

std::uint32_t choose_wave_size(const Plan& plan, std::uint32_t asked) {
    std::uint32_t size = asked != 0 ? std::min(asked, 1u << 20) : default_wave_size;
    while (asked == 0 && size > kernels::widest &&
           WaveStorage::bytes(plan.needs(), plan.settings().depth, size) > queue_limit)
        size /= 2;
    return size;
}

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

}  // namespace orrery
