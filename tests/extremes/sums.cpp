// Sums: of more samples than float could count, of numbers that dwarf each other, of ten thousand reflections, of ten
// thousand lights.
#include <fmt/format.h>

#include "cases.hpp"
#include "dice.hpp"
#include "film/film.hpp"
#include "pictures.hpp"

namespace orrery::extremes {

namespace {

constexpr double u = rounding_unit<float>;

/// Samples are multiples of 2^-24, so that their sum is an integer.
void add_up(Errors& errors, std::uint64_t samples) {
    Film film(1, 1);
    std::uint64_t sum = 0, random = 1;
    for (std::uint64_t i = 0; i < samples; ++i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const auto sample = static_cast<std::uint32_t>(random >> 40);
        sum += sample;
        const float x = static_cast<float>(sample) * 0x1p-24f;
        film.add(0, x, x, x);
    }
    const long double exact = static_cast<long double>(sum) / static_cast<long double>(samples) * 0x1p-24L;
    errors.add(static_cast<double>(std::abs(static_cast<long double>(film.mean().pixels[0].r) / exact - 1) / u));
}

void add_one_giant(Errors& errors, std::uint64_t samples) {
    Film film(1, 1);
    const auto rest = samples - 1;
    for (std::uint64_t i = 0; i < samples; ++i) {
        const float x = i == samples / 2 ? 1e30f : 0.25f;
        film.add(0, x, x, x);
    }
    const long double exact =
        (static_cast<long double>(1e30f) + 0.25L * static_cast<long double>(rest)) / static_cast<long double>(samples);
    errors.add(static_cast<double>(std::abs(static_cast<long double>(film.mean().pixels[0].r) / exact - 1) / u));
}

/// The worst relative error of a picture whose pixels are all to have one value.
void expect(Errors& errors, const Image& image, double exact, double unit) {
    for (const Rgb& pixel : image.pixels)
        for (const float x : {pixel.r, pixel.g, pixel.b}) errors.add(std::abs(double{x} / exact - 1) / unit);
}

/// In a closed box that reflects everything each of the 10 001 vertices of a path adds what the box emits.
void reflect_ten_thousand_times(Errors& errors, const Pipeline& how, const Material& material, double radiance) {
    Scene scene = picture({0.3, 0.2, -0.4}, {0.1, 0.9, 0.3}, 90, 4, 10000);
    add_lamp(scene, {0.1, -0.1, 0}, 1.5, dvec3{radiance}, material);
    scene.settings.roulette = false;
    scene.settings.transport = Transport::naive;
    scene.settings.samples = 4;
    expect(errors, render(scene, how).image, 10001 * radiance, u);
}

/// A floor lit by `count` point lights at one place, which share what one would have.
Image lit_by(std::uint32_t count, const Pipeline& how) {
    Scene scene = picture({0, 2, -6}, {0, 0.7, 0}, 36, 4, 1);
    scene.settings.samples = 1;
    add_sphere(scene, {0, -40, 0}, 40, diffuse(dvec3{0.8}));
    for (std::uint32_t i = 0; i < count; ++i) add_point_light(scene, {1, 3, -2}, dvec3{50.0 / count});
    return render(scene, how).image;
}
void share_among_lights(Errors& errors, const Pipeline& how) {
    const Image one = lit_by(1, how), many = lit_by(10000, how);
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        if (one.pixels[i].r == 0 && many.pixels[i].r == 0) continue;
        errors.add(std::abs(double{many.pixels[i].r} / double{one.pixels[i].r} - 1) / u);
    }
}

/// Lights whose powers differ by sixty orders of magnitude, each in a box of its own: the dark one is not lost.
void light_with_every_power(Errors& errors, const Pipeline& how) {
    for (const double power : {1e-30, 1e30}) {
        for (const bool other : {false, true}) {
            Scene scene = picture({0, 0, -0.5}, {0, 0, 0}, 60, 4, 1);
            add_sphere(scene, {0, 0, 0}, 1, diffuse(dvec3{0.5}));
            add_point_light(scene, {0, 0, 0}, dvec3{power});
            if (other) add_point_light(scene, {0, 0, 7}, dvec3{1e30});  // outside
            // From the centre every point is lit alike: rho / pi I / r^2.
            expect(errors, render(scene, how).image, 0.5 / std::numbers::pi * power, u);
        }
    }
}

}  // namespace

void add_sums(std::vector<Case>& cases) {
    const auto add = [&](const char* name, const char* mode, const char* unit, double limit, std::uint64_t trials,
                         std::function<void(Errors&, std::uint64_t, Dice&)> run) {
        cases.push_back({"sums", name, mode, unit, limit, trials, std::move(run)});
    };
    add("2^26 samples of one pixel", "all", "u", 1, 1,
        [](Errors& errors, std::uint64_t, Dice&) { add_up(errors, 1 << 26); });
    add("one sample of 1e30 among 2^20", "all", "u", 1, 1,
        [](Errors& errors, std::uint64_t, Dice&) { add_one_giant(errors, 1 << 20); });
    // A sample's radiance is summed in float: ten thousand terms that are no round numbers may add up half a rounding
    // each, 3e-4 in all.
    for (const Pipeline& how : pipelines()) {
        const double terms = how.precision == Precision::binary32 ? 5000 : 1;
        add("10 000 diffuse reflections, rho 1", how.mode, "u", 0, 1, [=](Errors& errors, std::uint64_t, Dice&) {
            reflect_ten_thousand_times(errors, how, diffuse(dvec3{1}), 1);
        });
        add("10 000 diffuse reflections, rho 1, radiance 0.1", how.mode, "u", terms, 1,
            [=](Errors& errors, std::uint64_t, Dice&) {
                reflect_ten_thousand_times(errors, how, diffuse(dvec3{1}), 0.1);
            });
        add("10 000 mirror reflections, rho 1", how.mode, "u", 0, 1,
            [=](Errors& errors, std::uint64_t, Dice&) { reflect_ten_thousand_times(errors, how, mirror(1), 1); });
        add("10 000 lights for one", how.mode, "u", terms, 1,
            [=](Errors& errors, std::uint64_t, Dice&) { share_among_lights(errors, how); });
        add("powers of 1e-30 and 1e30", how.mode, "u", 8, 1,
            [=](Errors& errors, std::uint64_t, Dice&) { light_with_every_power(errors, how); });
    }
}

}  // namespace orrery::extremes
