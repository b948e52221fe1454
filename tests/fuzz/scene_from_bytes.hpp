// Byte string -> a scene that the program takes, so that a fuzzer's every input reaches a render.
#pragma once

#include "choices.hpp"
#include "scene/scene.hpp"

namespace orrery::fuzz {

struct DrawnScene {
    Scene scene;
    /// It holds numbers next to the ends of their ranges: products of them may leave a float's.
    bool extreme = false;
};

/// A tiny image of a few spheres, or of a hundred: all materials, lights, integrators and settings, sizes and places
/// over the whole range a scene file may hold, and what geometry's rounding errors feed on: copies, near copies,
/// tangent, nested and concentric spheres.
DrawnScene scene_from_bytes(Choices& choices);

/// Whether two of its spheres touch, coincide or nearly do: which of them a ray meets first may be left to rounding.
bool has_contact(const Scene& scene);

/// Whether a scene file may hold its numbers.
bool in_range(const Scene& scene);

}  // namespace orrery::fuzz
