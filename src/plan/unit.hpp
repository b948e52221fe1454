// In which unit of length a scene is computed, so that every scale is as good as any other.
//
// Kernels compare the closest hits of two spheres by products of three lengths and weigh lights by inverse squares; at
// the scale of the solar system in metres the first leave float's range, and at that of a virus they vanish. So the
// plan counts lengths in a unit of its own. It is a power of two: nothing is rounded, and a scene with all its lengths
// times a power of two becomes the very same tables.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.hpp"

namespace orrery {

struct LengthUnit {
    double length = 1;                 ///< of it, in the scene's
    double smallest = 0, largest = 0;  ///< lengths of the scene: the least radius, the farthest coordinate

    double in_units(double of_scene) const { return of_scene * (1 / length); }
    /// W/sr of a point light, for which irradiance is what it was.
    double intensity(double of_scene) const { return in_units(in_units(of_scene)); }
};

/// The unit lies in the middle, on a scale of powers, between the smallest and the largest length there is.
LengthUnit length_unit(const Scene& scene);

/// Why the exponents of a float cannot hold this scene in its unit; nothing where they can.
///
/// Lengths then lie within 2^-30 to 2^30: three of them times what rounding leaves of a difference (2^-24) stay above
/// the least normal number, 2^-126, and so does the square of a sphere's radius over its distance. In double that holds
/// for 2^-300 to 2^300, more than a file may hold.
std::optional<std::string> out_of_float_range(const Scene& scene, const LengthUnit& unit);

}  // namespace orrery
