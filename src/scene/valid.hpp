// What a scene that no file describes has to keep as well.
#pragma once

#include "scene/scene.hpp"

namespace orrery {

/// Throws std::invalid_argument, naming the fault, where a number of the scene lies outside what a file may hold
/// (range.hpp, settings.hpp), or an index outside its list.
void require_valid(const Scene& scene);

}  // namespace orrery
