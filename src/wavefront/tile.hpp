// Tiles of pixels, and how a wave is filled with one and emptied onto the film.
#pragma once

#include <algorithm>

#include "wavefront/pattern.hpp"
#include "wavefront/wave.hpp"

namespace orrery {

/// All pixels of a tile, or every second as the fields of a chess board; black is the top left field of the image.
enum class Colour : std::uint8_t { all, black, white };

/// Pixels [x0, x1) by [y0, y1) of a colour.
struct Tile {
    std::uint32_t x0, y0, x1, y1;
    Colour colour = Colour::all;

    bool has(std::uint32_t x, std::uint32_t y) const {
        return colour == Colour::all || ((x + y) % 2 == 0) == (colour == Colour::black);
    }
    std::uint32_t pixels() const;
};

/// Square tiles, numbered row by row.
class Tiling {
public:
    Tiling(std::uint32_t width, std::uint32_t height, std::uint32_t side)
        : width_(width), height_(height), side_(side) {}
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

/// What a thread does at a time.
struct Task {
    Tile tile;
    Pattern pattern;

    std::uint64_t samples() const { return std::uint64_t{tile.pixels()} * pattern.samples(); }
};

/// Side of the tiles for so many samples per pixel: with few of them tiles are larger, so that one fills a wave.
inline std::uint32_t tile_side(std::uint32_t samples) { return samples >= 8 ? 16 : samples >= 2 ? 32 : 64; }

/// (pixel, sample) pairs of a wave: what was asked for, or with 0 what was measured to be best for the plan's queues.
std::uint32_t choose_wave_size(const Plan& plan, std::uint32_t asked);

/// The samples of a task onto the wave's film, a wave at a time. Throws what the wave's Cancellation throws; the film
/// then holds a part of them, and the wave is of no more use.
template <class Real>
void render_tile(Wave<Real>& wave, const Task& task);

}  // namespace orrery
