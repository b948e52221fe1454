#include "wavefront/ledger.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <tuple>

namespace orrery {

Ledger::Ledger(Film film, FilmState state) : film_(std::move(film)), state_(std::move(state)) {
    state_.regions.resize(state_.tiling(film_.width(), film_.height()).size());
}

std::vector<Task> Ledger::tasks() const {
    const Tiling tiling = state_.tiling(film_.width(), film_.height());
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < state_.regions.size(); ++i) {
        const FilmRegion& region = state_.regions[i];
        if (region.asked() > 0) tasks.push_back({tiling[i], {region.strata, region.visits, region.taken}, i});
    }
    return tasks;
}

Ledger::Samples Ledger::samples() const {
    const Tiling tiling = state_.tiling(film_.width(), film_.height());
    Samples sum{.least = std::numeric_limits<std::uint32_t>::max()};
    for (std::size_t i = 0; i < state_.regions.size(); ++i) {
        if (!state_.shard.has(i)) continue;
        const FilmRegion& region = state_.regions[i];
        const std::uint32_t pixels = tiling[i].pixels();
        sum.pixels += pixels;
        sum.taken += static_cast<double>(pixels) * region.taken;
        sum.asked += pixels * static_cast<double>(region.asked());
        sum.dropped += region.dropped;
        sum.least = std::min(sum.least, region.taken);
        sum.most = std::max(sum.most, region.taken);
    }
    if (sum.pixels == 0) sum.least = 0;
    return sum;
}

void Ledger::take(const Task& task, Film& patch) const {
    if (task.pattern.first == 0) {
        patch.clear(task.tile.width(), task.tile.height());
    } else {
        film_.cut(task.tile, patch);
    }
}

void Ledger::put(const Task& task, const Film& patch, std::uint64_t dropped) {
    const std::shared_lock lock(mutex_);
    film_.paste(task.tile, patch);
    FilmRegion& region = state_.regions[task.region];
    region.taken += task.pattern.samples();
    region.visits = 0;
    region.dropped += dropped;
}

void Ledger::go_back() {
    std::tie(film_, state_) = std::move(*marked_);
    unmark();
}

void Ledger::write(const FilmSubject& subject, const FilmSink& sink) const {
    const Tiling tiling = state_.tiling(film_.width(), film_.height());
    write_film(
        subject, film_, state_,
        [&](std::size_t i, Film& patch) {
            const std::unique_lock lock(mutex_);
            if (state_.regions[i].taken > 0) film_.cut(tiling[i], patch);
            return state_.regions[i];
        },
        sink);
}

}  // namespace orrery
