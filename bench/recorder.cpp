#include "bench/recorder.hpp"

#include <algorithm>

#include "wavefront/tile.hpp"

namespace orrery::bench {

std::vector<const StageCall*> Recording::of(const std::string& stage, std::uint32_t bounce) const {
    std::vector<const StageCall*> found;
    for (const StageCall& call : calls)
        if (call.stage == stage && call.bounce == bounce) found.push_back(&call);
    return found;
}

std::vector<std::pair<std::string, std::uint32_t>> Recording::kinds() const {
    std::vector<std::pair<std::string, std::uint32_t>> found;
    for (const StageCall& call : calls) {
        const std::pair kind(call.stage, call.bounce);
        if (std::find(found.begin(), found.end(), kind) == found.end()) found.push_back(kind);
    }
    return found;
}

Recording record(const Plan& plan, std::uint32_t waves) {
    Recording recording;
    recording.wave_size = choose_wave_size(plan, 0);
    const auto& stages = kernels::stages_for(best_isa());
    const std::function<bool()> never;
    const Cancellation cancellation(never);
    Wave<float> wave(plan, stages, cancellation, recording.wave_size);
    wave.observer = [&](const orrery::StageCall& call, const StageRun<float>& run) {
        const auto& [stage, bounce, records, bytes, lanes, detail, moved_bytes, target] = call;
        const bool recorded = stage.writes != 0 && records.count != 0 && (bounce == 0 || bounce == 1 || bounce == 3);
        if (recorded) {
            const std::string name = stage.name + std::string(*detail != 0 ? " " : "") + detail;
            // Picks name the rays and hits that are read: any of them.
            const std::uint32_t reach = (stage.reads & pick_part) != 0 ? kernels::ray_capacity(wave.storage.slot_count)
                                                                       : records.begin + records.count;
            recording.calls.push_back({name, bounce, records.count, bytes, stage.writes, wave.count, target,
                                       Snapshot(wave.storage, stage.reads, wave.count, reach), run});
        }
        const kernels::Runs left = run(stages, wave.storage);
        if (recorded && left.moved) recording.calls.back().bytes += moved_bytes;
        return left;
    };
    const Tiling tiles(plan.settings().width, plan.settings().height, tile_side(plan.samples()));
    // Steps of the golden section visit the image evenly, whatever the number of tiles in a row.
    const auto step = static_cast<std::size_t>(0.618 * static_cast<double>(tiles.size())) | 1;
    for (std::size_t i = 0; i < waves; ++i) {
        Tile tile = tiles[(i + 1) * step % tiles.size()];
        const std::uint32_t pixels = std::max(1u, recording.wave_size / plan.samples());  // one wave of it is enough
        tile.x1 = std::min(tile.x1, tile.x0 + pixels);
        tile.y1 = std::min(tile.y1, tile.y0 + std::max(1u, pixels / (tile.x1 - tile.x0)));
        wave.film.clear(tile.width(), tile.height());
        render_tile(wave, {tile, whole_pattern(plan)});
    }
    return recording;
}

}  // namespace orrery::bench
