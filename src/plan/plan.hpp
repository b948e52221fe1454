// Scene -> Plan: flat arrays for the kernels, and the list of what this scene needs. What is not needed is not run.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "plan/coincident.hpp"
#include "plan/guide.hpp"
#include "plan/precision.hpp"
#include "plan/tables.hpp"
#include "plan/unit.hpp"
#include "scene/read.hpp"

namespace orrery {

/// What a scene requires of the pipeline. Everything else stays out: its kernels are not called, its queue fields not
/// allocated.
struct Needs {
    Integrator integrator = Integrator::path_tracing;
    bool tree = false;                ///< many spheres: rays go through a tree
    bool packets = false;             ///< of rays that run alike: spheres they cannot meet are left out for all of them
    bool lens = false;                ///< sample the aperture
    bool sobol = false;               ///< samples are those of Sobol's sequences, drawn ahead of the stages
    std::uint32_t scattering = 0;     ///< bit k: some surface scatters as kernels::Scattering k
    bool sort = false;                ///< more than one kind: hits are sorted by it
    bool emitters = false;            ///< rays can run into an emitter
    bool background = false;          ///< rays that miss carry light
    std::uint32_t connect_point = 0;  ///< kinds whose vertices sample point lights
    std::uint32_t connect_area = 0;   ///< kinds whose vertices sample area lights
    bool one_light = false;           ///< a vertex samples one light of several
    bool exact = false;               ///< diffuse vertices take area lights in closed form where there is one
    bool caustics = false;            ///< vertices sample light that comes over one smooth or glossy sphere
    bool glossy_caustics = false;     ///< over glossy ones
    bool point_caustics = false;      ///< vertices look for point lights over smooth spheres
    bool guide = false;               ///< bounces off diffuse surfaces are guided to spots
    bool competing = false;           ///< light samples and scattering share the work (mis)
    bool lights_only = false;         ///< what rays from vertices that sample area lights run into counts for nothing
    bool scattering_pdf = false;      ///< rays carry the density that made them
    bool roulette_scale = false;      ///< rays carry the part of their throughput that roulette must not see
    bool lobes = false;               ///< glossy vertices keep their lobe for the light samples
    bool roulette = false;
    bool branches = false;  ///< Whitted with dielectrics: both branches, one postponed

    bool scatters(kernels::Scattering kind) const { return (scattering & kernels::bit_of(kind)) != 0; }
};

/// One line of `orrery info`: a part of the pipeline, whether it runs, and why.
struct Decision {
    std::string part;
    bool runs = false;
    std::string reason;
};

/// Plans do not copy.
class Plan {
public:
    /// Makes it on so many threads, 0 being one per processor. Throws std::invalid_argument where a scene built by hand
    /// breaks what the reader guarantees.
    explicit Plan(Scene scene, unsigned threads = 0);
    Plan(const Plan&) = delete;
    Plan& operator=(const Plan&) = delete;

    /// Without what was listed twice.
    const Scene& scene() const { return scene_; }
    /// Their precision is never automatic: the plan has decided.
    const RenderSettings& settings() const { return scene_.settings; }
    const Needs& needs() const { return needs_; }
    std::vector<Decision> decisions() const;
    /// What a user should know of the scene before it is rendered.
    const std::vector<Diagnostic>& warnings() const { return warnings_; }

    /// In the settings' precision, float or double; the other one throws std::bad_variant_access.
    template <class Real = float>
    const Tables<Real>& tables() const {
        return std::get<Tables<Real>>(tables_);
    }

    /// Samples per pixel really taken: e * e with e = strata() when stratified; of sobol's two sequences as many each,
    /// so that an odd number is rounded down, but for 1.
    std::uint32_t samples() const;
    /// Cells per pixel side: floor(sqrt(samples)) when stratified, else 1.
    std::uint32_t strata() const { return strata_; }
    /// Half the image plane at distance 1: x in [-half_width, half_width], y likewise.
    double half_width() const { return frame_.half_width; }
    double half_height() const { return frame_.half_height; }
    /// A cell there of a pixel with strata x strata of them.
    double cell_width(std::uint32_t strata) const { return 2 * frame_.half_width / settings().width / strata; }
    double cell_height(std::uint32_t strata) const { return 2 * frame_.half_height / settings().height / strata; }
    /// In which the tables' lengths are.
    const LengthUnit& unit() const { return unit_; }

private:
    void plan_precision();
    void drop(const std::vector<Twins>& same);
    void plan_camera();
    void plan_tables(unsigned threads);
    void plan_needs();
    void plan_exact();
    void plan_guide();
    /// How many lights vertices aim at.
    std::size_t sampled_lights() const;

    Scene scene_;
    Needs needs_;
    std::uint32_t strata_ = 1;
    CameraFrame frame_;
    LengthUnit unit_;
    std::string precision_reason_;
    std::vector<Diagnostic> warnings_;
    std::size_t nodes_ = 0;                        ///< of the tree
    std::size_t emitters_ = 0, point_lights_ = 0;  ///< that are switched on
    std::vector<PlannedCaustic> caustics_;
    std::size_t smooth_ = 0;  ///< spheres, for path tracing
    std::vector<PlannedSpot> spots_;
    SpotLight spot_light_;
    std::variant<std::monostate, Tables<float>, Tables<double>> tables_;
};

}  // namespace orrery
