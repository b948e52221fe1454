#include "bench/tradeoff/measure.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <stdexcept>

#include "film/error.hpp"
#include "scene/read.hpp"
#include "scene/settings.hpp"
#include "wavefront/render.hpp"

namespace orrery::tradeoff {

namespace {

constexpr std::size_t most_levels = 4;

double processor_seconds_now() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void add_differences(const Image& image, const Image& truth, Level& level) {
    level.differences.resize(3 * image.pixels.size());
    level.squares.resize(3 * image.pixels.size());
    double sum = 0;
    std::size_t at = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (float Rgb::*channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
            const double t = truth.pixels[i].*channel;
            const double difference = (image.pixels[i].*channel - t) / std::sqrt(t * t + relative_floor);
            level.differences[at] += difference;
            level.squares[at++] += difference * difference;
            sum += difference * difference;
        }
    }
    level.mrse.push_back(sum / static_cast<double>(at));
}

}  // namespace

Scene scene_of(const std::filesystem::path& file) {
    ReadResult read = read_scene(file);
    if (read.scene) return std::move(*read.scene);
    std::string faults;
    for (const Diagnostic& fault : read.diagnostics) faults += format_diagnostic(file.string(), fault) + "\n";
    throw std::runtime_error(faults);
}

Shot take(const Scene& scene, const Setup& setup, std::uint32_t strata, std::uint32_t seed) {
    Scene copy = scene;
    copy.settings = setup.settings;
    copy.settings.samples = strata * strata;
    // A sequence is even after powers of two of its points, and whoever chooses it chooses these.
    if (setup.settings.estimator == Estimator::sobol)
        copy.settings.samples = 1u << std::lround(std::log2(copy.settings.samples));
    copy.settings.seed = seed;
    const Plan plan(std::move(copy));
    RenderOptions options;
    options.isa = setup.isa;
    // An error that is never reached: the number of samples ends it.
    if (setup.taking != Taking::at_once)
        options.goal = {
            .error = 1e-9, .samples = std::uint64_t{strata} * strata, .adaptive = setup.taking == Taking::adaptively};
    const double start = processor_seconds_now();
    RenderResult result = render(plan, options);
    const double seconds = processor_seconds_now() - start;
    return {std::move(result.image), seconds, result.stats.samples_per_pixel};
}

std::uint32_t strata_for(const Scene& scene, const Setup& setup, double processor_seconds) {
    // Doubled until it can be measured: the first renders pay for what has never been touched.
    std::uint32_t strata = 1;
    double seconds = take(scene, setup, strata, 0).seconds;
    while (seconds < processor_seconds / 16 && strata < 1024) seconds = take(scene, setup, strata *= 2, 0).seconds;
    return std::max(1u, static_cast<std::uint32_t>(std::lround(strata * std::sqrt(processor_seconds / seconds))));
}

std::vector<Level> levels_up_to(std::uint32_t last) {
    std::vector<Level> levels;
    for (std::uint32_t strata = last; strata > 0 && levels.size() < most_levels; strata /= 2)
        levels.insert(levels.begin(), Level{.strata = strata});
    return levels;
}

std::vector<Cell> cells_of(const Subject& subject, std::size_t index, double processor_seconds) {
    std::vector<Cell> cells;
    std::vector<std::pair<Isa, std::vector<Rgb>>> seen;
    for (const Variant& variant : all_variants()) {
        const bool another_image = std::ranges::any_of(all_settings(), [&](const Setting& setting) {
            return setting.but_for_point_lights && variant.chooses("--" + std::string(setting.option));
        });
        if (another_image && !subject.scene.point_lights.empty()) continue;
        const Setup setup = variant.setup(subject.usual);
        // Passes are even as long as there are few samples, and still not the same.
        const bool in_passes = setup.taking != Taking::at_once;
        auto first = std::pair(setup.isa, take(subject.scene, setup, 4, 0).image.pixels);
        if (!in_passes && std::ranges::find(seen, first) != seen.end()) continue;
        seen.push_back(std::move(first));
        // What the processor and the number format change is time: equal samples compare it without the noise of error.
        std::vector<Level> levels = cells.empty() || !variant.is_about_time()
                                        ? levels_up_to(strata_for(subject.scene, setup, processor_seconds))
                                        : levels_up_to(cells.front().levels.back().strata);
        cells.push_back({index, variant, setup, std::move(levels)});
    }
    return cells;
}

void measure_round(const Subject& subject, Cell& cell, std::uint32_t round) {
    for (std::size_t i = 0; i < cell.levels.size(); ++i) {
        Level& level = cell.levels[i];
        const auto seed = static_cast<std::uint32_t>(1 + round * most_levels + i);
        const Shot shot = take(subject.scene, cell.setup, level.strata, seed);
        level.samples = shot.samples;
        level.seconds.push_back(shot.seconds);
        add_differences(shot.image, subject.reference.image, level);
    }
}

}  // namespace orrery::tradeoff
