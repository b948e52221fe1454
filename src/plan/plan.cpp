#include "plan/plan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "scene/valid.hpp"

namespace orrery {

using kernels::Response;
using kernels::ScatteringTraits;

Plan::Plan(Scene scene, unsigned threads) : scene_(std::move(scene)) {
    RenderSettings& s = scene_.settings;
    require_valid(scene_);
    if (scene_.materials.size() > kernels::surface_material_mask)
        throw std::invalid_argument("more materials than a sphere's word can tell apart");
    if (s.estimator == Estimator::stratified) {
        strata_ = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(s.samples)));
    }
    plan_precision();
    plan_camera();
    plan_needs();
    plan_guide();
    plan_tables(threads);
    plan_exact();
}

std::uint32_t Plan::samples() const {
    const std::uint32_t asked = settings().samples;
    switch (settings().estimator) {
        case Estimator::uniform:
            return asked;
        case Estimator::stratified:
            return strata_ * strata_;
        case Estimator::sobol:
            return asked > 1 ? asked - asked % 2 : 1;
    }
    throw std::invalid_argument("unknown estimator");
}

std::size_t Plan::sampled_lights() const {
    return (needs_.connect_point != 0 ? point_lights_ : 0) + (needs_.connect_area != 0 ? emitters_ : 0);
}

void Plan::plan_camera() {
    const Camera& from = scene_.camera;
    // Left-handed: X = up x Z points right, Y = Z x X up (scenes/README.md).
    const glm::dvec3 z = glm::normalize(from.target - from.position);
    const bool along_up = z.x == 0 && z.z == 0;
    const glm::dvec3 x = glm::normalize(glm::cross(along_up ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0), z));
    const glm::dvec3 y = glm::cross(z, x);
    frame_ = {x, y, z};
    frame_.half_height = std::tan(from.fov * std::numbers::pi / 360);
    frame_.half_width = frame_.half_height * from.aspect;
    frame_.cell_width = cell_width(strata_);
    frame_.cell_height = cell_height(strata_);
}

/// Few spheres keep their order; many take their tree's.
void Plan::plan_tables(unsigned threads) {
    std::vector<std::uint32_t> order(scene_.primitives.size());
    std::iota(order.begin(), order.end(), 0u);
    needs_.tree = order.size() >= tree_crossover;
    needs_.packets = order.size() >= packet_crossover;
    Tree tree;
    if (needs_.tree) {
        std::vector<BuildSphere> spheres;
        spheres.reserve(order.size());
        for (const std::uint32_t i : order) {
            const Primitive& p = scene_.primitives[i];
            const auto f = [&](double length) { return static_cast<float>(unit_.in_units(length)); };
            spheres.push_back({f(p.centre.x), f(p.centre.y), f(p.centre.z), f(p.radius), i});
        }
        tree = build_tree(spheres, threads);
        std::ranges::transform(spheres, order.begin(), &BuildSphere::index);
    }
    nodes_ = tree.nodes.size();
    const auto fill = [&]<class Real>(Real) {
        auto& tables = tables_.emplace<Tables<Real>>(scene_, frame_, unit_, order, std::move(tree));
        if (needs_.caustics) tables.sample_caustics(scene_, unit_, order, caustics_);
        if (needs_.point_caustics) tables.look_over(scene_, order, smooth_spheres(scene_));
        if (needs_.guide) tables.guide_to(scene_, unit_, order, spots_);
        if (!needs_.one_light) return;
        if (needs_.connect_area != 0) tables.choose_lights(scene_, true);
        if ((needs_.connect_point & ~needs_.connect_area) != 0) tables.choose_lights(scene_, false);
    };
    settings().precision == Precision::binary64 ? fill(double{}) : fill(float{});
}

