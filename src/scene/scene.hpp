// What the user wrote, resolved: plain structs, double precision, indices instead of ids.
//
// Only what the composition references is here; registry entries nobody uses are dropped by the reader.
// Lengths are in scene units (the program has none of its own), angles in degrees as in the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "image/tonemap.hpp"

namespace orrery {

struct Camera {
    glm::dvec3 position{0};
    glm::dvec3 target{0, 0, 1};
    double fov = 45;    ///< full vertical angle in degrees, 0 < fov < 180
    double aspect = 1;  ///< image-plane width / height, > 0; need not equal the image's
    /// Aperture diameter, >= 0; 0 is a pinhole.
    double aperture = 0;
    /// Distance from `position` along the view axis to the plane in focus, > 0. Meaningless when aperture is 0.
    double focal_distance = 1;
};

/// In the order of kernels::Scattering, which has one way of scattering for each.
enum class MaterialKind : std::uint8_t { diffuse, specular, glossy, dielectric, translucent };

struct Material {
    std::string id;
    MaterialKind kind = MaterialKind::diffuse;
    glm::dvec3 rho{0};     ///< reflectance per channel in [0, 1]; rhoR of a dielectric
    glm::dvec3 rho_t{0};   ///< transmittance per channel in [0, 1]; dielectric and translucent only
    double eta = 1;        ///< index of refraction, inside over outside, > 0; dielectric and translucent only
    double roughness = 0;  ///< beta, 0 <= beta < 1; > 0 exactly for glossy and translucent
};

/// A primitive: one sphere with one material, and radiance of its own where it is emissive.
struct Primitive {
    std::string id;  ///< a label; may repeat
    glm::dvec3 centre{0};
    double radius = 1;                   ///< > 0
    std::uint32_t material = 0;          ///< index into Scene::materials
    std::optional<glm::dvec3> emission;  ///< emitted radiance, >= 0 and finite; an emissive primitive is an area light
};

struct PointLight {
    std::string id;
    glm::dvec3 position{0};
    glm::dvec3 intensity{0};  ///< W/sr per channel, >= 0 and finite
};

enum class Integrator : std::uint8_t { path_tracing, whitted, depth };
enum class Estimator : std::uint8_t { uniform, stratified, sobol };
enum class Transport : std::uint8_t { naive, nee, mis };
enum class LightSampling : std::uint8_t { area, cone, exact };
/// Which lights a vertex of a path samples: all of them, or one, all alike or in proportion to their powers.
enum class LightChoice : std::uint8_t { all, uniform, power };
/// The kernels' number type (IEEE 754); automatic: float where it is good enough for the scene.
enum class Precision : std::uint8_t { automatic, binary32, binary64 };
/// Whether bounces are guided to bright spots; automatic: where that pays.
enum class Guide : std::uint8_t { automatic, on, off };

/// Pixels [x0, x1) by [y0, y1) of an image.
struct Window {
    std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    std::uint32_t width() const { return x1 - x0; }
    std::uint32_t height() const { return y1 - y0; }
};

/// The `renderer` object: what to compute, and where the file says the image goes.
struct RenderSettings {
    Integrator integrator = Integrator::path_tracing;
    std::uint32_t width = 0;       ///< 1..65536
    std::uint32_t height = 0;      ///< 1..65536
    std::uint32_t samples = 1;     ///< per pixel, >= 1
    std::uint32_t depth = 0;       ///< greatest number of scattering events on a path; 0..20 for whitted
    std::filesystem::path output;  ///< already resolved against the scene file's folder; may be empty
    Estimator estimator = Estimator::sobol;
    Transport transport = Transport::mis;
    LightSampling light_sampling = LightSampling::exact;
    LightChoice light_choice = LightChoice::all;
    bool caustics = true;  ///< light over one smooth sphere is sampled
    Guide guide = Guide::automatic;
    bool roulette = true;
    /// So many scattering events of a path are never followed by roulette: played from the first on it costs more noise
    /// than it saves time (bench/TRADEOFF.md).
    std::uint32_t roulette_from = 8;
    /// Empty: the integrator's own (sigmoid for radiance; a DEPTH image is already in [0, 1] and is left alone).
    std::optional<ToneMap> tonemap;
    std::uint32_t seed = 0;
    Precision precision = Precision::automatic;
    std::optional<Window> crop;  ///< within the image; no scene file has one

    /// What is rendered of the image.
    Window window() const { return crop.value_or(Window{0, 0, width, height}); }
};

struct Scene {
    std::filesystem::path file;  ///< where it came from, for messages and metadata
    Camera camera;
    std::vector<Material> materials;
    std::vector<Primitive> primitives;  ///< in the file's order; one surface may be listed twice
    std::vector<PointLight> point_lights;
    glm::dvec3 background{0};  ///< radiance of the enclosing volume, >= 0 and finite
    RenderSettings settings;
};

}  // namespace orrery
