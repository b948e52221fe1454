// Tiles of pixels, and how a wave is filled with one and emptied onto the film.
#pragma once

#include <algorithm>
#include <functional>

#include "wavefront/pattern.hpp"
#include "wavefront/wave.hpp"

namespace orrery {

/// Pixels [x0, x1) by [y0, y1).
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

/// (pixel, sample) pairs of a wave: what was asked for, or with 0 what was measured to be best for the plan's queues.
std::uint32_t choose_wave_size(const Plan& plan, std::uint32_t asked);

/// The samples of `pattern` of a tile's pixels onto the wave's film, a wave at a time. `interrupted` is polled between
/// waves and may be empty. Returns false when interrupted.
bool render_tile(Wave& wave, const Tile& tile, const Pattern& pattern, const std::function<bool()>& interrupted);

}  // namespace orrery
