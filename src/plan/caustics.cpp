#include "plan/caustics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "kernels/caustic_sample.hpp"
#include "plan/tables.hpp"

namespace orrery {

namespace {

using kernels::Scattering;

double brightest(const glm::dvec3& colour) { return std::max({colour.r, colour.g, colour.b}); }

Scattering scattering(const Scene& scene, const Primitive& p) {
    return scattering_of(scene.materials[p.material], Integrator::path_tracing);
}
bool smooth(const Scene& scene, const Primitive& p) {
    return kernels::traits_of(scattering(scene, p)).response == kernels::Response::none;
}

/// Lights, and balls, that are looked at: plans of many spheres take time in proportion to their number.
constexpr std::size_t most_lamps = 64, most_of_ball = 16;
/// Samples of a ball from next to it, about, where all light on it is that of its caustics.
constexpr double often = 4, often_glossy = 2;
/// Caustics are sampled where paths find the lamp in less of the ball than this many times its share of the picture.
constexpr double worthwhile = 8;
/// How much of the light on a ball of glass comes off it by so many chords, about.
constexpr double by_chords[] = {0.2, 1, 0.1, 0.03, 0.02};
static_assert(std::size(by_chords) == kernels::most_chords + 1);

using Indices = std::vector<std::uint32_t>;

/// Those of `of` for which `value` is greatest, the greatest first.
template <class Value>
Indices greatest(Indices of, std::size_t count, const Value& value) {
    std::ranges::stable_sort(of, std::ranges::greater{}, value);
    if (of.size() > count) of.resize(count);
    return of;
}

/// Indices of the primitives for which `holds`.
template <class Holds>
Indices primitives_where(const Scene& scene, const Holds& holds) {
    Indices list;
    for (std::uint32_t i = 0; i < scene.primitives.size(); ++i)
        if (holds(scene.primitives[i])) list.push_back(i);
    return list;
}

bool obstructed(const Scene& scene, std::uint32_t ball) {
    const Primitive& b = scene.primitives[ball];
    for (std::uint32_t i = 0; i < scene.primitives.size(); ++i) {
        const Primitive& p = scene.primitives[i];
        const double apart = glm::length(p.centre - b.centre);
        const bool around = apart + b.radius < p.radius * (1 - 1e-5);
        if (i != ball && apart < (b.radius + p.radius) * (1 + 1e-5) && !around) return true;
    }
    return false;
}

/// The lamp's light on the ball, in no unit.
double light_on(const Primitive& ball, const Primitive& lamp) {
    const double sine = lamp.radius / glm::length(lamp.centre - ball.centre);
    return &ball == &lamp ? 0 : brightest(*lamp.emission) * sine * sine;
}

/// How much of the picture the ball takes up, about, wherever it stands about the camera.
double share_of_picture(const Scene& scene, const Primitive& ball) {
    const double sine = ball.radius / glm::length(ball.centre - scene.camera.position);
    const double half = std::tan(glm::radians(scene.camera.fov) / 2);
    return std::numbers::pi / 4 * (sine * sine) / (half * half);
}

/// Whether paths find the lamp over the ball often enough for what it matters: of the ball's directions as many as the
/// lamp, as its lobe blurs it, takes up of a half sphere; and only surfaces near the ball see much of it.
bool left_to_chance(const Scene& scene, const Primitive& ball, double roughness, const Primitive& lamp) {
    const double distance = glm::length(lamp.centre - ball.centre);
    const double sine = blurred_radius(distance, lamp.radius, roughness) / distance;
    return worthwhile * share_of_picture(scene, ball) < sine * sine;
}

std::vector<PlannedCaustic> caustics_over(const Scene& scene, std::uint32_t ball, const Indices& lamps) {
    const Primitive& b = scene.primitives[ball];
    const bool mirror = !kernels::traits_of(scattering(scene, b)).is_interface;
    const bool cut = !mirror && obstructed(scene, ball);
    const double roughness = smooth(scene, b) ? 0 : scene.materials[b.material].roughness;
    std::vector<PlannedCaustic> list;
    // A path over the ball has an event more than chords, and one at the vertex.
    const std::uint32_t depth = scene.settings.depth;
    const std::uint32_t most_chords = mirror ? 0 : std::min(kernels::most_chords, std::max(depth, 2u) - 2);
    double light_in_all = 0, sampled = 0;
    for (const std::uint32_t l : lamps) {
        const Primitive& lamp = scene.primitives[l];
        const double light = light_on(b, lamp);
        light_in_all += light;
        if (l == ball || glm::length(lamp.centre - b.centre) <= (lamp.radius + b.radius) * (1 + 1e-5)) continue;
        if (left_to_chance(scene, b, roughness, lamp)) continue;
        for (std::uint32_t chords = 0; chords <= most_chords; ++chords)
            list.push_back(
                {ball, l, chords, cut && chords > 0, roughness, (mirror ? 1 : by_chords[chords]) * light, 0});
    }
    std::ranges::stable_sort(list, std::ranges::greater{}, &PlannedCaustic::share);
    if (list.size() > most_of_ball) list.resize(most_of_ball);
    for (const PlannedCaustic& caustic : list) sampled += caustic.share;
    if (sampled <= 0) return {};
    const double rate = (roughness > 0 ? often_glossy : often) * sampled / light_in_all;
    for (PlannedCaustic& caustic : list) caustic.rate = rate, caustic.share /= sampled;
    return list;
}

}  // namespace

Indices smooth_spheres(const Scene& scene) {
    return primitives_where(scene, [&](const Primitive& p) { return smooth(scene, p); });
}

bool any_obstructed(const Scene& scene, const Indices& balls) {
    constexpr std::size_t most_pairs = 10'000'000;
    if (balls.size() > most_pairs / scene.primitives.size()) return true;
    return std::ranges::any_of(balls, [&](std::uint32_t ball) {
        return scattering(scene, scene.primitives[ball]) != Scattering::specular && obstructed(scene, ball);
    });
}

std::vector<PlannedCaustic> plan_caustics(const Scene& scene, bool over_glossy) {
    const auto& p = scene.primitives;
    const Indices lamps = greatest(primitives_where(scene, emits), most_lamps, [&](std::uint32_t i) {
        return brightest(*p[i].emission) * p[i].radius * p[i].radius;
    });
    std::vector<double> strength(p.size());
    Indices balls;
    for (const bool glossy : {false, true}) {
        if (glossy && !over_glossy) break;
        Indices of = primitives_where(scene, [&](const Primitive& ball) {
            return glossy ? scattering(scene, ball) == Scattering::glossy : smooth(scene, ball);
        });
        for (const std::uint32_t b : of)
            for (const std::uint32_t l : lamps) strength[b] += light_on(p[b], p[l]) * p[b].radius * p[b].radius;
        of = greatest(std::move(of), kernels::most_caustic_groups / 2, [&](std::uint32_t b) { return strength[b]; });
        balls.insert(balls.end(), of.begin(), of.end());
    }
    std::vector<PlannedCaustic> list;
    for (const std::uint32_t b : balls) {
        const auto over = caustics_over(scene, b, lamps);
        list.insert(list.end(), over.begin(), over.end());
    }
    return list;
}

double blurred_radius(double distance, double radius, double roughness) {
    return distance * std::sin(std::min(1.3, std::asin(radius / distance) + std::asin(roughness)));
}

double carried_on(const Scene& scene) {
    double sum = 0;
    std::size_t count = 0;
    for (const Primitive& p : scene.primitives) {
        if (smooth(scene, p)) continue;
        sum += brightest(scene.materials[p.material].rho);
        ++count;
    }
    return count > 0 ? std::clamp(sum / static_cast<double>(count), 0.01, 1.0) : 1;
}

template <class Real>
void put_steps(kernels::Caustic<Real>& caustic, double radius, const Material& ball) {
    const double greatest = caustic.chords > 0 ? std::min(1.0, ball.eta) : 1;
    kernels::Caustic<double> alike{};
    alike.chords = caustic.chords, alike.mirror = caustic.mirror, alike.eta = ball.eta, alike.radius = radius;
    caustic.steps = caustic.chords == 0 ? 8 : caustic.chords == 1 ? 16 : kernels::most_caustic_steps;  // T turns faster
    for (std::uint32_t i = 0; i <= caustic.steps; ++i) {
        const double sine = greatest * std::sin(i * std::numbers::pi / (2 * caustic.steps));
        const double within = caustic.chords > 0 ? std::asin(std::min(1.0, sine / ball.eta)) : 0;
        const double turn = 2 * std::asin(sine) + caustic.chords * (std::numbers::pi - 2 * within);
        const double share = kernels::share_of_events<kernels::ScalarLanes<double>>(alike, radius * sine);
        caustic.step[i] = {static_cast<Real>(radius * sine), static_cast<Real>(std::sin(turn)),
                           static_cast<Real>(std::cos(turn)), static_cast<Real>(share)};
    }
}

template void put_steps(kernels::Caustic<float>&, double, const Material&);
template void put_steps(kernels::Caustic<double>&, double, const Material&);

}  // namespace orrery
