// Rays that leave a surface: none meets it again where it should not, none skips a neighbour, however close.
#include <fmt/format.h>

#include "cases.hpp"
#include "kernels/lobes.hpp"
#include "kernels/vertex.hpp"
#include "spheres.hpp"
#include "trials.hpp"

namespace orrery::extremes {

namespace {

using kernels::FromOrigin;
using kernels::inside_bit;

/// What judges rays in Real: there are a hundred million of them.
template <class Real>
using Judge = std::conditional_t<sizeof(Real) == 4, double, long double>;

enum class Way { reflected, refracted, diffuse };

/// The ray that leaves where `ray` hits, made by the kernels as `scatter` makes it. `eta` as of the material.
template <class V>
Ray<typename V::Real> leaving(const Spheres<typename V::Real>& world, const Ray<typename V::Real>& ray,
                              const Hit<typename V::Real>& hit, Way way, typename V::Real eta, const Double3& point) {
    using F = typename V::F;
    using U = typename V::U;
    using Real = typename V::Real;
    using Word = typename V::Word;
    const auto d = broadcast<V>(ray.direction);
    const auto vertex = kernels::vertex_at<V>(world.table(), broadcast<V>(ray.origin), d, F(hit.t), U(Word{hit.id}));
    auto out = kernels::unit(kernels::reflected(d, vertex.normal, vertex.cosine));
    auto side = static_cast<std::uint32_t>(first_lane(vertex.side));
    if (way == Way::diffuse) {
        out = kernels::unit(vertex.normal + broadcast<V>(rounded<Real>(point)));
    } else if (way == Way::refracted) {
        const auto at = kernels::interface_at<V>(vertex.cosine, F(side == 0 ? eta : 1 / eta));
        if (first_lane(at.reflectance) < 1) {
            out = kernels::unit(kernels::refracted<V>(d, vertex.normal, vertex.cosine, at));
            side ^= inside_bit;
        }
    }
    Ray<Real> result;
    result.origin = first_lanes<V>(vertex.position);
    result.direction = first_lanes<V>(out);
    result.left = hit.sphere() | side;
    return result;
}

/// The worst an answer is about any of the spheres. The one just left is not where its ray begins, give or take the
/// rounding of the position: what matters is that an outward ray does not find it, an inward one on its far side only,
/// as far inside or outside as it began.
template <class Real>
double error_of_next(const Spheres<Real>& world, const Ray<Real>& ray, const Hit<Real>& hit) {
    using W = Judge<Real>;
    constexpr double wrong = std::numeric_limits<double>::infinity();
    const std::uint32_t left = ray.left & kernels::no_sphere;
    const bool inward = ray.left != left;
    if (inward && !hit.any()) return wrong;
    if (hit.any() && hit.sphere() == left && !(inward && hit.inside())) return wrong;
    const auto t = static_cast<W>(hit.t);
    double worst = 0;
    for (std::uint32_t k = 0; k < world.count(); ++k) {
        const GapOf<W> gap(ray, world[k]);
        double error = 0;
        if (k == left) {
            if (!inward) continue;
            const W start = magnitude(gap.at(0)), end = gap.at(t);
            error = static_cast<double>((hit.sphere() == left ? magnitude(end) - start : end - start) / gap.unit());
        } else if (hit.any() && k == hit.sphere()) {
            error = error_of_hit(gap, ray, hit);
        } else {
            error = static_cast<double>(gap.of_miss(0, t));
        }
        worst = std::fmax(worst, error);
    }
    return worst;
}

/// Where a ray is to leave: a sphere, and the direction from its centre to the place.
struct Site {
    Double3 centre;
    double radius;
    Double3 towards;
};

using Neighbours = std::vector<std::pair<Double3, double>> (*)(Dice&, const Site&, double unit);

/// A ray that hits the first sphere near the site, from outside or within; nothing else is there yet.
template <class Real>
Ray<Real> arriving(Dice& dice, const Site& site) {
    const Double3 at = site.centre + site.towards * site.radius;
    const double sign = dice.coin() ? 1 : -1;
    Double3 d = dice.direction();
    if (dice.integer(0, 3) == 0) d = dice.across(site.towards) + site.towards * dice.scale(1e-4, 1);  // grazing
    if (kernels::dot(d, site.towards) * sign > 0) d = d * -1.0;
    d = kernels::unit(d);
    const double far = sign > 0 ? dice.scale(1e-3, 1e3) : dice.between(0, 2) * -kernels::dot(d, site.towards);
    Ray<Real> ray;
    ray.origin = rounded<Real>(at - d * (site.radius * std::abs(far)));
    ray.direction = unit_length<Real, Judge<Real>>(d);
    return ray;
}

constexpr int rays_per_site = 32;

template <class V>
void leave(Errors& errors, Dice& dice, double reach, Neighbours neighbours) {
    using Real = typename V::Real;
    const Site site{dice.direction() * dice.scale(1e-8, reach), dice.scale(1e-4, 1e4), dice.direction()};
    std::vector<Ball<Real>> balls{{rounded<Real>(site.centre), static_cast<Real>(site.radius)}};
    for (const auto& [centre, radius] : neighbours(dice, site, rounding_unit<Real>))
        balls.push_back({rounded<Real>(centre), static_cast<Real>(radius)});
    const Spheres<Real> world(balls);
    for (int i = 0; i < rays_per_site; ++i) {
        const auto ray = arriving<Real>(dice, site);
        const auto hit = cast<V, FromOrigin>(world.table(1), ray);
        if (!hit.any()) continue;
        const auto way = static_cast<Way>(dice.integer(0, 2));
        const auto eta = static_cast<Real>(dice.coin() ? dice.between(1, 2) : dice.between(0.5, 1));
        const auto out = leaving<V>(world, ray, hit, way, eta, dice.direction());
        const auto next = cast<V, FromOrigin>(world.table(), out);
        errors.add(error_of_next(world, out, next), [&] {
            std::string text =
                fmt::format("left {:x} at ({:a}, {:a}, {:a}) towards ({:a}, {:a}, {:a}), met {:x} at {:a};",
                            out.left, out.origin.x, out.origin.y, out.origin.z, out.direction.x, out.direction.y,
                            out.direction.z, next.id, next.t);
            for (const auto& [c, r] : balls) text += fmt::format(" ({:a}, {:a}, {:a}) {:a}", c.x, c.y, c.z, r);
            return text;
        });
    }
}

// --- neighbours ---------------------------------------------------------------------------------------------------

std::vector<std::pair<Double3, double>> none(Dice&, const Site&, double) { return {}; }

std::vector<std::pair<Double3, double>> nested(Dice& dice, const Site& s, double) {
    const double inner = s.radius * dice.scale(1e-3, 0.999), outer = s.radius * dice.scale(1.001, 1e3);
    return {{s.centre + dice.direction() * ((s.radius - inner) * dice.uniform()), inner},
            {s.centre + dice.direction() * ((outer - s.radius) * dice.uniform()), outer}};
}

/// From outside or from within, near the place, to within a few roundings.
std::vector<std::pair<Double3, double>> touching(Dice& dice, const Site& s, double unit) {
    const double r = s.radius * dice.scale(1e-3, 1e3), off = s.radius * unit * dice.integer(-4, 4);
    const Double3 axis = kernels::unit(s.towards + dice.direction() * dice.scale(1e-7, 1));
    const double apart = dice.coin() ? s.radius + r : s.radius - r;
    return {{s.centre + axis * (apart + off), r}};
}

std::vector<std::pair<Double3, double>> overlapping(Dice& dice, const Site& s, double) {
    const double r = s.radius * dice.scale(1e-3, 1e3);
    return {{s.centre + dice.direction() * (s.radius + r * dice.between(-1, 1)), r}};
}

/// The same sphere but for some roundings of the radius, or of the centre.
std::vector<std::pair<Double3, double>> nearly_coincident(Dice& dice, const Site& s, double unit) {
    const auto off = [&] { return s.radius * unit * dice.scale(1, 1e4) * (dice.coin() ? 1 : -1); };
    if (dice.coin()) return {{s.centre, s.radius + off()}};
    return {{s.centre + dice.direction() * off(), s.radius}};
}

std::vector<std::pair<Double3, double>> identical(Dice&, const Site& s, double) { return {{s.centre, s.radius}}; }

// --- positions ----------------------------------------------------------------------------------------------------

/// How far a vertex lies off its sphere, in roundings of the centre's distance from the origin and the radius.
template <class V>
void stand(Errors& errors, Dice& dice) {
    using Real = typename V::Real;
    const Site site{dice.direction() * dice.scale(1e-8, 1e8), dice.scale(1e-4, 1e4), dice.direction()};
    const Spheres<Real> world({{rounded<Real>(site.centre), static_cast<Real>(site.radius)}});
    const auto ray = arriving<Real>(dice, site);
    const auto hit = cast<V, FromOrigin>(world.table(), ray);
    if (!hit.any()) return;
    const auto out = leaving<V>(world, ray, hit, Way::diffuse, 1, dice.direction());
    using W = Judge<Real>;
    const W unit =
        static_cast<W>(rounding_unit<Real>) * (length(widen<W>(world[0].centre)) + static_cast<W>(world[0].radius));
    errors.add(static_cast<double>(magnitude(GapOf<W>(out, world[0]).at(0)) / unit));
}

// --- a hundred shells ---------------------------------------------------------------------------------------------

/// Through 100 shells of glass within each other, and out again: surfaces met out of turn. `step` is between shells, in
/// roundings of the outermost radius.
template <class V>
void pass_shells(Errors& errors, Dice& dice, double step) {
    using Real = typename V::Real;
    constexpr std::uint32_t shells = 100;
    const double r = dice.scale(1e-4, 1e4);
    const Double3 centre = dice.direction() * (r * dice.scale(1e-3, 1));
    std::vector<Ball<Real>> balls;
    for (std::uint32_t i = 0; i < shells; ++i)
        balls.push_back({rounded<Real>(centre), static_cast<Real>(r * (1 - i * step * rounding_unit<Real>))});
    const Spheres<Real> world(balls);
    const Double3 axis = dice.direction();
    Ray<Real> ray;
    ray.origin = rounded<Real>(centre - axis * (3 * r));
    ray.direction = unit_length<Real>(axis * (3 * r) + dice.across(axis) * (r * dice.between(0, 0.5)));
    const auto eta = static_cast<Real>(dice.coin() ? 1 : 1.01);
    std::uint32_t wrong = 0;
    for (std::uint32_t n = 0; n < 2 * shells; ++n) {
        const std::uint32_t turn = n < shells ? n : (2 * shells - 1 - n) | inside_bit;
        const auto hit = cast<V, FromOrigin>(world.table(), ray);
        if (hit.id != turn) ++wrong;
        if (!hit.any()) break;
        ray = leaving<V>(world, ray, hit, Way::refracted, eta, {});
    }
    errors.add(wrong);
}

}  // namespace

void add_leaving(std::vector<Case>& cases) {
    constexpr auto group = "leaving a surface";
    constexpr std::uint64_t sites_of_test = 2500, times_on_page = 170;  // eight cases of 1.3e7 rays
    for_each_mode([&]<class V>() {
        // Of float's rays three in 1e8, which graze another surface they begin on, have a disc of almost 0 beside a c
        // that is not, and miss the place by 10 to 16 units; all others, and all of double's, by less than 8.
        constexpr Limits limits{32, 32, 8};
        const auto beside = [&](const char* name, double reach, Neighbours neighbours) {
            add_trials<V>(
                cases, group, name, "u (f + r)", limits.of<V>(), sites_of_test,
                [=](Errors& errors, Dice& dice) { leave<V>(errors, dice, reach, neighbours); }, times_on_page);
        };
        add_trials<V>(cases, group, "position off the sphere", "u (C + r)", 4, 10000, stand<V>);
        beside("alone, coordinates up to 1e8", 1e8, none);
        beside("nested, coordinates up to 1e4", 1e4, nested);
        beside("nested, coordinates up to 1e8", 1e8, nested);
        beside("touching, coordinates up to 1e4", 1e4, touching);
        beside("touching, coordinates up to 1e8", 1e8, touching);
        beside("overlapping, coordinates up to 1e8", 1e8, overlapping);
        beside("nearly coincident, coordinates up to 1e8", 1e8, nearly_coincident);
        beside("identical, coordinates up to 1e8", 1e8, identical);
        // At 4 roundings apart float (and double) no longer know the order.
        for (const double step : {1024., 16., 8.})
            add_trials<V>(cases, group, fmt::format("100 nested shells, {} roundings apart", step),
                          "surfaces out of turn", 0, 40,
                          [=](Errors& errors, Dice& dice) { pass_shells<V>(errors, dice, step); });
    });
}

}  // namespace orrery::extremes
