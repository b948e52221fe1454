// Whether two scenes are the same, part by part: as far as an image depends on it, however the files spell it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace orrery {

/// (part, digits that stand for it) of the camera, the spheres with their materials and light, the point lights and the
/// background; neither names and ids nor settings. Different scenes have the same digits with probability 2^-64.
std::vector<std::pair<std::string, std::string>> fingerprints(const Scene& scene);

}  // namespace orrery
