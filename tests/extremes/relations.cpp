// What must hold whatever the numbers are: a world twice as large, moved, mirrored or listed backwards is the same
// world, and rays that share a cone meet what each of them would alone.
#include <fmt/format.h>

#include "spheres.hpp"
#include "trials.hpp"

namespace orrery::extremes {

namespace {

using kernels::FromOrigin;

/// Some spheres of every size about a place, and a ray among them.
template <class Real>
struct Setting {
    std::vector<Ball<Real>> balls;
    Ray<Real> ray;
};

template <class Real>
Setting<Real> any_setting(Dice& dice) {
    Setting<Real> s;
    const double size = dice.scale(1e-4, 1e4);
    for (int i = 0; i < 12; ++i) {
        const double r = size * dice.scale(1e-3, 1);
        s.balls.push_back({rounded<Real>(dice.direction() * (size * 2 * dice.uniform())), static_cast<Real>(r)});
    }
    s.ray.origin = rounded<Real>(dice.direction() * (size * 4 * dice.uniform()));
    s.ray.direction = unit_length<Real>(dice.direction());
    return s;
}

/// Hits that differ from those of the world as it was: f maps a vector, `factor` a length.
template <class V, class Map>
void compare_with_image(Errors& errors, Dice& dice, typename V::Real factor, const Map& f) {
    using Real = typename V::Real;
    const auto s = any_setting<Real>(dice);
    auto t = s;
    for (auto& [centre, radius] : t.balls) centre = f(centre) * factor, radius *= factor;
    t.ray.origin = f(s.ray.origin) * factor;
    t.ray.direction = f(s.ray.direction);
    const auto hit = cast<V, FromOrigin>(Spheres<Real>(s.balls).table(), s.ray);
    const auto image = cast<V, FromOrigin>(Spheres<Real>(t.balls).table(), t.ray);
    errors.add(image.id == hit.id && image.t == hit.t * factor ? 0 : 1);
}

template <class V>
void scale(Errors& errors, Dice& dice) {
    using Real = typename V::Real;
    const auto factor = static_cast<Real>(std::ldexp(1.0, dice.integer(-20, 20)));
    compare_with_image<V>(errors, dice, factor, [](const auto& v) { return v; });
}

template <class V>
void mirror_world(Errors& errors, Dice& dice) {
    const int axes = dice.integer(1, 7);
    compare_with_image<V>(errors, dice, 1, [=](auto v) {
        if ((axes & 1) != 0) v.x = -v.x;
        if ((axes & 2) != 0) v.y = -v.y;
        if ((axes & 4) != 0) v.z = -v.z;
        return v;
    });
}

template <class V>
void list_backwards(Errors& errors, Dice& dice) {
    using Real = typename V::Real;
    auto s = any_setting<Real>(dice);
    const auto hit = cast<V, FromOrigin>(Spheres<Real>(s.balls).table(), s.ray);
    std::ranges::reverse(s.balls);
    auto other = cast<V, FromOrigin>(Spheres<Real>(s.balls).table(), s.ray);
    if (other.any())
        other.id = (static_cast<std::uint32_t>(s.balls.size()) - 1 - other.sphere()) | (other.id & kernels::inside_bit);
    errors.add(other.id == hit.id && other.t == hit.t ? 0 : 1);
}

/// A world moved away: how much the hit's distance from its own sphere, as it was, has changed, in roundings of where
/// the world is now. A verdict that only rounding can change is left out: a hit at the rim or none.
template <class V>
void translate(Errors& errors, Dice& dice, double far) {
    using Real = typename V::Real;
    const auto s = any_setting<Real>(dice);
    const Double3 by = dice.direction() * far;
    const auto moved = [&](const kernels::Vec3<Real>& v) {
        return rounded<Real>(Double3{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)} +
                             by);
    };
    auto t = s;
    for (auto& ball : t.balls) ball.centre = moved(ball.centre);
    t.ray.origin = moved(s.ray.origin);
    const auto hit = cast<V, FromOrigin>(Spheres<Real>(t.balls).table(), t.ray);
    double worst = 0;
    for (std::uint32_t k = 0; k < s.balls.size(); ++k) {
        const Gap gap(s.ray, s.balls[k]);
        const double error = hit.any() && k == hit.sphere()
                                 ? error_of_hit(gap, s.ray, hit)
                                 : static_cast<double>(gap.of_miss(0, static_cast<Wide>(hit.t)));
        const Wide unit = gap.unit() + static_cast<Wide>(rounding_unit<Real> * far);
        worst = std::fmax(worst, error * static_cast<double>(gap.unit() / unit));
    }
    errors.add(worst);
}

/// A packet of neighbouring rays, culled together: hits of theirs that are lost.
template <class V>
void share_a_cone(Errors& errors, Dice& dice) {
    using Real = typename V::Real;
    using Word = typename V::Word;
    constexpr std::uint32_t count = kernels::packet_size;
    const double reach = dice.scale(1e-4, 1e8), width = dice.scale(1e-7, 1);
    const Double3 eye = dice.direction() * (dice.coin() ? reach * dice.scale(1e-3, 1e3) : 0);
    const Double3 axis = dice.direction();
    std::vector<Ball<Real>> balls;
    for (int i = 0; i < 40; ++i) {
        const double away = reach * dice.scale(1e-3, 1), aside = away * width * dice.scale(0.1, 3);
        const Double3 at = axis * away + dice.across(axis) * aside;
        balls.push_back({rounded<Real>(eye + at), static_cast<Real>(std::fmax(1e-6, aside * dice.between(0, 1)))});
    }
    const Spheres<Real> world(balls);
    std::vector<Real> columns[6];
    for (auto& column : columns) column.resize(count + 32);
    std::vector<Word> left(count + 32, Word{kernels::no_sphere}), ids[2];
    std::vector<Real> distances[2];
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto o = rounded<Real>(eye);
        const auto d = unit_length<Real>(axis + dice.across(axis) * (width * dice.uniform()));
        const Real values[] = {o.x, o.y, o.z, d.x, d.y, d.z};
        for (std::size_t c = 0; c < 6; ++c) columns[c][i] = values[c];
    }
    kernels::RayQueue<Real> rays{};
    rays.ox = columns[0].data(), rays.oy = columns[1].data(), rays.oz = columns[2].data();
    rays.dx = columns[3].data(), rays.dy = columns[4].data(), rays.dz = columns[5].data();
    rays.departed = left.data();
    for (const int culled : {0, 1}) {
        ids[culled].resize(count + 32), distances[culled].resize(count + 32);
        const kernels::HitQueue<Real> hits{distances[culled].data(), ids[culled].data()};
        (culled != 0 ? kernels::intersect_coherent<V> : kernels::intersect<V>)(world.table(), rays, count, hits);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        errors.add(ids[0][i] == ids[1][i] && distances[0][i] == distances[1][i] ? 0 : 1);
}

}  // namespace

void add_relations(std::vector<Case>& cases) {
    for_each_mode([&]<class V>() {
        const auto add = [&](const std::string& name, const char* unit, double limit, std::uint64_t trials,
                             const auto& trial) {
            add_trials<V>(cases, "relations", name, unit, limit, trials, trial);
        };
        add("scaled by 2^-20 to 2^20", "other hits", 0, 20000, scale<V>);
        add("mirrored", "other hits", 0, 20000, mirror_world<V>);
        add("listed backwards", "other hits", 0, 20000, list_backwards<V>);
        for (const double far : {1e3, 1e6})
            add(fmt::format("moved by {:g}", far), "u (moved + f + r)", 7, 1000,
                [=](Errors& errors, Dice& dice) { translate<V>(errors, dice, far); });
        add("culled as a packet of 256 rays", "lost hits", 0, 100, share_a_cone<V>);
    });
}

}  // namespace orrery::extremes
