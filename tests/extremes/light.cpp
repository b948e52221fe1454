// Sampling lights: the smallest, the largest, the farthest; from within, from the surface, from below the horizon.
#include "kernels/light.hpp"

#include <fmt/format.h>

#include "cases.hpp"
#include "kernels/connect.hpp"
#include "spheres.hpp"
#include "trials.hpp"

namespace orrery::extremes {

namespace {

/// A light and a point that is lit. As in backward_error.hpp the unit of error is what one rounding of the inputs, the
/// vector between them and the radius, would do.
template <class Real>
struct Lit {
    Ball<Real> light;
    kernels::Vec3<Real> point;
    Real u, v;
};

template <class Real>
std::string text_of(const Lit<Real>& lit) {
    const auto& [light, p, u, v] = lit;
    return fmt::format("light ({:a}, {:a}, {:a}) {:a} from ({:a}, {:a}, {:a}), u {:a}, v {:a}", light.centre.x,
                       light.centre.y, light.centre.z, light.radius, p.x, p.y, p.z, u, v);
}

/// Seen from `distance` radii away from its centre.
template <class Real>
Lit<Real> lit_from(Dice& dice, double distance) {
    const double r = dice.scale(1e-6, 1e6);
    const Double3 centre = dice.direction() * (r * dice.scale(1e-3, 10));
    const auto number = [&] {
        return static_cast<Real>(static_cast<float>(dice.integer(0, (1 << 24) - 1)) * 0x1p-24f);
    };
    return {{rounded<Real>(centre), static_cast<Real>(r)},
            rounded<Real>(centre + dice.direction() * (r * distance)),
            number(),
            number()};
}

/// Solid angle of a light of radius r whose centre is f away, over 2 pi; that of a half space from its surface on.
Wide cone_of(Wide r, Wide f) {
    if (r >= f) return 1;
    const Wide sine2 = r / f * (r / f);
    return sine2 / (1 + root((1 - r / f) * (1 + r / f)));
}

template <class V>
kernels::Sphere<typename V::F> sphere_of(const Ball<typename V::Real>& ball) {
    using F = typename V::F;
    return {broadcast<V>(ball.centre), F(ball.radius), F(ball.radius * ball.radius)};
}

/// What is no sample has no error.
constexpr double no_sample = -1;

/// A sample as a hit that the light's own geometry must confirm.
template <class V>
double error_of_place(const Lit<typename V::Real>& lit, const kernels::LightSample<V>& sample, bool inside) {
    using Real = typename V::Real;
    using kernels::any;
    if (!any(sample.valid)) return no_sample;
    Ray<Real> ray;
    ray.origin = lit.point;
    ray.direction = first_lanes<V>(sample.direction);
    const Wide off = magnitude(length(widen(ray.direction)) - 1) / static_cast<Wide>(rounding_unit<Real>);
    const GapOf<Wide> gap(ray, lit.light);
    const Wide t = 1 / static_cast<Wide>(first_lane(sample.inverse_distance));
    return static_cast<double>(std::max(gap.of_hit(0, t, inside), off));
}

template <class V>
kernels::LightSample<V> cone_sample(const Lit<typename V::Real>& lit) {
    using F = typename V::F;
    return kernels::sample_light_cone<V>(broadcast<V>(lit.point), sphere_of<V>(lit.light), F(lit.u), F(lit.v));
}

template <class V>
double error_of_cone_place(const Lit<typename V::Real>& lit) {
    return error_of_place<V>(lit, cone_sample<V>(lit), false);
}

/// Of 1 / density, the solid angle.
template <class V>
double error_of_cone_density(const Lit<typename V::Real>& lit) {
    using Real = typename V::Real;
    using kernels::any;
    const auto sample = cone_sample<V>(lit);
    const auto unit = static_cast<Wide>(rounding_unit<Real>);
    const Wide f = length(widen(lit.light.centre) - widen(lit.point)), r = static_cast<Wide>(lit.light.radius);
    const Wide exact = cone_of(r, f), step = unit * (f + r);
    // On the surface, give or take a rounding, there may be no sample.
    if (!any(sample.valid)) return static_cast<double>(std::max(Wide(0), f - r) / step);
    const Wide value =
        static_cast<Wide>(first_lane(sample.inverse_pdf)) / (2 * static_cast<Wide>(std::numbers::pi_v<long double>));
    const Wide change = std::max(cone_of(r + step, f) - exact, exact - cone_of(r - step, f));
    return static_cast<double>(magnitude(value - exact) / (change + unit * exact));
}

template <class Real>
bool within(const Lit<Real>& lit) {
    return length(widen(lit.point) - widen(lit.light.centre)) < static_cast<Wide>(lit.light.radius);
}

template <class V>
kernels::LightSample<V> area_sample(const Lit<typename V::Real>& lit) {
    using F = typename V::F;
    return kernels::sample_light_area<V>(broadcast<V>(lit.point), sphere_of<V>(lit.light), typename V::M(within(lit)),
                                         F(lit.u), F(lit.v));
}

template <class V>
double error_of_area_place(const Lit<typename V::Real>& lit) {
    return error_of_place<V>(lit, area_sample<V>(lit), within(lit));
}

/// Of 1 / density: the area, foreshortened, over the square of the distance. In roundings of C - O and r, of which the
/// distance has (f + r) / distance and so the result three.
template <class V>
double error_of_area_density(const Lit<typename V::Real>& lit) {
    using Real = typename V::Real;
    using F = typename V::F;
    using kernels::any;
    const auto sample = area_sample<V>(lit);
    if (!any(sample.valid)) return no_sample;
    const Wide3 n = widen(first_lanes<V>(kernels::sample_unit_sphere<V>(F(lit.u), F(lit.v))));
    const Wide3 f = widen(lit.light.centre) - widen(lit.point);
    const Wide r = static_cast<Wide>(lit.light.radius);
    const Wide3 to = f + r * n;
    const Wide distance = length(to), seen = r / distance;
    const Wide exact = magnitude(dot(n, to)) / distance * seen * seen;
    const Wide value =
        static_cast<Wide>(first_lane(sample.inverse_pdf)) / (4 * static_cast<Wide>(std::numbers::pi_v<long double>));
    const Wide unit = static_cast<Wide>(rounding_unit<Real>) * (length(f) + r) / distance;
    return static_cast<double>(magnitude(value - exact) / (unit * seen * seen));
}

/// A point light over a diffuse surface, within some roundings of the horizon or anywhere: what it brings, in roundings
/// of what it would bring straight from above.
template <class V>
void light_a_plane(Errors& errors, Dice& dice) {
    using Real = typename V::Real;
    using F = typename V::F;
    const Double3 n = dice.direction();
    const double d = dice.scale(1e-8, 1e8);
    const double up = dice.coin() ? dice.integer(-4, 4) * rounding_unit<Real> : dice.between(-1, 1);
    const Double3 to = kernels::unit(n * up + dice.across(n) * std::sqrt(1 - up * up)) * d;
    const auto normal = unit_length<Real>(n);
    const kernels::Vec3<Real> light{static_cast<Real>(to.x), static_cast<Real>(to.y), static_cast<Real>(to.z)};
    const auto sample = kernels::sample_point<V>({F(0), F(0), F(0)}, broadcast<V>(light));
    const F pdf = kernels::response_pdf<V, kernels::Response::diffuse>(broadcast<V>(normal), sample.direction, nullptr);
    const F arrives = pdf * sample.inverse_distance * sample.inverse_distance;
    const Wide3 exact = widen(light);
    const Wide distance = length(exact), pi = static_cast<Wide>(std::numbers::pi_v<long double>);
    const Wide whole = 1 / (pi * distance * distance);
    const Wide wanted = std::max(Wide(0), dot(widen(normal), exact) / distance) * whole;
    const Wide factor = std::max(Wide(0), static_cast<Wide>(first_lane(arrives)));
    errors.add(static_cast<double>(magnitude(factor - wanted) / (whole * static_cast<Wide>(rounding_unit<Real>))));
}

template <class V, class Make>
void add_sampled(std::vector<Case>& cases, const char* name, const char* unit, double limit,
                 double (*error_of)(const Lit<typename V::Real>&), const Make& make) {
    add_trials<V>(cases, "light", name, unit, limit, 4000, [=](Errors& errors, Dice& dice) {
        const auto lit = make(dice);
        const double error = error_of(lit);
        if (error != no_sample) errors.add(error, [&] { return text_of(lit); });
    });
}

}  // namespace

void add_light(std::vector<Case>& cases) {
    for_each_mode([&]<class V>() {
        using Real = typename V::Real;
        const auto far = [](Dice& dice) { return lit_from<Real>(dice, dice.scale(1.001, 1e8)); };
        const auto near = [](Dice& dice) {
            return lit_from<Real>(dice, 1 + dice.scale(rounding_unit<Real>, 1e-2) * (dice.coin() ? 1 : -1));
        };
        const auto inside = [](Dice& dice) { return lit_from<Real>(dice, dice.uniform()); };
        const char* const place = "u (f + r)";
        const char* const angle = "u and a rounding of the input";
        add_sampled<V>(cases, "cone, place sampled, up to 1e8 radii away", place, 8, error_of_cone_place<V>, far);
        add_sampled<V>(cases, "cone, place sampled, at the surface", place, 8, error_of_cone_place<V>, near);
        add_sampled<V>(cases, "cone, solid angle, up to 1e8 radii away", angle, 2, error_of_cone_density<V>, far);
        add_sampled<V>(cases, "cone, solid angle, at the surface", angle, 2, error_of_cone_density<V>, near);
        add_sampled<V>(cases, "area, place sampled, up to 1e8 radii away", place, 4, error_of_area_place<V>, far);
        add_sampled<V>(cases, "area, place sampled, at the surface", place, 10, error_of_area_place<V>, near);
        add_sampled<V>(cases, "area, place sampled, from within", place, 10, error_of_area_place<V>, inside);
        const char* const density = "u (f + r) / distance";
        add_sampled<V>(cases, "area, density, up to 1e8 radii away", density, 15, error_of_area_density<V>, far);
        add_sampled<V>(cases, "area, density, at the surface", density, 15, error_of_area_density<V>, near);
        add_sampled<V>(cases, "area, density, from within", density, 20, error_of_area_density<V>, inside);
        add_trials<V>(cases, "light", "point light 1e-8 to 1e8 away, at the horizon", "u cos 0", 10, 4000,
                      light_a_plane<V>);
    });
}

}  // namespace orrery::extremes
