#include "bench/tradeoff/classes.hpp"

#include <string_view>
#include <vector>

#include "film/error.hpp"
#include "wavefront/tile.hpp"

namespace orrery::tradeoff {

namespace {

using Contribution = std::array<std::array<double, 3>, class_names.size()>;

/// What is known of the path in a slot.
struct Path {
    std::uint32_t vertices = 0;  ///< neither mirror nor glass
    bool first_is_diffuse = false, last_is_diffuse = false;
    bool smooth_since = false;  ///< mirror or glass since the last of these
    Contribution brought{};
};

/// Looks on while a wave makes its calls: whatever a call adds to a slot's radiance belongs to the class of its path.
class Watch {
public:
    Watch(Wave<float>& wave, std::size_t pixels) : wave_(wave), sums_(pixels), squares_(pixels) {
        all_squares_.resize(pixels);
    }

    kernels::Runs operator()(const StageCall& call, const StageRun<float>& run) {
        const std::string_view stage = call.stage.name;
        if (stage == "generate") begin_wave();
        if (stage == "scatter") scatter(call);
        if (stage == "connect" || stage == "caustic")
            over_ = stage == "caustic", glossy_ = call.detail == std::string_view("glossy");
        if ((call.stage.writes & radiance_part) == 0 || stage == "generate") return run(wave_.stages, wave_.storage);
        const float* const radiance = wave_.storage.slots.radiance;
        before_.assign(radiance, radiance + 4 * std::size_t{wave_.count});
        const kernels::Runs left = run(wave_.stages, wave_.storage);
        for (std::uint32_t slot = 0; slot < wave_.count; ++slot) {
            Path& path = paths_[slot];
            for (std::size_t c = 0; c < 3; ++c) {
                const double added = double{radiance[4 * slot + c]} - double{before_[4 * slot + c]};
                if (added != 0) path.brought[static_cast<std::size_t>(class_of(path, stage))][c] += added;
            }
        }
        return left;
    }

    /// What the wave's slots brought, to their pixels.
    void end_wave() {
        for (std::size_t slot = 0; slot < paths_.size(); ++slot) {
            const std::size_t pixel = pixels_[slot];
            std::array<double, 3> all{};
            for (std::size_t k = 0; k < class_names.size(); ++k) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const double x = paths_[slot].brought[k][c];
                    sums_[pixel][k][c] += x, squares_[pixel][k][c] += x * x;
                    all[c] += x;
                }
            }
            for (std::size_t c = 0; c < 3; ++c) all_squares_[pixel][c] += all[c] * all[c];
        }
        paths_.clear();
    }

    ClassErrors errors(double n) const {
        ClassErrors errors;
        const double weight = 1 / (3 * static_cast<double>(sums_.size()));
        for (std::size_t pixel = 0; pixel < sums_.size(); ++pixel) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto variance = [&](double sum, double squares) { return (squares - sum * sum / n) / (n - 1); };
                double total = 0;
                for (const auto& of_class : sums_[pixel]) total += of_class[c];
                const double scale = weight / (total / n * (total / n) + relative_floor);
                errors.all += scale * variance(total, all_squares_[pixel][c]);
                for (std::size_t k = 0; k < class_names.size(); ++k)
                    errors.of[k] += scale * variance(sums_[pixel][k][c], squares_[pixel][k][c]);
            }
        }
        return errors;
    }

private:
    void begin_wave() {
        end_wave();
        paths_.assign(wave_.count, {});
        pixels_.assign(wave_.storage.slots.pixel, wave_.storage.slots.pixel + wave_.count);
    }

    void scatter(const StageCall& call) {
        const std::string_view kind = call.detail;
        const bool smooth = kind == "specular" || kind == "dielectric", diffuse = kind == "diffuse";
        for (std::uint32_t i = call.records.begin; i < call.records.begin + call.records.count; ++i) {
            if (wave_.storage.hits.id[i] == kernels::no_sphere) continue;
            Path& path = paths_[wave_.storage.rays.slot[i]];
            path.smooth_since = smooth;
            if (smooth) continue;
            if (path.vertices++ == 0) path.first_is_diffuse = diffuse;
            path.last_is_diffuse = diffuse;
        }
    }

    PathClass class_of(const Path& path, std::string_view stage) const {
        using enum PathClass;
        if (path.vertices == 0) return seen;
        const bool sampled = stage == "shadow";
        const bool glossy = sampled && over_ && glossy_;
        const bool smooth = sampled ? over_ && !glossy_ : path.smooth_since;
        if (!path.first_is_diffuse) return path.vertices == 1 && !smooth && !glossy ? rough_direct : rough_indirect;
        if (smooth) return path.vertices == 1 ? caustic : later_caustic;
        if (glossy || !path.last_is_diffuse) return over_glossy;
        return path.vertices == 1 ? direct : indirect;
    }

    Wave<float>& wave_;
    std::vector<Path> paths_;
    std::vector<std::uint32_t> pixels_;
    std::vector<float> before_;
    std::vector<Contribution> sums_, squares_;
    std::vector<std::array<double, 3>> all_squares_;
    bool over_ = false, glossy_ = false;  ///< where the shadow queue's rays go
};

}  // namespace

ClassErrors class_errors(const Scene& scene, const RenderSettings& settings, std::uint32_t samples) {
    Scene copy = scene;
    copy.settings = settings;
    copy.settings.precision = Precision::binary32;
    copy.settings.estimator = Estimator::uniform;
    copy.settings.samples = samples;
    const Plan plan(std::move(copy));
    const std::function<bool()> never;
    const Cancellation cancellation(never);
    Wave<float> wave(plan, kernels::stages_for(best_isa()), cancellation, choose_wave_size(plan, 0));
    Watch watch(wave, std::size_t{settings.width} * settings.height);
    wave.observer = [&](const StageCall& call, const StageRun<float>& run) { return watch(call, run); };
    const Tiling tiles(settings.width, settings.height, tile_side(plan.samples()));
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        wave.film.clear(tiles[i].width(), tiles[i].height());
        render_tile(wave, {tiles[i], whole_pattern(plan)});
    }
    watch.end_wave();
    return watch.errors(plan.samples());
}

}  // namespace orrery::tradeoff
