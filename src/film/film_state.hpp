// How far a film is: what every part of the image has got, and what it is to get next.
#pragma once

#include <cstdint>
#include <vector>

#include "film/tiling.hpp"

namespace orrery {

/// Pixels that are sampled alike: those of a tile. Their samples have the numbers from 0 on.
struct FilmRegion {
    std::uint32_t taken = 0;  ///< samples per pixel that are on the film
    /// To be added at once: a grid of strata x strata cells, each visited so often.
    std::uint32_t strata = 1, visits = 0;
    std::uint64_t dropped = 0;  ///< samples, over its pixels, that were not finite
    double scatter = 0;         ///< in passes: what they know of its error

    std::uint64_t asked() const { return std::uint64_t{strata} * strata * visits; }
};

/// One of so many disjoint parts of an image, counted from 1: every `of`-th tile.
struct Shard {
    std::uint32_t number = 1, of = 1;

    bool has(std::size_t region) const { return region % of == number - 1; }
};

struct FilmState {
    std::uint32_t side = 16;  ///< of the tiles
    bool halves = false;      ///< a region is half a tile: the render goes in passes
    Shard shard = {};
    std::uint32_t passes = 0;                  ///< begun
    bool pilot = true;                         ///< the passes so far were spread evenly
    bool finished = false;                     ///< the render has reached its goal
    double seconds = 0;                        ///< of work, up to here
    double share_before = 0, share_after = 1;  ///< of all work, that is done before the present pass and with it
    std::vector<FilmRegion> regions = {};      ///< as tiling() numbers them

    Tiling tiling(std::uint32_t width, std::uint32_t height) const { return {width, height, side, halves}; }
};

}  // namespace orrery
