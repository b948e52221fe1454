// Interfaces and rough lobes where their formulas are about to break: no interface, almost none, enormous indices, the
// critical angle, grazing light, lobes as narrow as a rounding and as wide as the half space.
#include <fmt/format.h>

#include "backward_error.hpp"
#include "kernels/lobes.hpp"
#include "trials.hpp"

namespace orrery::extremes {

namespace {

/// Fresnel's equations in the sine and tangent form's algebraic cousin: reflectance by admittances, s and p.
struct Fresnel {
    Wide reflectance, cosine_t;
};
Fresnel fresnel(Wide cosine, Wide eta) {
    const Wide sine2_t = (1 - cosine * cosine) / (eta * eta);
    if (sine2_t >= 1) return {1, 0};
    const Wide cosine_t = root(1 - sine2_t);
    // Admittance n cos (s) and n / cos (p); r = (Y0 - Y1) / (Y0 + Y1).
    const Wide s0 = cosine, s1 = eta * cosine_t, p0 = cosine_t, p1 = eta * cosine;
    const Wide s = (s0 - s1) / (s0 + s1), p = (p0 - p1) / (p0 + p1);
    return {(s * s + p * p) / 2, cosine_t};
}

/// What one rounding of the inputs makes of the result.
template <class Value>
Wide change(Wide unit, Wide cosine, Wide eta, const Value& value) {
    Wide most = 0;
    const Wide centre = value(fresnel(cosine, eta));
    for (const Wide dc : {-unit, Wide(0), unit})
        for (const Wide de : {-unit, Wide(0), unit})
            most = std::max(most,
                            magnitude(value(fresnel(std::min(Wide(1), cosine * (1 + dc)), eta * (1 + de))) - centre));
    return most;
}

template <class Real>
struct Incidence {
    Real cosine, eta;
};

template <class V>
void cross_interface(Errors& errors, const Incidence<typename V::Real>& in) {
    using Real = typename V::Real;
    using F = typename V::F;
    const auto unit = static_cast<Wide>(rounding_unit<Real>);
    const auto cosine = static_cast<Wide>(in.cosine), eta = static_cast<Wide>(in.eta);
    const auto at = kernels::interface_at<V>(F(in.cosine), F(in.eta));
    const Fresnel exact = fresnel(cosine, eta);
    const auto reflectance = [](const Fresnel& f) { return f.reflectance; };
    const auto cosine_t = [](const Fresnel& f) { return f.cosine_t; };
    const Wide r = magnitude(static_cast<Wide>(first_lane(at.reflectance)) - exact.reflectance) /
                   (unit + change(unit, cosine, eta, reflectance));
    const Wide t = magnitude(static_cast<Wide>(first_lane(at.cosine_t)) - exact.cosine_t) /
                   (unit + change(unit, cosine, eta, cosine_t));
    errors.add(static_cast<double>(std::max(r, t)),
               [&] { return fmt::format("cosine {:a}, eta {:a}", in.cosine, in.eta); });
}

/// The refracted direction against Snell's law, of the directions as they were rounded. The kernel knows the angle of
/// incidence by its cosine, one rounding of which is u / sin of the angle, and 1 / eta as much behind the interface.
template <class V>
void refract(Errors& errors, Dice& dice, typename V::Real eta) {
    using Real = typename V::Real;
    using F = typename V::F;
    const Double3 axis = dice.direction();
    const double sine = dice.uniform() * std::fmin(1, 0.999 * static_cast<double>(eta));
    const auto n = unit_length<Real>(axis);
    const auto d = unit_length<Real>(dice.across(axis) * sine - axis * std::sqrt(1 - sine * sine));
    const auto normal = broadcast<V>(n), direction = broadcast<V>(d);
    const F cosine = F(0) - kernels::dot(normal, direction);
    const auto at = kernels::interface_at<V>(cosine, F(eta));
    const Wide3 out = widen(first_lanes<V>(kernels::refracted<V>(direction, normal, cosine, at)));
    const Wide3 exact_n = unit(widen(n)), exact_d = unit(widen(d));
    const Wide c = -dot(exact_n, exact_d), e = static_cast<Wide>(eta);
    const Wide3 along = (1 / e) * (exact_d + c * exact_n);
    const Wide3 wanted = along - root(std::max(Wide(0), 1 - dot(along, along))) * exact_n;
    const auto rounding = static_cast<Wide>(rounding_unit<Real>);
    const Wide steep = root(std::max(Wide(0), 1 - dot(along, along)));
    const Wide behind = length(along), ahead = std::max(behind * e, root(rounding));
    const Wide magnified = std::max(Wide(1), 1 / (e * ahead)) / std::max(steep, root(rounding));
    errors.add(static_cast<double>(length(out - wanted) / (rounding * magnified)),
               [&] { return fmt::format("eta {:a}, sine {:a}", eta, sine); });
}

/// A lobe of width beta about a direction over a surface, and a sample of it.
template <class V>
struct Perturbed {
    using Real = typename V::Real;
    kernels::Vec3<Real> lobe, normal;
    Real cosine, beta;
    Real u, v;
    kernels::GlossySample<typename V::F> sample;

