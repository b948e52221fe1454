// What must hold of whole pictures: of a world twice as large, moved, mirrored, listed backwards, of its samples taken
// in parts; and that no number is lost on the way to them.
#include "pictures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases.hpp"
#include "dice.hpp"
#include "plan/precision.hpp"

namespace orrery::extremes {

namespace {

/// A scene of anything at any size, `away` times its size or less from the origin.
Scene wild(Dice& dice, double away) {
    const double size = dice.scale(1e-5, 1e6);
    Scene scene = picture({0, 0, 0}, {0, 0, 1}, dice.between(1, 170), 8, 12);
    scene.settings.samples = 4;
    scene.settings.seed = static_cast<std::uint32_t>(dice.integer(0, 1 << 30));
    const Double3 place = dice.direction() * (dice.coin() ? 0 : size * dice.scale(1, away));
    const auto at = [&](double reach) {
        const Double3 v = place + dice.direction() * reach;
        return dvec3{v.x, v.y, v.z};
    };
    scene.camera.position = at(size);
    scene.camera.target = at(size * 0.5);
    scene.camera.aperture = dice.coin() ? 0 : size * dice.scale(1e-8, 1);
    scene.camera.focal_distance = size * dice.scale(1e-3, 1e3);
    if (scene.camera.position == scene.camera.target) scene.camera.target.z += 1;
    constexpr double etas[] = {1, 1 - 1e-7, 1 + 1e-7, 1e-3, 1e3, 1.5}, betas[] = {1e-8, 1e-3, 0.5, 0.999999};
    for (int i = 0; i < 20; ++i) {
        const double rho = dice.integer(0, 2) * 0.5;
        Material m{.id = "m", .kind = static_cast<MaterialKind>(dice.integer(0, 4)), .rho = dvec3{rho}};
        m.rho_t = dvec3{1 - rho};
        m.eta = etas[dice.integer(0, 5)];
        if (m.kind == MaterialKind::glossy || m.kind == MaterialKind::translucent)
            m.roughness = betas[dice.integer(0, 3)];
        auto& sphere = add_sphere(scene, at(size * dice.scale(1e-3, 10)), size * dice.scale(1e-6, 3), m);
        if (dice.integer(0, 3) == 0) sphere.emission = dvec3{dice.scale(1e-30, 1e12)};
    }
    if (dice.coin()) add_point_light(scene, at(size), dvec3{dice.scale(1e-30, 1e12)});
    scene.settings.integrator = dice.coin() ? Integrator::path_tracing : Integrator::whitted;
    scene.settings.transport = static_cast<Transport>(dice.integer(0, 2));
    scene.settings.light_sampling = static_cast<LightSampling>(dice.integer(0, 2));
    scene.settings.roulette = dice.coin();
    return scene;
}

/// Balls of every material on a floor, under two lamps. All lies on a grid of 1/16: moved by less than 2^20 everything
/// is in float where it should be to the last bit, and only what is computed from it is rounded more.
Scene still_life(Dice& dice, bool point_light) {
    const auto on_grid = [&](double low, double high) { return std::round(dice.between(low, high) * 16) / 16; };
    Scene scene = picture({on_grid(-2, 2), on_grid(1, 3), -6}, {0, 1, 0}, 45, 24, 5);
    scene.settings.samples = 64;
    scene.settings.estimator = Estimator::uniform;
    scene.settings.seed = static_cast<std::uint32_t>(dice.integer(0, 1 << 30));
    scene.background = {0.1, 0.2, 0.3};
    add_sphere(scene, {0, -40, 0}, 40, diffuse({0.8, 0.6, 0.4}));
    const Material kinds[] = {diffuse({0.3, 0.7, 0.6}), mirror(0.8), glossy(0.8, 0.3), glass(0.9, 1.5),
                              glass(0.9, 1.3, 0.2)};
    for (std::size_t i = 0; i < 10; ++i) {
        const double r = on_grid(0.25, 1);
        add_sphere(scene, {on_grid(-3, 3), r + (i < 5 ? 0 : on_grid(0, 2)), on_grid(-2, 3)}, r, kinds[i % 5]);
    }
    for (const double side : {-1, 1})
        add_lamp(scene, {side * 3, on_grid(4, 5), on_grid(-2, 2)}, on_grid(0.5, 1), {4, 3, 5});
    if (point_light) add_point_light(scene, {on_grid(-2, 2), 6, on_grid(-4, 0)}, {9, 8, 7});
    return scene;
}

// --- to the last bit ----------------------------------------------------------------------------------------------

void count_other_pixels(Errors& errors, const Image& image, const Image& other) {
    double count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgb &a = image.pixels[i], &b = other.pixels[i];
        count += a.r == b.r && a.g == b.g && a.b == b.b ? 0 : 1;
    }
    errors.add(count);
}

Scene backwards(Scene scene) {
    std::ranges::reverse(scene.primitives);
    std::ranges::reverse(scene.point_lights);
    return scene;
}

void scale(Errors& errors, Dice& dice, const Pipeline& how) {
    const Scene scene = wild(dice, 1e3);
    count_other_pixels(errors, render(scene, how).image, render(test::scaled(scene, dice.integer(-16, 16)), how).image);
}

/// Light that is only found by running into it does not know in which order it is listed; what is sampled does.
void list_backwards(Errors& errors, Dice& dice, const Pipeline& how) {
    Scene scene = dice.coin() ? wild(dice, 1e3) : test::crowd();
    scene.settings.integrator = dice.coin() ? Integrator::path_tracing : Integrator::depth;
    scene.settings.transport = Transport::naive;
    scene.point_lights.clear();
    count_other_pixels(errors, render(scene, how).image, render(backwards(scene), how).image);
}

/// Where nothing is reflected what shines is all there is.
void reflect_nothing(Errors& errors, Dice& dice, const Pipeline& how) {
    Scene scene = still_life(dice, true);
    for (Material& m : scene.materials) m.rho = m.rho_t = dvec3{0};
    const Image image = render(scene, how).image;
    scene.settings.depth = 0;
    count_other_pixels(errors, image, render(scene, how).image);
}

// --- up to rounding -----------------------------------------------------------------------------------------------

/// Where all is reflected in a white world all is white, in roundings of float.
void reflect_all(Errors& errors, Dice& dice, const Pipeline& how) {
    Scene scene = still_life(dice, false);
    for (Material& m : scene.materials) m.rho = m.rho_t = dvec3{1};
    for (Primitive& p : scene.primitives) p.emission.reset();
    scene.background = dvec3{1};
    scene.settings.depth = 10000;
    scene.settings.roulette = false;
    scene.settings.samples = 16;
    for (const Rgb& p : render(scene, how).image.pixels)
        for (const float x : {p.r, p.g, p.b}) errors.add(std::abs(double{x} - 1) / rounding_unit<float>);
}

/// The same paths from a world moved away: by how much the picture is another, the root of its MRSE in percent. A
/// sample that rounding takes past the rim of something sees something else, which is most of it.
void move(Errors& errors, Dice& dice, const Pipeline& how, double far) {
    const Scene scene = still_life(dice, true);
    Scene moved = scene;
    const dvec3 by{far, -far, far};
    moved.camera.position += by;
    moved.camera.target += by;
    for (Primitive& p : moved.primitives) p.centre += by;
    for (PointLight& light : moved.point_lights) light.position += by;
    // Balls as near to each other as roundings out there are one surface, as they should be: another picture.
    Scene listed = moved;
    listed.settings.precision = how.precision;
    if (Plan(std::move(listed)).scene().primitives.size() != scene.primitives.size()) return;
    const Image truth = render(scene, {how.mode, how.isa, Precision::binary64}).image, image = render(moved, how).image;
    // Where float is too coarse the planner says so, of a picture whose pixels are fine enough to see it.
    Scene finer = moved;
    finer.settings.width = finer.settings.height = 512;
    const bool warned = coarse_positions(finer, how.precision).has_value();
    double sum = warned == (far > 1e5 && how.precision == Precision::binary32) ? 0 : 1e30;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgb &a = truth.pixels[i], &b = image.pixels[i];
        for (const auto& [x, y] : {std::pair{a.r, b.r}, {a.g, b.g}, {a.b, b.b}})
            sum += (y - x) * (y - x) / (x * x + relative_floor);
    }
    errors.add(100 * std::sqrt(sum / static_cast<double>(3 * image.pixels.size())));
}

