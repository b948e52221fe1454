// The film to the image, and to what is known of the image's error.
#pragma once

#include "film/error.hpp"
#include "scene/scene.hpp"
#include "system/threads.hpp"
#include "wavefront/tile.hpp"

namespace orrery {

/// By whom, and whether still: all that look at every pixel throw what the cancellation throws. The same for any number
/// of threads.
struct Developing {
    Team& team;
    const Cancellation& cancellation;
};

/// The pixels' means; those of DEPTH post-processed.
Image develop(const Film& film, Integrator integrator, const Developing& how);

/// Standard error of every pixel of that image; infinite where nothing tells.
Image develop_error(const Film& film, Integrator integrator, const Developing& how);

/// Error of a part of that image, pixel after pixel; `errors` are its pixels' standard errors.
ErrorSums error_of_tile(const Film& film, Integrator integrator, const Image& image, const Image& errors,
                        const Tile& tile);

/// Error of all of it.
ImageError estimate_error(const Film& film, Integrator integrator, const Image& image, const Image& errors,
                          const Developing& how);

}  // namespace orrery
