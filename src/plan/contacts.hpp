// Where two spheres all but touch, and what a number type makes of it.
//
// Rounding moves a sphere's surface by
//     e = u max(radius, |x|, |y|, |z|),
// u half an ulp of 1. Two surfaces that meet at a small angle are then uncertain over a large area: spheres of radii a
// and b, centres d apart, cut each other along a circle, and a radius larger by e moves that circle over
//     U = 2 pi e a b / d
// of either sphere. (The cap of a within b has the height (b^2 - (d - a)^2) / 2d, whose slope in b is b/d, and the area
// 2 pi a times that.) This holds for a sphere that pokes through a wall, from within or from outside, for one that
// rests on it, and for two that nearly coincide, where d is small and all of the sphere uncertain.
//
// It does harm in three ways. Of a lamp that shows only its cap, U of the light is wrong; measured, 0.2 to 1 times
// that. What is seen of a cap, a rim or a shell is wrong over U; between two transparent surfaces, where paths go to
// and fro, over up to 16 U. And from the side where two spheres curve away from each other, as a ball from the floor it
// lies on, the place is a crevice that hardly shows, 2 sqrt(2 g a b / d) wide where it is g high: there the picture may
// hang on the light that falls through.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.hpp"

namespace orrery {

/// What is uncertain by more than a five hundredth of all the light, or of the picture; in words, the worst of it.
/// Looks at the lamps that give most light and the spheres that look largest, against all others.
std::optional<std::string> uncertain_contact(const Scene& scene, Precision precision);

}  // namespace orrery
