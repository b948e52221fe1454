#include "plan/caustics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

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

/// Unpolarised reflectance at the angle whose sine outside is `sine`.
double fresnel(double sine, double eta) {
    const double cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
    const double within = sine / eta;
    if (within >= 1) return 1;
    const double cosine_t = std::sqrt(1 - within * within);
    const double rs = (cosine - eta * cosine_t) / (cosine + eta * cosine_t);
    const double rp = (eta * cosine - cosine_t) / (eta * cosine + cosine_t);
    return (rs * rs + rp * rp) / 2;
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

}  // namespace

std::vector<PlannedCaustic> plan_caustics(const Scene& scene) {
    constexpr std::size_t most_balls = 4, most_of_ball = 12;
    constexpr double kappa = 2;
    // How much of the light on a ball comes off it by so many chords, about.
    constexpr double by_chords[] = {0.2, 1, 0.1};
    struct Ball {
        double strength;
        std::vector<PlannedCaustic> ways;
    };
    std::vector<Ball> balls;
    for (std::uint32_t b = 0; b < scene.primitives.size(); ++b) {
        const Primitive& ball = scene.primitives[b];
        if (!smooth(scene, ball)) continue;
        const bool mirror = scattering(scene, ball) == Scattering::specular;
        Ball found{0, {}};
        double all = 0;
        const bool cut = !mirror && obstructed(scene, b);
        for (std::uint32_t l = 0; l < scene.primitives.size(); ++l) {
            const Primitive& lamp = scene.primitives[l];
            if (l == b || !emits(lamp)) continue;
            const double apart = glm::length(lamp.centre - ball.centre), sine = lamp.radius / apart;
            const double light = brightest(*lamp.emission) * sine * sine;
            all += light;
            if (apart <= (lamp.radius + ball.radius) * (1 + 1e-5)) continue;
            for (std::uint32_t chords = 0; chords <= (mirror ? 0 : kernels::most_chords); ++chords)
                found.ways.push_back({b, l, chords, cut && chords > 0, (mirror ? 1 : by_chords[chords]) * light, 0});
        }
        std::ranges::stable_sort(found.ways, std::ranges::greater{}, &PlannedCaustic::share);
        if (found.ways.size() > most_of_ball) found.ways.resize(most_of_ball);
        double sum = 0;
        for (const PlannedCaustic& way : found.ways) sum += way.share;
        if (sum <= 0) continue;
        for (PlannedCaustic& way : found.ways) way.rate = kappa * sum / all, way.share /= sum;
        found.strength = sum * ball.radius * ball.radius;
        balls.push_back(std::move(found));
    }
    std::ranges::stable_sort(balls, std::ranges::greater{}, &Ball::strength);
    if (balls.size() > most_balls) balls.resize(most_balls);
    std::vector<PlannedCaustic> list;
    for (const Ball& ball : balls) list.insert(list.end(), ball.ways.begin(), ball.ways.end());
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
    for (std::uint32_t i = 0; i <= kernels::caustic_steps; ++i) {
        const double sine = greatest * std::sin(i * std::numbers::pi / (2 * kernels::caustic_steps));
        const double within = caustic.chords > 0 ? std::asin(std::min(1.0, sine / ball.eta)) : 0;
        const double turn = 2 * std::asin(sine) + caustic.chords * (std::numbers::pi - 2 * within);
        const double reflected = caustic.mirror ? 1 : fresnel(sine, ball.eta);
        const double through = (1 - reflected) * (1 - reflected);
        const double share = caustic.chords == 0 ? reflected : caustic.chords == 1 ? through : through * reflected;
        caustic.step[i] = {static_cast<Real>(radius * sine), static_cast<Real>(std::sin(turn)),
                           static_cast<Real>(std::cos(turn)), static_cast<Real>(share)};
    }
}

template void put_steps(kernels::Caustic<float>&, double, const Material&);
template void put_steps(kernels::Caustic<double>&, double, const Material&);

}  // namespace orrery