// --- in expectation -----------------------------------------------------------------------------------------------

struct Sums {
    double value = 0, variance = 0;
};

/// Of 8 x 8 pixels each, in the order of the blocks; columns or rows from the far side where they are flipped.
std::vector<Sums> sums_of_blocks(const RenderResult& result, bool flip_columns = false, bool flip_rows = false) {
    const std::uint32_t size = result.image.width, blocks = size / 8;
    std::vector<Sums> sums(blocks * blocks);
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const std::uint32_t column = flip_columns ? size - 1 - x : x, row = flip_rows ? size - 1 - y : y;
            Sums& sum = sums[y / 8 * blocks + x / 8];
            sum.value += double{result.image.at(column, row).g};
            const double error = double{result.standard_error.at(column, row).g};
            sum.variance += error * error;
        }
    }
    return sums;
}

/// Standard errors between pictures that are to have the same expectation. Where there is nothing but background the
/// rounding of a pixel is all the error there is.
void compare(Errors& errors, const std::vector<Sums>& one, const std::vector<Sums>& other) {
    for (std::size_t i = 0; i < one.size(); ++i) {
        const double rounding = 2 * rounding_unit<float> * one[i].value;
        errors.add(std::abs(one[i].value - other[i].value) /
                   std::sqrt(one[i].variance + other[i].variance + rounding * rounding));
    }
}

