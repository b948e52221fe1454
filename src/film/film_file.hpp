// The film file: a film, how far it is, and what it is of. All numbers are little-endian.
//
//     8 bytes   "orrery\x1a\n"
//     u32       version of this layout: 1
//     sections, each of
//         4 bytes   kind
//         u64       length of the content
//         content
//         u32       CRC-32 (that of zlib and PNG) of kind, length and content
//
// The kinds, in this order; a reader skips others, and bytes of "head" beyond those it knows, so that there is room for
// more. What an old reader must not skip takes another version.
//
//     "what"  u32 number of entries; of each key and value u32 length and bytes: what the render is of
//     "head"  u32 width, height; u8 1 for Contrasting::one, else 0; u8 1 where regions are halves of tiles, else 0;
//             u8 1 while passes are spread evenly, else 0; u8 1 where the render is finished, else 0; u32 side of
//             tiles, even, at most 64; u32 shard, of how many; u32 passes; f64 seconds, share of the work before the
//             present pass, share with it
//     "tile"  of every region of the shard, in order: u64 number; u32 taken, strata, visits, 0; u64 dropped;
//             f64 scatter (FilmRegion has the meanings); where taken > 0 its pixels, row by row
//     "end."  u64 number of "tile" sections
//
// A pixel is f64 sum r, g, b; u64 samples; f64 squares r, g, b; f32 skews r, g, b; u32 members, contrasts, steps
// (film.hpp has the meanings); for Contrasting::one also f64 difference r, g, b. Pixels of a region are stored byte by
// byte: the first byte of all pixels, the second of all, and so on; of each u8 0 and the byte where it is the same in
// all pixels, else u8 1 and a byte a pixel. So counts, zeros and the last digits of few samples take hardly any space.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "film/film.hpp"
#include "film/film_state.hpp"

namespace orrery {

/// What a film is of: (key, value) pairs, any bytes.
using FilmSubject = std::vector<std::pair<std::string, std::string>>;

/// Takes the next bytes of a file. What it throws passes through.
using FilmSink = std::function<void(std::span<const std::byte>)>;
/// Fills the bytes, or as many as are left; returns how many.
using FilmSource = std::function<std::size_t(std::span<std::byte>)>;

/// Gives a region and its pixels, on a film of its tile's size; they belong together.
using FilmRegions = std::function<FilmRegion(std::size_t region, Film& patch)>;

/// A film of that size and contrasting; `state.regions` counts for its size alone.
void write_film(const FilmSubject& subject, const Film& film, const FilmState& state, const FilmRegions& regions,
                const FilmSink& sink);

/// Reads a film file in two steps. Nothing in it is believed: a file that was cut, changed or made up gives
/// std::runtime_error with the reason, and takes no memory that its sizes do not justify.
class FilmReader {
public:
    /// Reads what stands before the pixels.
    explicit FilmReader(FilmSource source);

    const FilmSubject& subject() const { return subject_; }
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    Contrasting contrasting() const { return contrasting_; }
    /// Without its regions.
    const FilmState& state() const { return state_; }
    Tiling tiling() const { return state_.tiling(width_, height_); }

    /// Bytes that the whole file has at least, whatever is on the film: a shorter one is not worth the memory.
    std::uint64_t least_size() const;

    /// Reads the rest, once, onto a film of the same size and contrasting, and the shard's regions into `regions`, of
    /// which there are as many as tiles. On an exception both hold a part of it.
    void read(Film& film, std::vector<FilmRegion>& regions);

private:
    struct Section;
    Section next();
    Section expect(const char* kind);
    void take(std::span<std::byte> bytes);
    void read_head();
    FilmRegion read_region(const Section& section, std::size_t region, Film& film) const;

    FilmSource source_;
    FilmSubject subject_;
    std::uint32_t width_ = 0, height_ = 0;
    Contrasting contrasting_ = Contrasting::many;
    FilmState state_;
};

}  // namespace orrery
