// One ray, one sphere: no false miss and no false hit beyond what the rounding of the inputs explains.
#include <fmt/format.h>

#include "backward_error.hpp"
#include "cases.hpp"

namespace orrery::extremes {

namespace {

using kernels::FromOrigin;

template <class Real>
struct Problem {
    Ball<Real> ball;
    Ray<Real> ray;
};

template <class Real>
Ball<Real> ball_at(const Double3& centre, double radius) {
    return {rounded<Real>(centre), static_cast<Real>(radius)};
}

/// A sphere of radius r, seen from `distance` radii away, `aside` radii past its centre.
template <class Real>
Problem<Real> aimed(Dice& dice, const Double3& centre, double r, double distance, double aside) {
    Problem<Real> p;
    p.ball = ball_at<Real>(centre, r);
    const Double3 axis = dice.direction();
    const Double3 from = axis * (r * distance);
    p.ray.origin = rounded<Real>(centre - from);
    p.ray.direction = unit_length<Real>(from + dice.across(axis) * (r * aside));
    return p;
}

constexpr Double3 nowhere{0, 0, 0};

template <class Real>
Problem<Real> at_any_distance(Dice& dice, double farthest) {
    return aimed<Real>(dice, nowhere, dice.scale(1e-6, 1e7), dice.scale(1, farthest), dice.between(0, 1.2));
}

template <class Real>
Problem<Real> far_from_the_origin(Dice& dice) {
    const double r = dice.scale(1e-6, 1e7);
    return aimed<Real>(dice, dice.direction() * dice.scale(1, 1e8), r, dice.scale(1, 1e4), dice.between(0, 1.2));
}

/// Origins a few roundings off the surface, or on it.
template <class Real>
Problem<Real> at_the_surface(Dice& dice) {
    const double r = dice.scale(1e-6, 1e7);
    const Double3 centre = dice.direction() * (r * dice.scale(1e-3, 10));
    const double off = 1 + dice.integer(-6, 6) * rounding_unit<Real>;
    Problem<Real> p;
    p.ball = ball_at<Real>(centre, r);
    p.ray.origin = rounded<Real>(centre + dice.direction() * (r * off));
    p.ray.direction = unit_length<Real>(dice.direction());
    return p;
}

/// Above (or below) the ground: origins closer to a sphere than its size by up to ten orders of magnitude.
template <class Real>
Problem<Real> above_a_ground(Dice& dice) {
    const double r = dice.scale(1e3, 1e7),
                 height = dice.scale(std::sqrt(64 * rounding_unit<Real>) / 2, 1e3) * (dice.coin() ? 1 : -1);
    Problem<Real> p;
    p.ball = ball_at<Real>({0, -r, 0}, r);
    p.ray.origin = rounded<Real>({dice.between(-1, 1), height, dice.between(-1, 1)});
    // Half of the rays run towards the horizon.
    Double3 d = dice.direction();
    if (dice.coin()) d.y *= dice.scale(1e-8, 1);
    p.ray.direction = unit_length<Real>(d);
    return p;
}

/// Past the rim, to within a few roundings of it.
template <class Real>
Problem<Real> tangent(Dice& dice) {
    const double aside = 1 + dice.integer(-8, 8) * rounding_unit<Real>;
    const double r = dice.scale(1e-6, 1e7);
    return aimed<Real>(dice, dice.direction() * (r * dice.scale(1e-3, 1e6)), r, dice.scale(1.001, 1e6), aside);
}

/// Tangents without any rounding of the input: along an axis, the radius aside to the last bit, or one number off.
template <class Real>
Problem<Real> along_an_axis(Dice& dice) {
    const auto r = static_cast<Real>(dice.scale(1e-6, 1e7));
    const auto away = static_cast<Real>(dice.scale(1, 1e6)) * r;
    const Real sign = dice.coin() ? Real(1) : Real(-1);
    const Real aside = dice.coin() ? nudged(r, dice.integer(-2, 2)) : static_cast<Real>(dice.between(-1.1, 1.1)) * r;
    Real origin[3] = {-sign * away, aside, 0}, direction[3] = {sign, 0, 0};
    const int axis = dice.integer(0, 2), next = (axis + dice.integer(1, 2)) % 3;
    std::swap(direction[0], direction[axis]);
    Real place[3] = {};
    place[axis] = origin[0], place[next] = origin[1];
    Problem<Real> p;
    p.ball = {{0, 0, 0}, r};
    p.ray.origin = {place[0], place[1], place[2]};
    p.ray.direction = {direction[0], direction[1], direction[2]};
    return p;
}

/// Components of origin, centre and direction so small that they are denormal, beside ordinary ones.
template <class Real>
Problem<Real> denormal(Dice& dice) {
    using Limit = std::numeric_limits<Real>;
    const auto tiny = [&] {
        return static_cast<Real>(dice.between(-1, 1)) * Limit::min() * static_cast<Real>(dice.scale(0x1p-20, 1));
    };
    Problem<Real> p = along_an_axis<Real>(dice);
    for (auto* v : {&p.ray.origin, &p.ray.direction, &p.ball.centre})
        for (Real* x : {&v->x, &v->y, &v->z})
            if (*x == 0 && dice.coin()) *x = tiny();
    return p;
}

/// Lengths up to the root of the greatest number, beyond which their squares overflow.
template <class Real>
Problem<Real> huge(Dice& dice) {
    const double most = std::sqrt(static_cast<double>(std::numeric_limits<Real>::max())) / 8;
    const double r = dice.scale(most * 1e-9, most / 4);
    const double farthest = most / 2 / r;
    return aimed<Real>(dice, dice.direction() * dice.scale(1, most / 2), r, dice.scale(1, farthest),
                       dice.between(0, 1.2));
}

/// A segment that ends (or begins) at a hit, give or take a few numbers.
template <class Real, bool begins>
Problem<Real> with_an_end_at_the_hit(Dice& dice) {
    auto p = aimed<Real>(dice, nowhere, dice.scale(1e-6, 1e7), dice.scale(1.5, 1e4), dice.between(0, 1));
    const Wide3 f = widen(p.ball.centre) - widen(p.ray.origin);
    const Wide b = dot(f, widen(p.ray.direction)), r = static_cast<Wide>(p.ball.radius);
    const Wide3 l = f - b * widen(p.ray.direction);
    const Wide half = root(std::max(Wide(0), r * r - dot(l, l)));
    const auto at = nudged(static_cast<Real>(dice.coin() ? b - half : b + half), dice.integer(-4, 4));
    (begins ? p.ray.t_min : p.ray.t_max) = at;
    return p;
}

/// A direction that is not of unit length: each component off by up to four numbers.
template <class Real>
Problem<Real> of_bad_length(Dice& dice) {
    auto p = at_any_distance<Real>(dice, 1e5);
    for (Real* x : {&p.ray.direction.x, &p.ray.direction.y, &p.ray.direction.z}) *x = nudged(*x, dice.integer(-4, 4));
    return p;
}

template <class Real>
std::string text_of(const Problem<Real>& p) {
    const auto& [c, r] = p.ball;
    const auto& [o, d, t_min, t_max, left] = p.ray;
    return fmt::format(
        "sphere ({:a}, {:a}, {:a}) {:a}; ray ({:a}, {:a}, {:a}) towards ({:a}, {:a}, {:a}), {:a} to {:a}", c.x, c.y,
        c.z, r, o.x, o.y, o.z, d.x, d.y, d.z, t_min, t_max);
}

template <class Real>
class OneSphere {
public:
    explicit OneSphere(const Ball<Real>& ball) : ball_(ball) {}
    kernels::SphereTable<Real> table() const {
        const auto& c = ball_.centre;
        return {1, &c.x, &c.y, &c.z, &ball_.radius, &radius2_, &inverse_, &none_, &none_};
    }

private:
    Ball<Real> ball_;
    Real radius2_ = ball_.radius * ball_.radius, inverse_ = 1 / ball_.radius;
    kernels::WordOf<Real> none_ = 0;
};

/// The worst verdict of all the kernels know: hit or miss, occluded or not, of rays and of segments.
template <class V>
double worst_verdict(const Problem<typename V::Real>& p) {
    using Real = typename V::Real;
    const OneSphere<Real> one(p.ball);
    const Gap gap(p.ray, p.ball);
    bool met[4] = {cast<V, Real>(one.table(), p.ray).any(), occluded<V, Real>(one.table(), p.ray), false, false};
    met[2] = p.ray.t_min == 0 ? cast<V, FromOrigin>(one.table(), p.ray).any() : met[0];
    met[3] = p.ray.t_min == 0 ? occluded<V, FromOrigin>(one.table(), p.ray) : met[0];
    double worst = 0;
    for (const bool verdict : {false, true})
        if (std::find(met, met + 4, verdict) != met + 4)
            worst = std::fmax(worst, error_of_verdict(gap, p.ray, verdict));
    return worst;
}

template <class V>
double worst_hit(const Problem<typename V::Real>& p) {
    using Real = typename V::Real;
    const OneSphere<Real> one(p.ball);
    const Gap gap(p.ray, p.ball);
    const auto hit = cast<V, Real>(one.table(), p.ray);
    double worst = hit.any() ? error_of_hit(gap, p.ray, hit) : 0;
    if (p.ray.t_min == 0) {
        const auto again = cast<V, FromOrigin>(one.table(), p.ray);
        if (again.any() && (again.t != hit.t || again.id != hit.id))
            worst = std::fmax(worst, error_of_hit(gap, p.ray, again));
    }
    return worst;
}

/// `verdict`, `hit`: the limits for whether it is met and for where.
template <class V, class Make>
void add(std::vector<Case>& cases, const char* name, const Limits& verdict, const Limits& hit, const Make& make) {
    const auto add_one = [&](const char* group, double limit, auto error_of) {
        cases.push_back({group, name, mode_name<V>(), "u (f + r)", limit, 4000,
                         [make, error_of](Errors& errors, std::uint64_t trials, Dice& dice) {
                             for (std::uint64_t i = 0; i < trials; ++i) {
                                 const auto p = make(dice);
                                 errors.add(error_of(p), [&] { return text_of(p); });
                             }
                         }});
    };
    add_one("met or missed", verdict.of<V>(), worst_verdict<V>);
    add_one("where it is met", hit.of<V>(), worst_hit<V>);
}

}  // namespace

void add_ray_and_sphere(std::vector<Case>& cases) {
    for_each_mode([&]<class V>() {
        using Real = typename V::Real;
        // Far away the rounding of b alone is more than the sphere; a segment's end has roundings of its own.
        const Limits sure{1, 1, 1}, near{1.5, 1.5, 1.5}, far{3, 3, 1}, end{5, 6, 5};
        const Limits hit{6, 7, 6}, close{4, 4, 4}, graze{2, 3, 2};
        add<V>(cases, "distance up to 1e5 radii", sure, hit, [](Dice& d) { return at_any_distance<Real>(d, 1e5); });
        add<V>(cases, "distance up to 1e8 radii", far, hit, [](Dice& d) { return at_any_distance<Real>(d, 1e8); });
        add<V>(cases, "centre up to 1e8 from the origin", sure, hit, far_from_the_origin<Real>);
        add<V>(cases, "origin on the surface, just inside, just outside", near, close, at_the_surface<Real>);
        add<V>(cases, "origin above and below a ground of radius 1e3 to 1e7", near, close, above_a_ground<Real>);
        add<V>(cases, "tangent within 8 roundings", near, graze, tangent<Real>);
        add<V>(cases, "along an axis, tangent to the last bit", sure, close, along_an_axis<Real>);
        add<V>(cases, "denormal components", sure, close, denormal<Real>);
        add<V>(cases, "lengths up to 1/8 of the root of the greatest number", far, hit, huge<Real>);
        add<V>(cases, "t_max within 4 numbers of a hit", end, hit, with_an_end_at_the_hit<Real, false>);
        add<V>(cases, "t_min within 4 numbers of a hit", end, hit, with_an_end_at_the_hit<Real, true>);
        add<V>(cases, "direction's components off by up to 4 numbers", sure, hit, of_bad_length<Real>);
    });
}

}  // namespace orrery::extremes
