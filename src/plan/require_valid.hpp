#pragma once

#include "scene/scene.hpp"

namespace orrery {

/// Throws std::invalid_argument, naming the fault, where a scene built by hand breaks what the reader guarantees.
void require_valid(const Scene& scene);

}  // namespace orrery