void mirror_world(Errors& errors, Dice& dice, const Pipeline& how) {
    const Scene scene = still_life(dice, dice.coin());
    Scene other = scene;
    const int axes = dice.integer(1, 7);
    const auto mirrored = [=](dvec3& v) {
        for (int k = 0; k < 3; ++k)
            if ((axes >> k & 1) != 0) v[k] = -v[k];
    };
    mirrored(other.camera.position), mirrored(other.camera.target);
    for (Primitive& p : other.primitives) mirrored(p.centre);
    for (PointLight& light : other.point_lights) mirrored(light.position);
    other.settings.seed += 1;
    const bool columns = ((axes ^ axes >> 2) & 1) != 0, rows = (axes & 2) != 0;
    compare(errors, sums_of_blocks(render(scene, how)), sums_of_blocks(render(other, how), columns, rows));
}

void list_lights_backwards(Errors& errors, Dice& dice, const Pipeline& how) {
    const Scene scene = still_life(dice, dice.coin());
    Scene other = backwards(scene);
    other.settings.seed += 1;
    compare(errors, sums_of_blocks(render(scene, how)), sums_of_blocks(render(other, how)));
}

void split_samples(Errors& errors, Dice& dice, const Pipeline& how) {
    Scene scene = still_life(dice, dice.coin());
    const auto whole = sums_of_blocks(render(scene, how));
    std::vector<Sums> sum(whole.size());
    constexpr std::uint32_t parts = 4;
    scene.settings.samples /= parts;
    for (std::uint32_t i = 0; i < parts; ++i) {
        ++scene.settings.seed;
        const auto part = sums_of_blocks(render(scene, how));
        for (std::size_t k = 0; k < sum.size(); ++k) {
            sum[k].value += part[k].value / parts;
            sum[k].variance += part[k].variance / (parts * parts);
        }
    }
    compare(errors, whole, sum);
}

