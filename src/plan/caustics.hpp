// Which caustics are sampled on purpose: light of an area light over one smooth or glossy sphere, for path tracing. And
// which spheres point lights are looked for in.
#pragma once

#include <vector>

#include "kernels/tables.hpp"
#include "scene/scene.hpp"

namespace orrery {

/// One way of light, by the scene's primitives.
struct PlannedCaustic {
    std::uint32_t ball, lamp;  ///< primitives
    std::uint32_t chords;
    bool obstructed;
    double roughness;  ///< of a glossy ball; 0: smooth
    double share;      ///< of the samples over the ball
    double rate;       ///< of these
};

/// Those worth their time, ball by ball, the strongest first. Decided by the scene's geometry, powers and camera alone.
/// A lamp that touches, holds or lies within a ball has none with it. `over_glossy`: over glossy spheres too.
std::vector<PlannedCaustic> plan_caustics(const Scene& scene, bool over_glossy);

/// Radius of a lamp at `distance` from a glossy ball's centre, made larger by the width of the lobe.
double blurred_radius(double distance, double radius, double roughness);

/// Primitives that are mirrors, or dielectrics without roughness.
std::vector<std::uint32_t> smooth_spheres(const Scene& scene);

/// Whether some surface may cut the chords within one of `balls`, smooth spheres of the scene. Errs on the side of yes,
/// where there are too many pairs to look at.
bool any_obstructed(const Scene& scene, const std::vector<std::uint32_t>& balls);

/// What an event at a vertex that samples them leaves of a path's throughput, about; in (0, 1].
double carried_on(const Scene& scene);

/// `caustic`'s steps: its turn at a number of impact parameters, by the ball's material.
template <class Real>
void put_steps(kernels::Caustic<Real>& caustic, double radius, const Material& ball);

}  // namespace orrery
