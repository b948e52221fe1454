#include "plan/plan.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "kernels/queues.hpp"
#include "plan/require_valid.hpp"

namespace orrery {

using kernels::Scattering;

namespace {

Scattering scattering_of(const Material& material, Integrator integrator) {
    switch (material.kind) {
        case MaterialKind::diffuse:
            return Scattering::diffuse;
        case MaterialKind::specular:
            return Scattering::specular;
        case MaterialKind::dielectric:
            return Scattering::dielectric;
        // Whitted follows the unperturbed direction (spec section 4).
        case MaterialKind::glossy:
            return integrator == Integrator::whitted ? Scattering::specular : Scattering::glossy;
        case MaterialKind::translucent:
            return integrator == Integrator::whitted ? Scattering::dielectric : Scattering::translucent;
    }
    throw std::invalid_argument("unknown material kind");
}

bool is_black(const glm::dvec3& light) { return light.r == 0 && light.g == 0 && light.b == 0; }

/// Kernels read whole vectors, and look up entry 0 for dead lanes.
template <class Columns>
void pad(Columns& columns) {
    for (auto& column : columns) column.resize(column.size() + kernels::widest);
}

constexpr std::uint32_t bit(Scattering kind) { return 1u << static_cast<unsigned>(kind); }

}  // namespace

Plan::Plan(Scene scene) : scene_(std::move(scene)) {
    const RenderSettings& s = scene_.settings;
    require_valid(scene_);
    if (s.estimator == Estimator::stratified) {
        strata_ = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(s.samples)));
    }
    plan_camera();
    plan_surfaces(plan_tree());
    plan_lights();
    plan_needs();
}

std::uint32_t Plan::samples() const {
    return settings().estimator == Estimator::stratified ? strata_ * strata_ : settings().samples;
}

void Plan::plan_camera() {
    const Camera& from = scene_.camera;
    // Left-handed: X = up x Z points right, Y = Z x X up (spec section 2).
    const glm::dvec3 z = glm::normalize(from.target - from.position);
    const bool along_up = z.x == 0 && z.z == 0;
    const glm::dvec3 x = glm::normalize(glm::cross(along_up ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0), z));
    const glm::dvec3 y = glm::cross(z, x);
    half_height_ = std::tan(from.fov * std::numbers::pi / 360);
    half_width_ = half_height_ * from.aspect;
    const auto f = [](double v) { return static_cast<float>(v); };
    camera_ = {f(from.position.x),
               f(from.position.y),
               f(from.position.z),
               f(x.x),
               f(x.y),
               f(x.z),
               f(y.x),
               f(y.y),
               f(y.z),
               f(z.x),
               f(z.y),
               f(z.z),
               f(2 * half_width_ / settings().width / strata_),
               f(-2 * half_height_ / settings().height / strata_),
               f(from.aperture / 2),
               f(from.focal_distance)};

    double reach = 0;
    for (const Primitive& p : scene_.primitives)
        reach = std::max(reach, glm::length(p.centre - from.position) + p.radius + from.aperture / 2);
    enclosing_distance_ = reach > 0 ? f(2 * reach) : 1.0f;
}

/// Few spheres keep their order; many take their tree's. Returns which primitive stands at each place.
std::vector<std::uint32_t> Plan::plan_tree() {
    std::vector<std::uint32_t> order(scene_.primitives.size());
    std::iota(order.begin(), order.end(), 0u);
    needs_.tree = order.size() >= tree_crossover;
    if (!needs_.tree) return order;
    std::vector<BuildSphere> spheres;
    spheres.reserve(order.size());
    for (const std::uint32_t i : order) {
        const Primitive& p = scene_.primitives[i];
        const glm::vec3 centre(p.centre);
        spheres.push_back({centre.x, centre.y, centre.z, static_cast<float>(p.radius), i});
    }
    tree_ = build_tree(spheres);
    std::ranges::transform(spheres, order.begin(), &BuildSphere::index);
    return order;
}

