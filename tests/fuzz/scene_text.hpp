// Scene -> the JSON that describes it, every number to its last bit.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace orrery::fuzz {

/// What cannot stand in a scene file (precision) is left out.
std::string scene_text(const Scene& scene);

}  // namespace orrery::fuzz