void smooth_out(Errors& errors, Dice& dice, const Pipeline& how) {
    Scene scene = still_life(dice, false);
    for (Material& m : scene.materials) {
        if (m.kind == MaterialKind::glossy) m.roughness = 0, m.kind = MaterialKind::specular;
        if (m.kind == MaterialKind::translucent) m.roughness = 0, m.kind = MaterialKind::dielectric;
    }
    const auto smooth = sums_of_blocks(render(scene, how));
    for (Material& m : scene.materials) {
        if (m.kind == MaterialKind::diffuse) continue;
        m.roughness = 1e-8;
        m.kind = m.kind == MaterialKind::specular ? MaterialKind::glossy : MaterialKind::translucent;
    }
    ++scene.settings.seed;
    compare(errors, smooth, sums_of_blocks(render(scene, how)));
}

// --- numbers ------------------------------------------------------------------------------------------------------

/// Pixels that are no numbers, and samples dropped where none should be.
void render_wild_scenes(Errors& errors, Dice& dice, const Pipeline& how, std::uint64_t scenes, double away,
                        bool may_drop) {
    for (std::uint64_t i = 0; i < scenes; ++i) {
        const auto result = render(wild(dice, away), how);
        double lost = may_drop ? 0 : static_cast<double>(result.stats.dropped_samples);
        for (const Rgb& p : result.image.pixels)
            lost += std::isfinite(p.r + p.g + p.b) && std::min({p.r, p.g, p.b}) >= 0 ? 0 : 1;
        errors.add(lost, [&] { return fmt::format("scene {}", i); });
    }
}

}  // namespace

void add_pictures(std::vector<Case>& cases) {
    for (const Pipeline& how : pipelines()) {
        const auto add = [&](const std::string& name, const char* unit, double limit, std::uint64_t trials,
                             const auto& trial) {
            cases.push_back({"pictures", name, how.mode, unit, limit, trials,
                             [trial, how](Errors& errors, std::uint64_t count, Dice& dice) {
                                 for (std::uint64_t i = 0; i < count; ++i) trial(errors, dice, how);
                             }});
        };
        const bool twofold = how.precision == Precision::binary64;
        add("scaled by 2^-16 to 2^16", "other pixels", 0, 30, scale);
        add("listed backwards, light as it is met", "other pixels", 0, 30, list_backwards);
        add("listed backwards", "standard errors", 5, 6, list_lights_backwards);
        add("mirrored", "standard errors", 5, 6, mirror_world);
        add("samples in four parts of other seeds", "standard errors", 5, 6, split_samples);
        add("roughness 1e-8 for none", "standard errors", 5, 6, smooth_out);
        for (const double far : {1e3, 1e6})
            add(fmt::format("moved by {:g} along every axis", far), "%",
                twofold     ? 1e-4
                : far < 1e4 ? 5
                            : 30,
                6, [=](Errors& errors, Dice& dice, const Pipeline& pipeline) { move(errors, dice, pipeline, far); });
        add("rho 0", "other pixels", 0, 2, reflect_nothing);
        add("rho 1 in a white world", "u", 10, 2, reflect_all);
        const auto add_wild = [&](const char* name, const char* unit, double away, bool may_drop) {
            cases.push_back(
                {"pictures", name, how.mode, unit, 0, 60, [=](Errors& errors, std::uint64_t scenes, Dice& dice) {
                     render_wild_scenes(errors, dice, how, scenes, away, may_drop);
                 }});
        };
        add_wild("of anything at any size", "samples dropped, pixels not finite", 1e3, false);
        // Up to where all coordinates are the same number: samples that are no number are dropped and counted.
        add_wild("lost in rounding", "pixels not finite", 1e13, true);
    }
}

}  // namespace orrery::extremes
