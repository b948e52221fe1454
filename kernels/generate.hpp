// Stage `generate`: camera -> ray queue, one ray per slot.
#pragma once

#include "kernels/sampling.hpp"
#include "kernels/vertex.hpp"

namespace orrery::kernels {

/// A thin lens of radius lens_radius: the pinhole ray's point on the plane in focus is kept, its origin moves over the
/// lens. (x, y) is the pinhole ray's point on the image plane at distance 1.
template <class V, bool has_lens>
ORRERY_INLINE void camera_ray(const CameraTable<RealOf<V>>& camera, const Floats<V>& x, const Floats<V>& y,
                              const RandomNumbers<Floats<V>>& random, Vec3Of<V>& origin, Vec3Of<V>& direction) {
    using F = Floats<V>;
    const Vec3<F> right{F(camera.xx), F(camera.xy), F(camera.xz)};
    const Vec3<F> up{F(camera.yx), F(camera.yy), F(camera.yz)};
    origin = {F(camera.px), F(camera.py), F(camera.pz)};
    direction = along(along(Vec3<F>{F(camera.zx), F(camera.zy), F(camera.zz)}, x, right), y, up);
    if constexpr (has_lens) {
        const auto lens = sample_disk<V>(random.z, random.w);
        const F lx = F(camera.lens_radius) * lens.cos;
        const F ly = F(camera.lens_radius) * lens.sin;
        origin = along(along(origin, lx, right), ly, up);
        // (focus point - lens point) / focal distance
        const F inverse(RealOf<V>(1) / camera.focal_distance);
        direction = along(along(direction, F(0) - lx * inverse, right), F(0) - ly * inverse, up);
    }
    direction = unit(direction);
}

template <class V, bool has_lens>
void generate(const CameraTable<RealOf<V>>& camera, const Slots<V>& slots, std::uint32_t count, std::uint32_t seed,
              const Rays<V>& rays) {
    using F = Floats<V>;
    using U = Words<V>;
    using Word = WordOf<RealOf<V>>;
    const RandomKey key{seed, Dimension::camera, 0};
    constexpr int dimensions = has_lens ? 4 : 2;
    const bool sobol = slots.sobol.x != nullptr;
    if (sobol) {
        for (std::uint32_t i = 0; i < count; i += V::count)
            save(rays.sample + i, reversed_bits(load<U>(slots.sample + i)));
        draw_sobol<V, dimensions>(slots, {slots.pixel, rays.sample, nullptr}, {0, count}, key, 0);
    }
    const F zero(0), one(1);
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const U pixel = load<U>(slots.pixel + i);
        const U sample = load<U>((sobol ? rays.sample : slots.sample) + i);
        const auto random =
            sobol ? drawn<V, dimensions>(slots.sobol, i) : random_block<V>(key, pixel, sample, U(Word{0}));
        const F x = mul_add(random.x, F(camera.cell_width), load<F>(slots.plane_x + i));
        const F y = mul_add(random.y, F(camera.cell_height), load<F>(slots.plane_y + i));
        Vec3<F> o, d;
        camera_ray<V, has_lens>(camera, x, y, random, o, d);
        save3<V>(rays.ox + i, rays.oy + i, rays.oz + i, o);
        save3<V>(rays.dx + i, rays.dy + i, rays.dz + i, d);
        save3<V>(rays.tr + i, rays.tg + i, rays.tb + i, {one, one, one});
        // What the camera sees of a light competes with no light sample.
        if (rays.pdf != nullptr) save(rays.pdf + i, F(std::numeric_limits<RealOf<V>>::infinity()));
        if (rays.roulette_scale != nullptr) save(rays.roulette_scale + i, one);
        save(rays.departed + i, U(Word{no_sphere}));
        save(rays.slot + i, consecutive<V>(i));
        save(rays.pixel + i, pixel);
        save(rays.sample + i, sample);
        if (rays.vertex != nullptr) save(rays.vertex + i, U(Word{1}));
        for (std::uint32_t c = 0; c < 4; ++c) save(slots.radiance + 4 * i + c * V::count, zero);
    }
}

}  // namespace orrery::kernels
