// The film to the image, and to what is known of the image's error.
#pragma once

#include "film/error.hpp"
#include "scene/scene.hpp"
#include "wavefront/tile.hpp"

namespace orrery {

/// The pixels' means; those of DEPTH post-processed.
Image develop(const Film& film, Integrator integrator);

/// Standard error of every pixel of that image; infinite where nothing tells. By the threads of the present arena.
Image develop_error(const Film& film, Integrator integrator);

/// Error of a part of that image, pixel after pixel; `errors` are its pixels' standard errors.
ErrorSums error_of_tile(const Film& film, Integrator integrator, const Image& image, const Image& errors,
                        const Tile& tile);

/// Error of all of it, by the threads of the present arena and the same for any number of them.
ImageError estimate_error(const Film& film, Integrator integrator, const Image& image, const Image& errors);

}  // namespace orrery
