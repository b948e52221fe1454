// Where a number type is too coarse for a scene, said before anything is rendered.
//
// The bound. A vertex is found as centre + radius n, and the next ray starts there. n is a unit vector whose components
// near 1 are good to u = half an ulp of 1 (2^-24 in float, 2^-53 in double), so radius n is good to u radius; the
// centre is stored to u |centre|, and so is the sum where it does not cancel. What carries the larger number decides:
//     error = u max(radius, |x|, |y|, |z|).
// It is the size of the error, not its last factor: arithmetic on the way to n adds a few roundings of the same size,
// mostly along the surface.
//
// Where it matters. An error is seen where it is larger than what a pixel covers there (of wide pixels: than 1/128 of
// the distance), and does harm where it is not small against what is near: shadows of the smallest sphere, or the
// camera's own distance from the surface. Both must be, or a world of large spheres far away would be called too coarse
// for nothing.
#pragma once

#include <optional>
#include <string>

#include "plan/unit.hpp"
#include "scene/scene.hpp"

namespace orrery {

/// A sphere whose positions are too coarse.
struct CoarsePositions {
    std::string id;     ///< of the primitive
    double radius = 0;  ///< of it, scene units
    double error = 0;   ///< of positions on it, scene units
    double detail =
        0;  ///< what is near it: the smallest radius in the scene, or the camera's distance from its surface
};

/// The sphere whose positions are worst in proportion to that, where any are too coarse for the number type.
std::optional<CoarsePositions> coarse_positions(const Scene& scene, Precision precision);

/// `sphere "ground" of radius 1e+07: positions are good to 0.6 units in float, details are as small as 1`.
std::string in_words(const CoarsePositions& coarse, Precision precision);

/// Why the number type is too coarse for the scene, in words: for the range of its lengths or for positions. Nothing
/// where it will do.
std::optional<std::string> too_coarse(const Scene& scene, const LengthUnit& unit, Precision precision);

constexpr double unit_roundoff(Precision precision) { return precision == Precision::binary64 ? 0x1p-53 : 0x1p-24; }
constexpr const char* name_of(Precision precision) { return precision == Precision::binary64 ? "double" : "float"; }

}  // namespace orrery
