// Films in files: read with suspicion, written whole or not at all.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "film/film_file.hpp"
#include "wavefront/ledger.hpp"
#include "wavefront/render.hpp"

namespace orrery {

/// A film file up to its pixels. Throws std::runtime_error naming the file, as all of these do.
FilmReader open_film(const std::filesystem::path& file);

/// The rest of it. `into` has its size, contrasting and tiling.
void read_film(const std::filesystem::path& file, FilmReader& reader, Ledger& into);

/// Room for what such a film holds; throws where that is more than the memory.
std::unique_ptr<Ledger> ledger_for(const std::filesystem::path& file, const FilmReader& reader);

/// One film, or all shards of one, together. `subject` is theirs. Throws UsageError where they do not belong together
/// or some are missing, and, unless `unfinished` is fine, where a part of what was asked is missing.
std::unique_ptr<Ledger> join_films(const std::vector<std::filesystem::path>& files, bool unfinished,
                                   FilmSubject& subject);

/// The film of an earlier run, to go on with. Throws UsageError, which says in words what does not fit.
std::unique_ptr<Ledger> resume_film(const std::filesystem::path& file, const Plan& plan, const Goal& goal, Shard shard,
                                    const FilmSubject& subject);

/// "x.film has what was rendered: orrery develop x.film -o IMAGE"
std::string develop_hint(const std::filesystem::path& film);

void save_film(const std::filesystem::path& file, const Ledger& ledger, const FilmSubject& subject);

/// Where no image could be written: saves the film beside `output`, or else in the folder for temporaries, and says how
/// to develop it.
void rescue_film(const std::filesystem::path& output, const Ledger& ledger, const FilmSubject& subject);

}  // namespace orrery
