// Scene -> Plan: flat arrays for the kernels, and the list of what this scene needs. What is not needed is not run.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "kernels/tables.hpp"
#include "plan/tree.hpp"
#include "scene/scene.hpp"

namespace orrery {

/// What a scene requires of the pipeline. Everything else stays out: its kernels are not called, its queue fields not
/// allocated.
struct Needs {
    Integrator integrator = Integrator::path_tracing;
    bool tree = false;                ///< many spheres: rays go through a tree
    bool lens = false;                ///< sample the aperture
    std::uint32_t scattering = 0;     ///< bit k: some surface scatters as kernels::Scattering k
    bool sort = false;                ///< more than one kind: hits are sorted by it
    bool emitters = false;            ///< rays can run into an emitter
    bool background = false;          ///< rays that miss carry light
    std::uint32_t connect_point = 0;  ///< kinds whose vertices sample point lights
    std::uint32_t connect_area = 0;   ///< kinds whose vertices sample area lights
    bool competing = false;           ///< light samples and scattering share the work (mis)
    bool scattering_pdf = false;      ///< rays carry the density that made them
    bool eta_scale = false;           ///< rays carry the radiance scaling roulette must not see
    bool lobes = false;               ///< glossy vertices keep their lobe for the light samples
    bool roulette = false;
    bool branches = false;  ///< Whitted with dielectrics: both branches, one postponed

    bool scatters(kernels::Scattering kind) const { return (scattering >> static_cast<unsigned>(kind) & 1u) != 0; }
};

/// One line of `orrery info`: a part of the pipeline, whether it runs, and why.
struct Decision {
    std::string part;
    bool runs = false;
    std::string reason;
};

/// Columns that own what the kernels' tables point to. The tables stay valid for the plan's life; plans do not copy.
class Plan {
public:
    /// Throws std::invalid_argument where a scene built by hand breaks what the reader guarantees.
    explicit Plan(Scene scene);
    Plan(const Plan&) = delete;
    Plan& operator=(const Plan&) = delete;

    const Scene& scene() const { return scene_; }
    const RenderSettings& settings() const { return scene_.settings; }
    const Needs& needs() const { return needs_; }
    std::vector<Decision> decisions() const;

    const kernels::CameraTable<float>& camera() const { return camera_; }
    const kernels::SphereTable<float>& spheres() const { return spheres_; }
    const kernels::MaterialTable<float>& materials() const { return materials_; }
    const kernels::EmissionTable<float>& emission() const { return emission_; }
    const std::vector<kernels::PointLight<float>>& point_lights() const { return point_lights_; }
    const std::vector<kernels::AreaLight<float>>& area_lights() const { return area_lights_; }

    /// Samples per pixel really taken: e * e with e = strata() when stratified.
    std::uint32_t samples() const;
    /// Cells per pixel side: floor(sqrt(samples)) when stratified, 1 when uniform.
    std::uint32_t strata() const { return strata_; }
    /// Half the image plane at distance 1: x in [-half_width, half_width], y likewise.
    double half_width() const { return half_width_; }
    double half_height() const { return half_height_; }
    /// The enclosing volume's distance for DEPTH: larger than any hit distance in the scene.
    float enclosing_distance() const { return enclosing_distance_; }

private:
    void plan_camera();
    std::vector<std::uint32_t> plan_tree();
    void plan_surfaces(const std::vector<std::uint32_t>& order);
    void plan_lights();
    void plan_needs();

    Scene scene_;
    Needs needs_;
    std::uint32_t strata_ = 1;
    double half_width_ = 0, half_height_ = 0;
    float enclosing_distance_ = 1;
    kernels::CameraTable<float> camera_{};
    kernels::SphereTable<float> spheres_;
    kernels::MaterialTable<float> materials_;
    kernels::EmissionTable<float> emission_;
    std::vector<kernels::PointLight<float>> point_lights_;
    std::vector<kernels::AreaLight<float>> area_lights_;
    Tree tree_;
    std::array<std::vector<float>, 6> sphere_columns_;        // cx cy cz radius, its square and inverse
    std::array<std::vector<std::uint32_t>, 2> sphere_words_;  // surface light
    std::array<std::vector<float>, 8> material_columns_;      // rho, tau, eta, roughness
    std::array<std::vector<float>, 3> emission_columns_;
};

}  // namespace orrery
