// What a film is of: so that a render goes on with its own film only, and a film becomes an image without its scene.
#pragma once

#include <string>
#include <vector>

#include "cli/reports.hpp"
#include "film/film_file.hpp"
#include "kernels/isa.hpp"

namespace orrery {

/// All that decides a render's bytes, and what its images carry.
FilmSubject film_subject(const Plan& plan, const Goal& goal, Isa isa, double exposure);

/// Why a film of `found` is none of `asked`, in words; empty where it is one, be it with other samples, another goal or
/// another tone mapper.
std::vector<std::string> differences(const FilmSubject& found, const FilmSubject& asked);

/// The same for parts of one image, which have all of it in common.
std::vector<std::string> differences_of_shards(const FilmSubject& found, const FilmSubject& first);

/// What made the images of such a film; but for the samples, which the film knows. Throws std::runtime_error where the
/// subject does not say enough.
Making making_of(const FilmSubject& subject);

}  // namespace orrery