void Plan::plan_surfaces(const std::vector<std::uint32_t>& order) {
    const auto push3 = [](auto& columns, std::size_t first, const glm::dvec3& v) {
        for (int c = 0; c < 3; ++c) columns[first + static_cast<std::size_t>(c)].push_back(static_cast<float>(v[c]));
    };
    for (const Material& m : scene_.materials) {
        push3(material_columns_, 0, m.rho);
        push3(material_columns_, 3, m.rho_t);
        material_columns_[6].push_back(static_cast<float>(m.eta));
        material_columns_[7].push_back(static_cast<float>(m.roughness));
    }
    // Lights count in the scene's order: which one a random number draws does not hang on the tree.
    std::vector<std::uint32_t> light_of(scene_.primitives.size());
    const auto emits = [](const Primitive& p) { return p.emission && !is_black(*p.emission); };  // switched off: none
    for (std::size_t i = 0; i < light_of.size(); ++i) {
        const Primitive& p = scene_.primitives[i];
        if (!emits(p)) continue;
        light_of[i] = static_cast<std::uint32_t>(area_lights_.size());
        push3(emission_columns_, 0, *p.emission);
        const auto f = [](double v) { return static_cast<float>(v); };
        area_lights_.push_back({0, f(p.centre.x), f(p.centre.y), f(p.centre.z), f(p.radius), f(p.emission->r),
                                f(p.emission->g), f(p.emission->b)});
    }
    std::uint32_t index = 0;
    for (const std::uint32_t primitive : order) {
        const Primitive& p = scene_.primitives[primitive];
        push3(sphere_columns_, 0, p.centre);
        const auto radius = static_cast<float>(p.radius);
        sphere_columns_[3].push_back(radius);
        sphere_columns_[4].push_back(radius * radius);
        sphere_columns_[5].push_back(1 / radius);
        const Scattering kind = scattering_of(scene_.materials[p.material], settings().integrator);
        needs_.scattering |= bit(kind);
        std::uint32_t surface = p.material | static_cast<std::uint32_t>(kind) << kernels::surface_material_bits;
        if (emits(p)) {
            surface |= kernels::surface_emits;
            area_lights_[light_of[primitive]].sphere = index;
        }
        sphere_words_[0].push_back(surface);
        sphere_words_[1].push_back(light_of[primitive]);
        ++index;
    }
    pad(sphere_columns_);
    pad(sphere_words_);
    pad(material_columns_);
    spheres_ = {index,
                sphere_columns_[0].data(),
                sphere_columns_[1].data(),
                sphere_columns_[2].data(),
                sphere_columns_[3].data(),
                sphere_columns_[4].data(),
                sphere_columns_[5].data(),
                sphere_words_[0].data(),
                sphere_words_[1].data(),
                {static_cast<std::uint32_t>(tree_.nodes.size()), tree_.nodes.data(), tree_.extent}};
    materials_ = {static_cast<std::uint32_t>(scene_.materials.size()),
                  material_columns_[0].data(),
                  material_columns_[1].data(),
                  material_columns_[2].data(),
                  material_columns_[3].data(),
                  material_columns_[4].data(),
                  material_columns_[5].data(),
                  material_columns_[6].data(),
                  material_columns_[7].data()};
}

void Plan::plan_lights() {
    const auto f = [](double v) { return static_cast<float>(v); };
    for (const PointLight& light : scene_.point_lights) {
        if (is_black(light.intensity)) continue;
        point_lights_.push_back({f(light.position.x), f(light.position.y), f(light.position.z), f(light.intensity.r),
                                 f(light.intensity.g), f(light.intensity.b)});
    }
    const glm::dvec3& b = scene_.background;
    pad(emission_columns_);
    emission_ = {static_cast<std::uint32_t>(area_lights_.size()),
                 emission_columns_[0].data(),
                 emission_columns_[1].data(),
                 emission_columns_[2].data(),
                 f(b.r),
                 f(b.g),
                 f(b.b),
                 !is_black(b),
                 !area_lights_.empty()};
}

void Plan::plan_needs() {
    const RenderSettings& s = settings();
    const std::uint32_t rough =
        needs_.scattering & (bit(Scattering::diffuse) | bit(Scattering::glossy) | bit(Scattering::translucent));
    const std::uint32_t diffuse = needs_.scattering & bit(Scattering::diffuse);
    const std::uint32_t dielectric = needs_.scattering & (bit(Scattering::dielectric) | bit(Scattering::translucent));
    needs_.integrator = s.integrator;
    needs_.lens = scene_.camera.aperture > 0;
    if (s.integrator == Integrator::depth) {
        needs_.scattering = 0;
        return;
    }
    needs_.emitters = emission_.has_emitters;
    needs_.background = emission_.has_background;
    needs_.sort = std::has_single_bit(needs_.scattering) == false && needs_.scattering != 0;
    if (s.integrator == Integrator::whitted) {
        if (!point_lights_.empty()) needs_.connect_point = diffuse;
        if (!area_lights_.empty()) needs_.connect_area = diffuse;
        needs_.branches = dielectric != 0;
        return;
    }
    if (!point_lights_.empty()) needs_.connect_point = rough;
    if (!area_lights_.empty() && s.transport != Transport::naive) {
        needs_.competing = s.transport == Transport::mis;
        needs_.connect_area = needs_.competing ? rough : diffuse;
        needs_.scattering_pdf = needs_.connect_area != 0;
    }
    needs_.roulette = s.roulette && s.depth > 0;
    needs_.eta_scale = needs_.roulette && dielectric != 0;
    needs_.lobes = ((needs_.connect_point | needs_.connect_area) & ~diffuse) != 0;
}

}  // namespace orrery
