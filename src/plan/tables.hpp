// What the kernels read of a scene, in float or in double, and the columns that own it.
#pragma once

#include <array>
#include <vector>

#include "kernels/tables.hpp"
#include "plan/caustics.hpp"
#include "plan/guide.hpp"
#include "plan/light_choice.hpp"
#include "plan/sphere_choice.hpp"
#include "plan/tree.hpp"
#include "plan/unit.hpp"
#include "scene/scene.hpp"

namespace orrery {

/// The camera as the scene has it, in double, and how its image is divided.
struct CameraFrame {
    glm::dvec3 right, up, ahead;             ///< orthonormal
    double half_width = 0, half_height = 0;  ///< of the image plane at distance 1
    double cell_width = 0, cell_height = 0;  ///< of a pixel's cell there
};

/// The tables stay valid for the life of this, moves included. Every number of the scene is rounded to Real once;
/// lengths are in the plan's unit, and intensities of point lights in its square.
template <class Real>
class Tables {
public:
    /// Sphere k of the table is primitive order[k]; `tree` is over them in that order, empty for a linear table.
    Tables(const Scene& scene, const CameraFrame& frame, const LengthUnit& unit,
           const std::vector<std::uint32_t>& order, Tree tree);
    Tables(const Tables&) = delete;
    Tables& operator=(const Tables&) = delete;

    /// Lets vertices choose one of lights(area), by the scene's light choice. With area lights, rays that run into one
    /// learn how probable its choice is.
    void choose_lights(const Scene& scene, bool area);
    /// All lights, for vertices that sample area lights as well as point lights; or point lights alone.
    const kernels::LightTable<Real>& lights(bool area) const { return lights_[area ? 1 : 0]; }

    /// Lets vertices sample these; `order` as the constructor had it.
    void sample_caustics(const Scene& scene, const LengthUnit& unit, const std::vector<std::uint32_t>& order,
                         const std::vector<PlannedCaustic>& planned);

    /// Lets vertices look for point lights over the primitives `balls`; to be called behind sample_caustics.
    void look_over(const Scene& scene, const std::vector<std::uint32_t>& order,
                   const std::vector<std::uint32_t>& balls);
    /// Lets bounces be guided to these; `order` as above.
    void guide_to(const Scene& scene, const LengthUnit& unit, const std::vector<std::uint32_t>& order,
                  const std::vector<PlannedSpot>& spots);

    kernels::CausticTable<Real> caustics;
    kernels::GuideTable<Real> guide;
    kernels::CameraTable<Real> camera{};
    kernels::SphereTable<Real> spheres;
    kernels::MaterialTable<Real> materials;
    kernels::Background<Real> background;
    /// For DEPTH, whose distances are the scene's: how long a unit is, and the enclosing volume's distance, larger than
    /// any hit's.
    Real unit = 1;
    Real enclosing_distance = 1;

private:
    using Word = kernels::WordOf<Real>;

    void put_camera(const Scene& scene, const CameraFrame& frame, const LengthUnit& unit);
    void put_materials(const Scene& scene);
    /// Both go by the scene's order of primitives; put_spheres tells the lights where their spheres stand.
    std::vector<std::uint32_t> put_lights(const Scene& scene, const LengthUnit& unit);
    void put_spheres(const Scene& scene, const LengthUnit& unit, const std::vector<std::uint32_t>& order,
                     const std::vector<std::uint32_t>& light_of);

    std::vector<kernels::TreeNode<Real>> nodes_;
    std::array<std::vector<Real>, 6> sphere_columns_;    // cx cy cz radius, its square and inverse
    std::array<std::vector<Word>, 2> sphere_words_;      // surface light
    std::array<std::vector<Real>, 8> material_columns_;  // rho, tau, eta, roughness
    std::array<std::vector<Real>, 7> light_columns_;     // position radius colour
    std::array<std::vector<Word>, 1> light_words_;       // sphere
    std::vector<kernels::Caustic<Real>> caustics_;
    std::vector<kernels::CausticGroup<Real>> caustic_groups_;
    SphereChoice<Real> sphere_choice_;
    SpotColumns<Real> spots_;
    std::array<ChoiceColumns<Real>, 2> choices_;       // without area lights, with them
    std::array<kernels::LightTable<Real>, 2> lights_;  // the same
};

extern template class Tables<float>;
extern template class Tables<double>;

/// How a surface of this material scatters under an integrator.
kernels::Scattering scattering_of(const Material& material, Integrator integrator);
/// A light that is switched off is none.
bool shines(const glm::dvec3& light);
bool emits(const Primitive& primitive);

}  // namespace orrery
