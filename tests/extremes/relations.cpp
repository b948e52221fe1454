// What must hold whatever the numbers are: a world twice as large, moved, mirrored or listed backwards is the same
// world, rays that share a cone meet what each of them would alone, and no number is lost on the way to a picture.
#include <fmt/format.h>

#include <numeric>

#include "cases.hpp"
#include "pictures.hpp"
#include "spheres.hpp"

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

/// A bunch of neighbouring rays, culled together: hits of theirs that are lost.
template <class V>
void share_a_cone(Errors& errors, Dice& dice) {
    using Real = typename V::Real;
    using Word = typename V::Word;
    constexpr std::uint32_t count = kernels::bunch_size;
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
    rays.left = left.data();
    for (const int culled : {0, 1}) {
        ids[culled].resize(count + 32), distances[culled].resize(count + 32);
        const kernels::HitQueue<Real> hits{distances[culled].data(), ids[culled].data()};
        (culled != 0 ? kernels::intersect_coherent<V> : kernels::intersect<V>)(world.table(), rays, count, hits);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        errors.add(ids[0][i] == ids[1][i] && distances[0][i] == distances[1][i] ? 0 : 1);
}

/// A scene of anything at any size, `away` times its size or less from the origin.
Scene wild(Dice& dice, double away) {
    const double size = dice.scale(1e-5, 1e6);
    Scene scene = picture({0, 0, 0}, {0, 0, 1}, dice.between(1, 170), 8);
    scene.settings.samples = 4;
    scene.settings.depth = 12;
    scene.settings.seed = static_cast<std::uint32_t>(dice.integer(0, 1 << 30));
    const Double3 place = dice.direction() * (dice.coin() ? 0 : size * dice.scale(1, away));
    const auto at = [&](double reach) {
        const Double3 v = place + dice.direction() * reach;
        return glm::dvec3{v.x, v.y, v.z};
    };
    scene.camera.position = at(size);
    scene.camera.target = at(size * 0.5);
    scene.camera.aperture = dice.coin() ? 0 : size * dice.scale(1e-8, 1);
    scene.camera.focal_distance = size * dice.scale(1e-3, 1e3);
    if (scene.camera.position == scene.camera.target) scene.camera.target.z += 1;
    constexpr double etas[] = {1, 1 - 1e-7, 1 + 1e-7, 1e-3, 1e3, 1.5}, betas[] = {1e-8, 1e-3, 0.5, 0.999999};
    for (int i = 0; i < 20; ++i) {
        const double rho = dice.integer(0, 2) * 0.5;
        Material m{.id = "m", .kind = static_cast<MaterialKind>(dice.integer(0, 4)), .rho = glm::dvec3{rho}};
        m.rho_t = glm::dvec3{1 - rho};
        m.eta = etas[dice.integer(0, 5)];
        if (m.kind == MaterialKind::glossy || m.kind == MaterialKind::translucent)
            m.roughness = betas[dice.integer(0, 3)];
        auto& sphere = add_sphere(scene, at(size * dice.scale(1e-3, 10)), size * dice.scale(1e-6, 3), m);
        if (dice.integer(0, 3) == 0) sphere.emission = glm::dvec3{dice.scale(1e-30, 1e12)};
    }
    if (dice.coin()) add_point_light(scene, at(size), glm::dvec3{dice.scale(1e-30, 1e12)});
    scene.settings.integrator = dice.coin() ? Integrator::path_tracing : Integrator::whitted;
    scene.settings.transport = static_cast<Transport>(dice.integer(0, 2));
    scene.settings.light_sampling = static_cast<LightSampling>(dice.integer(0, 1));
    scene.settings.roulette = dice.coin();
    return scene;
}

/// Pixels that are no numbers, and samples dropped where none should be.
void render_wild_scenes(Errors& errors, const Pipeline& how, std::uint64_t scenes, double away, bool may_drop) {
    Dice dice(5);
    for (std::uint64_t i = 0; i < scenes; ++i) {
        const auto result = render(wild(dice, away), how);
        double lost = may_drop ? 0 : static_cast<double>(result.stats.dropped_samples);
        for (const Rgb& p : result.image.pixels)
            lost += std::isfinite(p.r + p.g + p.b) && std::min({p.r, p.g, p.b}) >= 0 ? 0 : 1;
        errors.add(lost, [&] { return fmt::format("scene {}", i); });
    }
}

template <class V, class Trial>
void add(std::vector<Case>& cases, const char* name, const char* unit, double limit, std::uint64_t trials,
         const Trial& trial) {
    cases.push_back({"relations", name, mode_name<V>(), unit, limit, trials,
                     [trial, seed = cases.size()](Errors& errors, std::uint64_t count) {
                         Dice dice(seed);
                         for (std::uint64_t i = 0; i < count; ++i) trial(errors, dice);
                     }});
}

}  // namespace

void add_relations(std::vector<Case>& cases) {
    for_each_mode([&]<class V>() {
        add<V>(cases, "scaled by 2^-20 to 2^20", "other hits", 0, 20000, scale<V>);
        add<V>(cases, "mirrored", "other hits", 0, 20000, mirror_world<V>);
        add<V>(cases, "listed backwards", "other hits", 0, 20000, list_backwards<V>);
        for (const double far : {1e3, 1e6})
            add<V>(cases, fmt::format("moved by {:g}", far).c_str(), "u (moved + f + r)", 7, 1000,
                   [=](Errors& errors, Dice& dice) { translate<V>(errors, dice, far); });
        add<V>(cases, "culled as a bunch of 256 rays", "lost hits", 0, 100, share_a_cone<V>);
    });
    for (const Pipeline& how : pipelines()) {
        const auto add_pictures = [&](const char* name, const char* unit, double away, bool may_drop) {
            cases.push_back({"relations", name, how.mode, unit, 0, 60, [=](Errors& errors, std::uint64_t scenes) {
                                 render_wild_scenes(errors, how, scenes, away, may_drop);
                             }});
        };
        add_pictures("pictures of anything at any size", "samples dropped, pixels not finite", 1e3, false);
        // Up to where all coordinates are the same number: samples that are no number are dropped and counted.
        add_pictures("pictures lost in rounding", "pixels not finite", 1e13, true);
    }
}

}  // namespace orrery::extremes