void Plan::plan_needs() {
    const RenderSettings& s = settings();
    for (const Primitive& p : scene_.primitives) {
        needs_.scattering |= kernels::bit_of(scattering_of(scene_.materials[p.material], s.integrator));
        if (emits(p)) ++emitters_;
    }
    for (const PointLight& light : scene_.point_lights)
        if (shines(light.intensity)) ++point_lights_;
    const auto present = [&](auto holds) { return needs_.scattering & kernels::scattering_where(holds); };
    const auto rough = present([](const ScatteringTraits& t) { return t.response != Response::none; });
    const auto diffuse = present([](const ScatteringTraits& t) { return t.response == Response::diffuse; });
    const auto dielectric = present([](const ScatteringTraits& t) { return t.is_interface; });
    needs_.integrator = s.integrator;
    needs_.lens = scene_.camera.aperture > 0;
    needs_.sobol = s.estimator == Estimator::sobol;
    if (s.integrator == Integrator::depth) {
        needs_.scattering = 0;
        return;
    }
    needs_.emitters = emitters_ > 0;
    needs_.background = shines(scene_.background);
    needs_.sort = std::popcount(needs_.scattering) > 1;
    if (s.integrator == Integrator::whitted) {
        if (point_lights_ > 0) needs_.connect_point = diffuse;
        if (emitters_ > 0) needs_.connect_area = diffuse;
        needs_.branches = dielectric != 0;
        return;
    }
    if (point_lights_ > 0) needs_.connect_point = rough;
    if (emitters_ > 0 && s.transport != Transport::naive) {
        needs_.competing = s.transport == Transport::mis;
        needs_.connect_area = needs_.competing ? rough : diffuse;
        needs_.scattering_pdf = needs_.connect_area != 0;
    }
    smooth_ = smooth_spheres(scene_).size();
    needs_.point_caustics = needs_.connect_point != 0 && s.caustics && s.depth > 1 && smooth_ > 0;
    needs_.one_light = s.light_choice != LightChoice::all && sampled_lights() > 1;
    if (needs_.competing && needs_.connect_area != 0 && s.caustics && s.depth > 1) {
        // Over glossy spheres only where the lobe's own directions are all that finds the lamp from there.
        caustics_ = plan_caustics(scene_, s.light_sampling == LightSampling::exact && !needs_.one_light);
        needs_.caustics = !caustics_.empty();
        needs_.glossy_caustics =
            std::ranges::any_of(caustics_, [](const PlannedCaustic& c) { return c.roughness > 0; });
    }
    needs_.roulette = s.roulette && s.depth > s.roulette_from;
    needs_.roulette_scale = needs_.roulette && dielectric != 0;
    needs_.lobes = ((needs_.connect_point | needs_.connect_area) & ~diffuse) != 0;
}

/// Only to spots of lamps that diffuse surfaces sample: elsewhere guided rays find nothing but by chance.
void Plan::plan_guide() {
    const auto& s = settings();
    const auto diffuse = kernels::bit_of(kernels::Scattering::diffuse);
    const bool points = (needs_.connect_point & diffuse) != 0, areas = (needs_.connect_area & diffuse) != 0;
    if (s.integrator != Integrator::path_tracing || s.guide == Guide::off || s.depth < 2 || !(points || areas)) return;
    if (s.guide == Guide::automatic && std::max(scene_.primitives.size(), point_lights_) > most_spheres_for_spots)
        return;
    spots_ = plan_spots(scene_, points, areas);
    if (s.guide == Guide::automatic) spot_light_ = light_of_spots(scene_, frame_, spots_);
    needs_.guide = !spots_.empty() && (s.guide == Guide::on || worth_guiding(spot_light_));
    needs_.roulette_scale = needs_.roulette_scale || (needs_.roulette && needs_.guide);
}

namespace {

/// Whether a ray may be scattered within an area light: because its surface or the camera's lens lets rays in, or
/// another surface does. Errs on the side of yes.
bool scatters_within_lights(const Scene& scene) {
    // What two spheres are apart by no more than rounding may be apart by less.
    constexpr double rounding = 1e-5;
    const Camera& camera = scene.camera;
    for (const Primitive& light : scene.primitives) {
        if (!emits(light)) continue;
        const auto kind = scattering_of(scene.materials[light.material], scene.settings.integrator);
        const double reach = (light.radius + camera.aperture) * (1 + rounding);
        if (kernels::traits_of(kind).is_interface || glm::length(camera.position - light.centre) <= reach) return true;
        for (const Primitive& other : scene.primitives) {
            if (&other == &light) continue;
            const double distance = glm::length(other.centre - light.centre);
            const double slack = rounding * (distance + other.radius + light.radius + glm::length(light.centre));
            const bool outside = distance - slack > other.radius + light.radius;
            const bool around = distance + light.radius + slack < other.radius;
            if (!outside && !around) return true;
        }
    }
    return false;
}

}  // namespace

void Plan::plan_exact() {
    const bool chosen = settings().light_sampling == LightSampling::exact;
    const auto diffuse =
        kernels::scattering_where([](const ScatteringTraits& t) { return t.response == Response::diffuse; });
    needs_.exact = chosen && (needs_.connect_area & diffuse) != 0 && !needs_.tree && !needs_.one_light;
    // Where spheres times lights are beyond any number, it is not worth the time to know.
    const auto apart = [&] {
        return emitters_ * scene_.primitives.size() < (1u << 22) && !scatters_within_lights(scene_);
    };
    needs_.lights_only = needs_.scattering_pdf && !needs_.background && (!needs_.competing || (chosen && apart()));
}

}  // namespace orrery
