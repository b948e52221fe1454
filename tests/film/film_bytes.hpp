// Film files in memory, whole and spoilt.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "film/film_file.hpp"

namespace orrery::test {

using FilmBytes = std::vector<std::byte>;

/// In portions of at most so many bytes.
inline FilmSource source_of(const FilmBytes& bytes, std::size_t portion = ~std::size_t{0}) {
    return [rest = std::span(bytes), portion](std::span<std::byte> out) mutable {
        const std::size_t count = std::min({out.size(), rest.size(), portion});
        std::copy_n(rest.begin(), count, out.begin());
        rest = rest.subspan(count);
        return count;
    };
}

/// A film, and all else that its file holds.
struct WholeFilm {
    FilmSubject subject;
    FilmState state;
    Film film{0, 0};
};

inline FilmBytes bytes_of(const WholeFilm& whole) {
    FilmBytes bytes;
    const Tiling tiling = whole.state.tiling(whole.film.width(), whole.film.height());
    write_film(
        whole.subject, whole.film, whole.state,
        [&](std::size_t i, Film& patch) {
            whole.film.cut(tiling[i], patch);
            return whole.state.regions[i];
        },
        [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    return bytes;
}

/// Throws as FilmReader does, and std::length_error beyond so many pixels.
inline WholeFilm film_of(const FilmBytes& bytes, std::uint64_t most_pixels, std::size_t portion = ~std::size_t{0}) {
    FilmReader reader(source_of(bytes, portion));
    if (std::uint64_t{reader.width()} * reader.height() > most_pixels) throw std::length_error("too many pixels");
    WholeFilm whole{reader.subject(), reader.state(), Film(reader.width(), reader.height(), reader.contrasting())};
    whole.state.regions.resize(reader.tiling().size());
    reader.read(whole.film, whole.state.regions);
    return whole;
}

/// Makes the checksum of every section fit what is in it, as far as there are sections.
inline void repair_checksums(FilmBytes& bytes) {
    for (std::size_t at = 12; at + 12 <= bytes.size();) {
        std::uint64_t length = 0;
        std::memcpy(&length, bytes.data() + at + 4, 8);
        if (bytes.size() - at < 16 || length > bytes.size() - at - 16) return;
        const auto size = static_cast<std::size_t>(length) + 12;
        const auto sum =
            static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data() + at), size));
        std::memcpy(bytes.data() + at + size, &sum, 4);
        at += size + 4;
    }
}

}  // namespace orrery::test
