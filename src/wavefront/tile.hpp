// How a wave is filled with a tile of pixels and emptied onto a film.
#pragma once

#include "film/tiling.hpp"
#include "wavefront/pattern.hpp"
#include "wavefront/wave.hpp"

namespace orrery {

/// What a thread does at a time.
struct Task {
    Tile tile;
    Pattern pattern;
    std::size_t region = 0;  ///< number of the tile

    std::uint64_t samples() const { return std::uint64_t{tile.pixels()} * pattern.samples(); }
};

/// Side of the tiles for so many samples per pixel: with few of them tiles are larger, so that one fills a wave.
inline std::uint32_t tile_side(std::uint32_t samples) { return samples >= 8 ? 16 : samples >= 2 ? 32 : 64; }

/// (pixel, sample) pairs of a wave: what was asked for, or with 0 what was measured to be best for the plan's queues.
std::uint32_t choose_wave_size(const Plan& plan, std::uint32_t asked);

/// Adds the samples of a task, whose tile is one of the settings' window, to the wave's film, which has the tile's
/// size, a wave at a time. Throws what the wave's Cancellation throws; the film then holds a part of them, and the wave
/// is of no more use.
template <class Real>
void render_tile(Wave<Real>& wave, const Task& task);

}  // namespace orrery
