// Which spots rays are guided to, and whether that is worth its time: for path tracing.
#pragma once

#include <array>
#include <vector>

#include "kernels/tables.hpp"
#include "plan/unit.hpp"
#include "scene/scene.hpp"

namespace orrery {

struct CameraFrame;

/// A diffuse ball as a lamp outside it lights it.
struct PlannedSpot {
    std::uint32_t ball = 0;  ///< primitive
    glm::dvec3 lamp{0};      ///< centre
    double gap = 0;          ///< of lamp's centre and ball, > 0
    double width = 0;        ///< of the spot, about
    double power = 0;        ///< what the ball sends on, as irradiance over pi at distance 1 before it, about
};

/// The brightest, no more than kernels::most_spots. Of point lights, area lights or both.
std::vector<PlannedSpot> plan_spots(const Scene& scene, bool points, bool areas);

/// In scenes of more spheres, or lights, bounces are not guided unless told to.
inline constexpr std::size_t most_spheres_for_spots = 4096;

/// What of the light that the camera's rays find on diffuse surfaces comes from spots, and from how far.
struct SpotLight {
    double share = 0;      ///< of sharp spots in what comes straight from lamps or over those, in [0, 1]
    double sharpness = 0;  ///< of sharp spots in what comes over all spots: cosine lobes seldom find sharp ones
};
/// Nothing in the way of it is looked for. Takes some hundred rays times spheres times lamps.
SpotLight light_of_spots(const Scene& scene, const CameraFrame& camera, const std::vector<PlannedSpot>& spots);
/// Whether guiding there costs less than it gains, as measured.
bool worth_guiding(const SpotLight& light);

/// Columns of a GuideTable.
template <class Real>
class SpotColumns {
public:
    SpotColumns() = default;
    /// Primitive i is sphere place[i] of the table.
    SpotColumns(const Scene& scene, const LengthUnit& unit, const std::vector<PlannedSpot>& spots,
                const std::vector<std::uint32_t>& place);
    /// Valid as long as this, moves included.
    kernels::GuideTable<Real> table() const;

private:
    std::vector<kernels::WordOf<Real>> ball_;
    std::array<std::vector<Real>, 18> columns_;
};

extern template class SpotColumns<float>;
extern template class SpotColumns<double>;

}  // namespace orrery