    Wide3 direction() const { return widen(first_lanes<V>(sample.direction)); }
    /// R + beta S may be as short as 1 - beta, and what its rounding is to its length as much larger.
    Wide rounding() const { return static_cast<Wide>(rounding_unit<Real>) / (1 - static_cast<Wide>(beta)); }
    std::string text() const { return fmt::format("beta {:a}, cosine {:a}, u {:a}, v {:a}", beta, cosine, u, v); }
};

template <class V>
Perturbed<V> any_perturbed(Dice& dice, double beta) {
    using Real = typename V::Real;
    using F = typename V::F;
    const double cosine = dice.coin() ? dice.uniform() : dice.scale(1e-9, 1);
    const Double3 axis = dice.direction();
    const auto number = [&] {
        return static_cast<Real>(dice.integer(0, 3) == 0 ? dice.integer(0, 1) * (1 - 0x1p-24)
                                                         : dice.integer(0, (1 << 24) - 1) * 0x1p-24);
    };
    const auto lobe = rounded<Real>(axis * cosine + dice.across(axis) * std::sqrt(1 - cosine * cosine));
    Perturbed<V> p{lobe, rounded<Real>(axis), static_cast<Real>(cosine), static_cast<Real>(beta), number(), number(),
                   {}};
    p.sample =
        kernels::sample_glossy<V>(broadcast<V>(p.lobe), broadcast<V>(p.normal), F(p.cosine), F(p.beta), F(p.u), F(p.v));
    return p;
}

Wide sine_between(const Wide3& a, const Wide3& b) {
    const Wide cosine = dot(a, b) / length(a) / length(b);
    return root(std::max(Wide(0), (1 - cosine) * (1 + cosine)));
}

/// A direction of unit length, on the right side, within the lobe, with a density that is a number.
template <class V>
void perturb(Errors& errors, Dice& dice, double beta) {
    const auto p = any_perturbed<V>(dice, beta);
    const Wide3 direction = p.direction();
    const Wide below = -dot(widen(p.normal), direction);
    const Wide outside = sine_between(widen(p.lobe), direction) - static_cast<Wide>(p.beta);
    const Wide error = std::max(std::max(below, outside), magnitude(length(direction) - 1)) / p.rounding();
    const bool density = first_lane(p.sample.pdf) >= 0;
    errors.add(density ? static_cast<double>(std::max(Wide(0), error)) : std::numeric_limits<double>::infinity(),
               [&] { return p.text(); });
}

/// Density at the sine of an angle to the lobe, before it is conditioned on a side; infinite from beta on.
Wide density_of_lobe(Wide sine, Wide beta) {
    if (sine >= beta) return std::numeric_limits<double>::infinity();
    return (1 - 2 * sine * sine + beta * beta) /
           (2 * static_cast<Wide>(std::numbers::pi_v<long double>) * beta * root((beta - sine) * (beta + sine)));
}

/// How far the direction would have to turn, in roundings, for the density to be that of its angle: as the density goes
/// to infinity at the edge of the lobe, no other measure holds there. Beyond the edge it is 0.
template <class V>
double turn_to_density(const Perturbed<V>& p, Wide density) {
    if (!(density >= 0)) return std::numeric_limits<double>::infinity();
    const Wide beta = static_cast<Wide>(p.beta);
    // Lengths of R + beta S come in twice.
    const Wide rounding = p.rounding() / (1 - beta);
    const Wide side = (1 + std::min(Wide(1), static_cast<Wide>(p.cosine) / beta)) / 2;
    const Wide sine = sine_between(widen(p.lobe), p.direction());
    const Wide lowest_at = root(std::max(Wide(0), (3 * beta * beta - 1) / 2));  // the density's only minimum
    for (double turns = 0x1p-3; turns < 0x1p20; turns *= 1.2) {
        const Wide turn = static_cast<Wide>(turns);
        const Wide from = std::max(Wide(0), sine - turn * rounding), to = sine + turn * rounding;
        if (density == 0 && to >= beta) return turns;
        const Wide low = density_of_lobe(std::clamp(lowest_at, from, to), beta);
        const Wide high = std::max(density_of_lobe(from, beta), density_of_lobe(to, beta));
        const Wide value = density * side;
        if (value >= low * (1 - turn * rounding) && value <= high * (1 + turn * rounding)) return turns;
    }
    return std::numeric_limits<double>::infinity();
}

/// The density that comes with the sample.
template <class V>
void sampled_density(Errors& errors, Dice& dice, double beta) {
    const auto p = any_perturbed<V>(dice, beta);
    errors.add(turn_to_density(p, static_cast<Wide>(first_lane(p.sample.pdf))), [&] { return p.text(); });
}

/// The density as it is found for a direction from elsewhere.
template <class V>
void evaluated_density(Errors& errors, Dice& dice, double beta) {
    using F = typename V::F;
    const auto p = any_perturbed<V>(dice, beta);
    const auto normal = broadcast<V>(p.normal);
    const F above = kernels::dot(p.sample.direction, normal);
    if (!(first_lane(above) > 0)) return;  // by a rounding
    const F pdf = kernels::glossy_pdf<V>(broadcast<V>(p.lobe), F(p.cosine), F(p.beta), p.sample.direction, above);
    errors.add(turn_to_density(p, static_cast<Wide>(first_lane(pdf))), [&] { return p.text(); });
}

/// Any index, and an angle of incidence within some roundings of the critical one.
template <class Real>
Incidence<Real> critical(Dice& dice) {
    const auto eta = static_cast<Real>(1 - dice.scale(1e-6, 0.999));
    const Wide e = static_cast<Wide>(eta);
    return {nudged(static_cast<Real>(root((1 - e) * (1 + e))), dice.integer(-4, 4)), eta};
}

}  // namespace

void add_material(std::vector<Case>& cases) {
    for_each_mode([&]<class V>() {
        using Real = typename V::Real;
        const auto add = [&](const std::string& name, const char* unit, double limit, const auto& trial) {
            add_trials<V>(cases, "material", name, unit, limit, 2000, trial);
        };
        const char* const unit = "u and a rounding of the input";
        const auto add_index = [&](const char* name, double eta, bool grazing) {
            add(name, unit, eta == 1 ? 0.1 : 6, [=](Errors& errors, Dice& dice) {
                cross_interface<V>(errors, {static_cast<Real>(grazing ? dice.scale(1e-9, 1e-2) : dice.uniform()),
                                            static_cast<Real>(eta)});
            });
        };
        add_index("Fresnel, eta 1", 1, false);
        add_index("Fresnel, eta 0.9999999", 1 - 1e-7, false);
        add_index("Fresnel, eta 1.0000001", 1 + 1e-7, false);
        add("Fresnel, eta 1e-3, below the critical angle", unit, 6, [](Errors& errors, Dice& dice) {
            cross_interface<V>(errors, {static_cast<Real>(1 - 5e-7 * dice.uniform()), static_cast<Real>(1e-3)});
        });
        add_index("Fresnel, eta 1e3", 1e3, false);
        add_index("Fresnel, eta 1.5, cosine 1e-9 to 0.01", 1.5, true);
        add_index("Fresnel, eta 1, cosine 1e-9 to 0.01", 1, true);
        add_index("Fresnel, eta 1.0000001, cosine 1e-9 to 0.01", 1 + 1e-7, true);
        add("Fresnel, within 4 numbers of the critical angle", unit, 2,
            [](Errors& errors, Dice& dice) { cross_interface<V>(errors, critical<Real>(dice)); });
        for (const double eta : {1., 1 - 1e-7, 1 + 1e-7, 1e-3, 1e3})
            add(fmt::format("refracted direction, eta {}", eta), "a rounding of the cosine", 5,
                [=](Errors& errors, Dice& dice) { refract<V>(errors, dice, static_cast<Real>(eta)); });
        const char* const turn = "u / (1 - beta)";
        const char* const twice = "u / (1 - beta)^2";
        for (const double beta : {1e-8, 1e-3, 0.999999})
            add(fmt::format("glossy sample, roughness {}", beta), turn, 6,
                [=](Errors& errors, Dice& dice) { perturb<V>(errors, dice, beta); });
        for (const double beta : {1e-8, 1e-3, 0.5, 0.99, 0.999999})
            add(fmt::format("glossy density, sampled, roughness {}", beta), twice, 8,
                [=](Errors& errors, Dice& dice) { sampled_density<V>(errors, dice, beta); });
        for (const double beta : {1e-8, 1e-3, 0.5, 0.99, 0.999999})
            add(fmt::format("glossy density, evaluated, roughness {}", beta), twice, 8,
                [=](Errors& errors, Dice& dice) { evaluated_density<V>(errors, dice, beta); });
    });
}

}  // namespace orrery::extremes
