// The composition: which camera, lights and primitives make the image.
#pragma once

#include "scene/entries.hpp"

namespace orrery {

/// Resolves `camera`, `lights`, `primitives` and `background` of the `scene` object into `scene`.
void read_composition(Fields& fields, const Registries& registries, Report& report, Scene& scene);

}  // namespace orrery
