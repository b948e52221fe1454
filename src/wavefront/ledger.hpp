// The film of a render and what is asked of it, region by region: threads take regions and put them back, and what is
// there can be saved at any moment.
#pragma once

#include <optional>
#include <shared_mutex>
#include <utility>
#include <vector>

#include "film/film_file.hpp"
#include "wavefront/tile.hpp"

namespace orrery {

class Ledger {
public:
    /// `state` has as many regions as its tiling, or none: then nothing is on the film and nothing asked.
    Ledger(Film film, FilmState state);

    /// For whoever is alone with it.
    Film& film() { return film_; }
    const Film& film() const { return film_; }
    FilmState& state() { return state_; }
    const FilmState& state() const { return state_; }

    /// Of every region that something is asked of.
    std::vector<Task> tasks() const;

    /// What is there, over the shard's pixels.
    struct Samples {
        double taken = 0, asked = 0;
        std::uint64_t dropped = 0;
        std::uint64_t pixels = 0;
        std::uint32_t least = 0, most = 0;  ///< taken of any pixel

        double mean() const { return pixels > 0 ? taken / static_cast<double>(pixels) : 0; }
    };
    Samples samples() const;

    // By the thread that works on a region; others may work on other regions, and one may save.
    void take(const Task& task, Film& patch) const;
    /// What was asked of it is done.
    void put(const Task& task, const Film& patch, std::uint64_t dropped);

    /// Notes what is there, so that whatever is put after that can be dropped.
    void mark() { marked_.emplace(film_, state_); }
    void go_back();
    void unmark() { marked_.reset(); }

    /// A film file of what is there. While threads work, one may call this.
    void write(const FilmSubject& subject, const FilmSink& sink) const;

private:
    Film film_;
    FilmState state_;
    std::optional<std::pair<Film, FilmState>> marked_;
    mutable std::shared_mutex mutex_;  ///< shared by those who put, as their regions are different ones
};

}  // namespace orrery
