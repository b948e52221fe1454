// Cameras: the narrowest and the widest views, up and down, far away, and pictures of one pixel and of 65536.
#include <fmt/format.h>

#include "backward_error.hpp"
#include "cases.hpp"
#include "kernels/generate.hpp"
#include "pictures.hpp"

namespace orrery::extremes {

namespace {

Wide3 widen(const dvec3& v) { return {static_cast<Wide>(v.x), static_cast<Wide>(v.y), static_cast<Wide>(v.z)}; }
Wide3 cross(const Wide3& a, const Wide3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Directions of a pinhole's rays, in roundings of 1, given points of the image plane.
template <class V>
void look(Errors& errors, Dice& dice, double fov, double aspect, const dvec3& position, const dvec3& ahead) {
    using Real = typename V::Real;
    using F = typename V::F;
    Scene scene = picture(position, position + ahead, fov, 16, 0);
    scene.camera.aspect = aspect;
    scene.settings.precision = sizeof(Real) == 4 ? Precision::binary32 : Precision::binary64;
    const Plan plan(scene);
    const Wide3 z = unit(widen(scene.camera.target) - widen(scene.camera.position));
    const bool along_up = z.x == 0 && z.z == 0;
    const Wide3 up = along_up ? Wide3{0, 0, 1} : Wide3{0, 1, 0};
    const Wide3 x = unit(cross(up, z)), y = cross(z, x);
    for (int i = 0; i < 100; ++i) {
        const auto px = static_cast<Real>(dice.between(-1, 1) * plan.half_width());
        const auto py = static_cast<Real>(dice.between(-1, 1) * plan.half_height());
        kernels::Vec3<F> origin, direction;
        kernels::camera_ray<V, false>(plan.tables<Real>().camera, F(px), F(py), {}, origin, direction);
        const Wide3 exact = unit(static_cast<Wide>(px) * x + static_cast<Wide>(py) * y + z);
        errors.add(static_cast<double>(length(extremes::widen(first_lanes<V>(direction)) - exact) /
                                       static_cast<Wide>(rounding_unit<Real>)));
    }
}

/// A ball from afar through `width` by `height` pixels, as DEPTH sees it: by how much a distance lies outside of what
/// the corners of its pixel allow. Pixels are so small that the rim is all that is no function of the corners.
void measure_a_ball(Errors& errors, const Pipeline& how, std::uint32_t width, std::uint32_t height) {
    Scene scene = picture({0, 0, -5}, {0, 0, 0}, 20, 1, 0);
    scene.settings.width = width;
    scene.settings.height = height;
    scene.settings.samples = 1;
    scene.settings.integrator = Integrator::depth;
    scene.camera.aspect = double{1} * width / height;
    if (width > height) scene.camera.fov = 20.0 / width;
    add_sphere(scene, {0, 0, 0}, 1, diffuse(dvec3{0.5}));
    const Plan plan(scene);
    const Image image = render(scene, how).image;
    const auto distance = [&](double column, double row) {
        const double x = (2 * column / width - 1) * plan.half_width(), y = (1 - 2 * row / height) * plan.half_height();
        const double a = x * x + y * y + 1, b = 5, c = 24;
        const double disc = b * b - a * c;
        return disc < 0 ? -1 : (b - std::sqrt(disc)) / a * std::sqrt(a);
    };
    for (std::uint32_t row = 0; row < height; ++row) {
        for (std::uint32_t column = 0; column < width; ++column) {
            double low = 1e30, high = 0;
            for (const double c : {0.0, 1.0, std::clamp(0.5 * width - column, 0.0, 1.0)}) {
                for (const double r : {0.0, 1.0, std::clamp(0.5 * height - row, 0.0, 1.0)}) {
                    const double d = distance(column + c, row + r);
                    low = std::min(low, d < 0 ? 0 : d), high = std::max(high, d < 0 ? 1e30 : d);
                }
            }
            const double seen = 1 / double{image.at(column, row).r} - 1;  // I' = 1 - I / (1 + I)
            const double off = std::max({0.0, low - seen, high > 1e29 ? 0 : seen - high});
            errors.add(off / ((1 + seen) * (1 + seen) * rounding_unit<float>),
                       [&] { return fmt::format("pixel {}, {}: {} of {} to {}", column, row, seen, low, high); });
        }
    }
}

}  // namespace

void add_camera(std::vector<Case>& cases) {
    const auto add = [&]<class V>(const char* name, double fov, double aspect, const dvec3& position,
                                  const dvec3& ahead, V) {
        cases.push_back(
            {"camera", name, mode_name<V>(), "u", 4, 10, [=](Errors& errors, std::uint64_t trials, Dice& dice) {
                 for (std::uint64_t i = 0; i < trials; ++i) look<V>(errors, dice, fov, aspect, position, ahead);
             }});
    };
    const auto add_all = [&]<class V>(V v) {
        const dvec3 here{1, 2, 3}, ahead{0.3, -0.2, 1};
        add("fov 1e-3", 1e-3, 1, here, ahead, v);
        add("fov 179.9", 179.9, 1, here, ahead, v);
        add("aspect 1e-3", 45, 1e-3, here, ahead, v);
        add("aspect 1e3", 45, 1e3, here, ahead, v);
        add("fov 179.9, aspect 1e3", 179.9, 1e3, here, ahead, v);
        add("straight up", 45, 1, here, {0, 1, 0}, v);
        add("straight down", 45, 1, here, {0, -1, 0}, v);
        add("up but for 1e-7", 45, 1, here, {1e-7, 1, 0}, v);
        add("1e8 from the origin", 45, 1, {1e8, -1e8, 1e8}, ahead, v);
    };
    for_each_mode([&]<class V>() { add_all(V{}); });
    for (const Pipeline& how : pipelines()) {
        const auto add_size = [&](std::uint32_t width, std::uint32_t height) {
            cases.push_back(
                {"camera", fmt::format("distances through {} x {} pixels", width, height), how.mode, "u (1 + d)^2", 1,
                 1, [=](Errors& errors, std::uint64_t, Dice&) { measure_a_ball(errors, how, width, height); }});
        };
        add_size(1, 1);
        add_size(65536, 1);
        add_size(1, 65536);
    }
}

}  // namespace orrery::extremes
