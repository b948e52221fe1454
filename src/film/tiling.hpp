// The parts of an image: tiles, and the halves of tiles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace orrery {

/// All pixels of a tile, or every second as the fields of a chess board; black is the top left field of the image.
enum class Colour : std::uint8_t { all, black, white };

/// Pixels [x0, x1) by [y0, y1) of a colour.
struct Tile {
    std::uint32_t x0, y0, x1, y1;
    Colour colour = Colour::all;

    std::uint32_t width() const { return x1 - x0; }
    std::uint32_t height() const { return y1 - y0; }
    bool has(std::uint32_t x, std::uint32_t y) const {
        return colour == Colour::all || ((x + y) % 2 == 0) == (colour == Colour::black);
    }
    std::uint32_t pixels() const {
        const std::uint32_t all_pixels = width() * height();
        if (colour == Colour::all) return all_pixels;
        // Fields of the colour of the top left one are the half, rounded up.
        return has(x0, y0) ? (all_pixels + 1) / 2 : all_pixels / 2;
    }
};

/// work(of the image, of the tile) for the places of all pixels of a tile, row by row: in an image of that width, and
/// among the tile's own pixels, those of the other colour included.
template <class Work>
void each_pixel(const Tile& tile, std::uint32_t width, Work work) {
    std::size_t place = 0;
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y)
        for (std::uint32_t x = tile.x0; x < tile.x1; ++x, ++place)
            if (tile.has(x, y)) work(std::size_t{y} * width + x, place);
}

/// work(of the image, of the tile, count) for runs of such places side by side: as each_pixel, in larger steps.
template <class Work>
void each_run(const Tile& tile, std::uint32_t width, Work work) {
    if (tile.colour != Colour::all)
        return each_pixel(tile, width, [&](std::size_t of_image, std::size_t of_tile) { work(of_image, of_tile, 1u); });
    for (std::uint32_t y = tile.y0; y < tile.y1; ++y)
        work(std::size_t{y} * width + tile.x0, std::size_t{y - tile.y0} * tile.width(), tile.width());
}

/// Square tiles with a side of an even number of pixels, numbered row by row; as halves, the black one of a tile before
/// its white one. An image's last tile may be a single pixel, which has no white half.
class Tiling {
public:
    Tiling(std::uint32_t width, std::uint32_t height, std::uint32_t side, bool halves = false)
        : width_(width), height_(height), side_(side), halves_(halves) {}
    std::size_t size() const {
        const std::size_t tiles = std::size_t{across()} * ((height_ + side_ - 1) / side_);
        return halves_ ? 2 * tiles - (width_ % side_ == 1 && height_ % side_ == 1 ? 1 : 0) : tiles;
    }
    Tile operator[](std::size_t i) const {
        const std::size_t tile = halves_ ? i / 2 : i;
        const auto x = static_cast<std::uint32_t>(tile % across()) * side_;
        const auto y = static_cast<std::uint32_t>(tile / across()) * side_;
        const Colour colour = !halves_ ? Colour::all : i % 2 == 0 ? Colour::black : Colour::white;
        return {x, y, std::min(x + side_, width_), std::min(y + side_, height_), colour};
    }

private:
    std::uint32_t across() const { return (width_ + side_ - 1) / side_; }
    std::uint32_t width_, height_, side_;
    bool halves_;
};

}  // namespace orrery
