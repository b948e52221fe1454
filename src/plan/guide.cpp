#include "plan/guide.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "kernels/guide.hpp"
#include "kernels/lobes.hpp"
#include "plan/tables.hpp"

namespace orrery {

namespace {

using Lanes = kernels::ScalarLanes<double>;
using kernels::Scattering;

/// A spot that a ball as near as this times its radius makes has no digits.
constexpr double nearest = 1e-4;
/// A float holds the inverse of no narrower cone.
constexpr double narrowest = 1e-30;
/// Lamps whose spots are looked at, the brightest.
constexpr std::size_t most_lamps = 64;
/// Camera rays that are looked at: so many squared. Mirrors turn them so often.
constexpr int rays_a_side = 16, most_turns = 4;

double brightest(const glm::dvec3& colour) { return std::max({colour.r, colour.g, colour.b}); }
kernels::Vec3<double> as_vec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Scattering scattering(const Scene& scene, const Primitive& p) {
    return scattering_of(scene.materials[p.material], Integrator::path_tracing);
}

double brightness(const PlannedSpot& s) { return s.power / (s.width * s.width); }

/// A point or a sphere, and its radiant intensity over pi.
struct Lamp {
    glm::dvec3 centre;
    double intensity = 0;
    const Primitive* sphere = nullptr;
};

std::vector<Lamp> lamps_of(const Scene& scene, bool points, bool areas) {
    std::vector<Lamp> lamps;
    if (points)
        for (const PointLight& p : scene.point_lights)
            lamps.push_back({p.position, brightest(p.intensity) / std::numbers::pi});
    if (areas)
        for (const Primitive& p : scene.primitives)
            if (emits(p)) lamps.push_back({p.centre, brightest(*p.emission) * p.radius * p.radius, &p});
    return lamps;
}

/// 1 - cos of the half angle that a ball subtends.
double cone_of(double radius, double gap) {
    const double sine = radius / (radius + gap);
    return kernels::one_minus_cosine(sine * sine, std::sqrt((1 - sine) * (1 + sine)));
}

}  // namespace

std::vector<PlannedSpot> plan_spots(const Scene& scene, bool points, bool areas) {
    std::vector<Lamp> lamps = lamps_of(scene, points, areas);
    std::ranges::stable_sort(lamps, std::ranges::greater{}, &Lamp::intensity);
    if (lamps.size() > most_lamps) lamps.resize(most_lamps);
    std::vector<PlannedSpot> spots;
    const auto brighter = [&](const PlannedSpot& a, const PlannedSpot& b) { return brightness(a) > brightness(b); };
    for (std::uint32_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& ball = scene.primitives[i];
        if (scattering(scene, ball) != Scattering::diffuse) continue;
        const double rho = brightest(scene.materials[ball.material].rho);
        for (const Lamp& lamp : lamps) {
            const double gap = glm::length(lamp.centre - ball.centre) - ball.radius;
            if (lamp.sphere == &ball || !(gap > nearest * ball.radius)) continue;
            const double cone = cone_of(ball.radius, gap);
            if (cone < narrowest) continue;
            const double power = lamp.intensity * rho * cone;
            const PlannedSpot spot{i, lamp.centre, gap, std::min(gap, ball.radius), 2 * power};
            if (!(power > 0) || (spots.size() == kernels::most_spots && !brighter(spot, spots.back()))) continue;
            // Behind those as bright.
            spots.insert(std::ranges::upper_bound(spots, spot, brighter), spot);
            if (spots.size() > kernels::most_spots) spots.pop_back();
        }
    }
    return spots;
}

namespace {

/// What the camera sees of a scene without its glass, as far as guiding asks.
struct Seen {
    std::uint32_t sphere = 0;
    kernels::Vec3<double> position, normal;
};

/// The diffuse point that a ray meets, directly or by way of mirrors.
std::optional<Seen> diffuse_hit(const Scene& scene, kernels::Vec3<double> origin, kernels::Vec3<double> direction) {
    std::optional<std::uint32_t> departed;
    bool inward = false;
    for (int turn = 0; turn <= most_turns; ++turn) {
        double nearest_hit = std::numeric_limits<double>::infinity();
        std::optional<std::uint32_t> met;
        for (std::uint32_t i = 0; i < scene.primitives.size(); ++i) {
            const Primitive& p = scene.primitives[i];
            if (kernels::traits_of(scattering(scene, p)).is_interface) continue;
            const kernels::Sphere<double> sphere{as_vec3(p.centre), p.radius, p.radius * p.radius};
            double t = std::numeric_limits<double>::infinity();
            if (departed == i) {
                if (inward) t = kernels::inner_far_root(origin, direction, sphere);
            } else if (const auto line = kernels::chord(origin, direction, sphere); line.disc > 0) {
                const auto root = kernels::first_root<Lanes>(line, std::sqrt(line.disc), kernels::FromOrigin{}, true);
                if (root.exists) t = root.num / root.den;
            }
            if (t < nearest_hit) nearest_hit = t, met = i;
        }
        if (!met) return std::nullopt;
        const Primitive& p = scene.primitives[*met];
        const auto outward = kernels::unit(kernels::along(origin, nearest_hit, direction) - as_vec3(p.centre));
        inward = kernels::dot(outward, direction) > 0;
        const auto normal = inward ? outward * -1.0 : outward;
        origin = kernels::along(as_vec3(p.centre), p.radius, outward);
        if (scattering(scene, p) == Scattering::diffuse) return Seen{*met, origin, normal};
        direction = kernels::unit(kernels::reflected(direction, normal, -kernels::dot(normal, direction)));
        departed = *met;
    }
    return std::nullopt;
}

/// Irradiance over pi that comes straight from the lamps.
double direct_light(const std::vector<Lamp>& lamps, const Seen& at) {
    double sum = 0;
    for (const Lamp& lamp : lamps) {
        const auto to = as_vec3(lamp.centre) - at.position;
        const double distance2 = kernels::dot(to, to), facing = kernels::dot(to, at.normal);
        if (facing > 0) sum += lamp.intensity * facing / (distance2 * std::sqrt(distance2));
    }
    return sum;
}

}  // namespace

SpotLight light_of_spots(const Scene& scene, const CameraFrame& camera, const std::vector<PlannedSpot>& spots) {
    if (spots.empty()) return {};
    std::vector<std::uint32_t> place(scene.primitives.size());
    std::iota(place.begin(), place.end(), 0u);
    const SpotColumns<double> columns(scene, {}, spots, place);
    const auto table = columns.table();
    const std::vector<Lamp> lamps = lamps_of(scene, true, true);
    double direct = 0, sharp = 0, all = 0;
    for (int ray = 0; ray < rays_a_side * rays_a_side; ++ray) {
        const auto middle = [](int cell) { return (2 * cell + 1.0) / rays_a_side - 1; };
        const glm::dvec3 ahead = camera.ahead + middle(ray % rays_a_side) * camera.half_width * camera.right +
                                 middle(ray / rays_a_side) * camera.half_height * camera.up;
        const auto seen = diffuse_hit(scene, as_vec3(scene.camera.position), as_vec3(glm::normalize(ahead)));
        if (!seen) continue;
        const auto weights = kernels::spot_weights<Lanes>(table, seen->position, seen->normal, seen->sphere);
        sharp += brightness(spots.front()) * weights.sum;
        all += brightness(spots.front()) * weights.light;
        direct += direct_light(lamps, *seen);
    }
    return all > 0 ? SpotLight{sharp / (sharp + direct), sharp / all} : SpotLight{};
}

bool worth_guiding(const SpotLight& light) { return light.share >= 0.1 && light.sharpness >= 0.24; }

template <class Real>
SpotColumns<Real>::SpotColumns(const Scene& scene, const LengthUnit& unit, const std::vector<PlannedSpot>& spots,
                               const std::vector<std::uint32_t>& place) {
    const double brightest_spot = spots.empty() ? 1 : brightness(spots.front());
    for (const PlannedSpot& s : spots) {
        const Primitive& ball = scene.primitives[s.ball];
        const glm::dvec3 towards = glm::normalize(s.lamp - ball.centre);
        const double cone = cone_of(ball.radius, s.gap), sine = ball.radius / (ball.radius + s.gap);
        const glm::dvec3 nearest_point = ball.centre + ball.radius * towards;
        const double row[] = {unit.in_units(ball.centre.x),
                              unit.in_units(ball.centre.y),
                              unit.in_units(ball.centre.z),
                              unit.in_units(ball.radius),
                              unit.in_units(nearest_point.x),
                              unit.in_units(nearest_point.y),
                              unit.in_units(nearest_point.z),
                              towards.x,
                              towards.y,
                              towards.z,
                              unit.in_units(s.gap),
                              cone,
                              brightness(s) / brightest_spot,
                              1 / unit.in_units(s.width),
                              1 / unit.in_units(ball.radius),
                              sine,
                              s.gap / (ball.radius + s.gap),
                              sine * sine / (2 * std::numbers::pi * cone)};
        static_assert(std::size(row) == std::tuple_size_v<decltype(columns_)>);
        ball_.push_back(place[s.ball]);
        for (std::size_t c = 0; c < std::size(row); ++c) columns_[c].push_back(static_cast<Real>(row[c]));
    }
    ball_.resize(ball_.size() + kernels::widest);
    for (auto& column : columns_) column.resize(column.size() + kernels::widest);
}

template <class Real>
kernels::GuideTable<Real> SpotColumns<Real>::table() const {
    const auto c = [&](std::size_t column) { return columns_[column].data(); };
    return {ball_.empty() ? 0 : static_cast<std::uint32_t>(ball_.size() - kernels::widest),
            ball_.data(),
            c(0),
            c(1),
            c(2),
            c(3),
            c(4),
            c(5),
            c(6),
            c(7),
            c(8),
            c(9),
            c(10),
            c(11),
            c(12),
            c(13),
            c(14),
            c(15),
            c(16),
            c(17)};
}

template class SpotColumns<float>;
template class SpotColumns<double>;

}  // namespace orrery
