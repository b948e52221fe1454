#include "plan/caustics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
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
constexpr std::size_t most_lamps = 64, most_balls = 4, most_of_ball = 12;
/// Samples of a ball from next to it, about, where all light on it is that of its caustics.
constexpr double often = 2;
/// How much of the light on a ball of glass comes off it by so many chords, about.
constexpr double by_chords[] = {0.2, 1, 0.1};

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

std::vector<PlannedCaustic> caustics_over(const Scene& scene, std::uint32_t ball, const Indices& lamps) {
    const Primitive& b = scene.primitives[ball];
    const bool mirror = scattering(scene, b) == Scattering::specular;
    const bool cut = !mirror && obstructed(scene, ball);
    std::vector<PlannedCaustic> list;
    double light_in_all = 0, sampled = 0;
    for (const std::uint32_t l : lamps) {
        const Primitive& lamp = scene.primitives[l];
        const double light = light_on(b, lamp);
        light_in_all += light;
        if (l == ball || glm::length(lamp.centre - b.centre) <= (lamp.radius + b.radius) * (1 + 1e-5)) continue;
        for (std::uint32_t chords = 0; chords <= (mirror ? 0 : kernels::most_chords); ++chords)
            list.push_back({ball, l, chords, cut && chords > 0, (mirror ? 1 : by_chords[chords]) * light, 0});
    }
    std::ranges::stable_sort(list, std::ranges::greater{}, &PlannedCaustic::share);
    if (list.size() > most_of_ball) list.resize(most_of_ball);
    for (const PlannedCaustic& caustic : list) sampled += caustic.share;
    if (sampled <= 0) return {};
    for (PlannedCaustic& caustic : list) caustic.rate = often * sampled / light_in_all, caustic.share /= sampled;
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

std::vector<PlannedCaustic> plan_caustics(const Scene& scene) {
    const auto& p = scene.primitives;
    const Indices lamps = greatest(primitives_where(scene, emits), most_lamps, [&](std::uint32_t i) {
        return brightest(*p[i].emission) * p[i].radius * p[i].radius;
    });
    Indices balls = smooth_spheres(scene);
    std::vector<double> strength(p.size());
    for (const std::uint32_t b : balls)
        for (const std::uint32_t l : lamps) strength[b] += light_on(p[b], p[l]) * p[b].radius * p[b].radius;
    balls = greatest(std::move(balls), most_balls, [&](std::uint32_t b) { return strength[b]; });
    std::vector<PlannedCaustic> list;
    for (const std::uint32_t b : balls) {
        const auto over = caustics_over(scene, b, lamps);
        list.insert(list.end(), over.begin(), over.end());
    }
    return list;
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
    for (std::uint32_t i = 0; i <= kernels::caustic_steps; ++i) {
        const double sine = greatest * std::sin(i * std::numbers::pi / (2 * kernels::caustic_steps));
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
