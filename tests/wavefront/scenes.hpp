// Scenes built in code, in the words the tests use.
#pragma once

#include <cmath>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "reference/small_scenes.hpp"
#include "wavefront/render.hpp"

namespace orrery::test {

using glm::dvec3;
using reference::add_sphere;
using reference::diffuse;
using reference::glass;
using reference::glossy;
using reference::mirror;

/// A camera that looks from `eye` to `target`, and nothing to see.
inline Scene picture(const dvec3& eye, const dvec3& target, double fov, std::uint32_t depth) {
    Scene scene;
    scene.camera.position = eye;
    scene.camera.target = target;
    scene.camera.fov = fov;
    scene.settings.width = scene.settings.height = 16;
    scene.settings.depth = depth;
    scene.settings.roulette_from = 0;  // so that short paths meet it too
    return scene;
}

/// A coloured version of a material, so that swapped channels and swapped reflectances show.
inline Material tinted(Material material, const dvec3& rho, const dvec3& rho_t = dvec3{0}) {
    material.rho = rho;
    material.rho_t = rho_t;
    return material;
}

/// An emissive sphere that also reflects.
inline Primitive& add_lamp(Scene& scene, const dvec3& centre, double radius, const dvec3& radiance,
                           const Material& material = diffuse(dvec3{0.4})) {
    Primitive& lamp = add_sphere(scene, centre, radius, material);
    lamp.emission = radiance;
    return lamp;
}

inline void add_point_light(Scene& scene, const dvec3& position, const dvec3& intensity) {
    scene.point_lights.push_back({"point", position, intensity});
}

/// A ball of some material beside a small diffuse one, on a diffuse floor; no light yet.
inline Scene still_life(const Material& material, std::uint32_t depth = 4) {
    Scene scene = picture({0, 2, -6}, {0, 0.7, 0}, 36, depth);
    add_sphere(scene, {0, -40, 0}, 40, diffuse({0.8, 0.6, 0.4}));
    add_sphere(scene, {-0.5, 1, 0}, 1, material);
    add_sphere(scene, {1.2, 0.5, -0.6}, 0.5, diffuse({0.3, 0.7, 0.6}));
    return scene;
}

/// Noise from a lamp and a glossy ball: `size` by `size` pixels.
inline Scene noisy(std::uint32_t depth, std::uint32_t size) {
    Scene scene = still_life(glossy(0.8, 0.3), depth);
    add_lamp(scene, {-1.5, 4, -1}, 0.8, {8, 7, 6});
    scene.background = {0.1, 0.2, 0.3};
    scene.settings.width = scene.settings.height = size;
    return scene;
}

/// Edges are all the error there is: `size` by `size` pixels.
inline Scene edges(std::uint32_t size) {
    Scene scene = still_life(glass(0.9, 1.5), 6);
    add_point_light(scene, {-3, 5, -3}, {90, 80, 70});
    scene.background = {0.3, 0.4, 0.5};
    scene.settings.integrator = Integrator::whitted;
    scene.settings.width = scene.settings.height = size;
    return scene;
}

/// One of everything the program knows, some of it twice: every material, every light, overlapping and nested spheres,
/// a lens. What no setting may change is tested on this.
inline Scene everything(Integrator integrator = Integrator::path_tracing) {
    Scene scene = still_life(glass(0.9, 1.5), 8);
    add_sphere(scene, {-0.5, 1, 0}, 0.5, tinted(glass(0, 0.8), {0.9, 0.8, 0.7}, {0.7, 0.8, 0.9}));  // nested
    add_sphere(scene, {0.9, 1.4, 0.8}, 0.7, tinted(mirror(0), {0.9, 0.7, 0.5}));
    add_sphere(scene, {1.5, 1.2, 0.9}, 0.5, glossy(0.8, 0.3));  // overlaps the mirror
    add_sphere(scene, {-1.9, 0.6, -0.3}, 0.6, glass(0.95, 1.3, 0.2));
    add_lamp(scene, {-1.5, 3.5, -1}, 0.7, {4, 3, 5});
    add_lamp(scene, {0.3, 0.25, -1.6}, 0.25, {2, 5, 3}, glass(0.8, 1.4));  // touches the floor
    add_lamp(scene, {2.6, 0.8, 0.5}, 0.6, {1, 0.5, 0.2}, mirror(0.6));
    add_point_light(scene, {2, 4, -3}, {9, 8, 7});
    add_point_light(scene, {-0.2, 1.1, 0.1}, {1, 2, 3});  // inside both glasses
    scene.background = {0.1, 0.2, 0.3};
    scene.camera.aperture = 0.2;
    scene.camera.focal_distance = 6;
    scene.settings.integrator = integrator;
    scene.settings.samples = 4;
    return scene;
}

/// Spheres by the hundred, so that whatever the plan does about many of them is done: heaps and loners, beads and a
/// floor, every material, some lights.
inline Scene crowd(Integrator integrator = Integrator::path_tracing) {
    Scene scene = picture({0, 2.5, -7}, {0, 0.8, 0}, 40, 5);
    add_sphere(scene, {0, -200, 0}, 200, diffuse({0.8, 0.7, 0.6}));
    const Material kinds[] = {diffuse({0.7, 0.4, 0.2}), glossy(0.8, 0.3), mirror(0.8), glass(0.9, 1.5),
                              glass(0.9, 1.3, 0.2)};
    std::uint32_t state = 7;  // any sequence will do
    const auto uniform = [&state] { return (state = state * 1664525u + 1013904223u) / 4294967296.0; };
    for (std::size_t i = 0; i < 300; ++i) {
        const bool heap = i % 3 != 0;
        const double spread = heap ? 0.8 : 5;
        const dvec3 at{(uniform() - 0.5) * spread, uniform() * (heap ? 1.2 : 3), (uniform() - 0.5) * spread};
        add_sphere(scene, at, 0.03 + 0.15 * uniform() * uniform(), kinds[i % 5]);
        if (i % 50 == 0) scene.primitives.back().emission = dvec3{5, 4, 3};
    }
    add_lamp(scene, {2, 4, -2}, 1, {4, 3, 5});
    scene.background = {0.1, 0.2, 0.3};
    scene.settings.integrator = integrator;
    scene.settings.samples = 4;
    return scene;
}

/// All lengths times 2^k. Radiance does not care; a point light's intensity must grow with the square of the distance.
inline Scene scaled(Scene scene, int k) {
    const double s = std::ldexp(1.0, k);
    scene.camera.position *= s;
    scene.camera.target *= s;
    scene.camera.focal_distance *= s;
    scene.camera.aperture *= s;
    for (Primitive& p : scene.primitives) {
        p.centre *= s;
        p.radius *= s;
    }
    for (PointLight& light : scene.point_lights) {
        light.position *= s;
        light.intensity *= s * s;
    }
    return scene;
}

inline constexpr std::initializer_list<Integrator> all_integrators = {Integrator::path_tracing, Integrator::whitted,
                                                                      Integrator::depth};

inline std::string name_of(Integrator integrator) {
    return integrator == Integrator::path_tracing ? "PT" : integrator == Integrator::whitted ? "WRT" : "DEPTH";
}

inline std::vector<Isa> supported_isas() {
    std::vector<Isa> isas;
    for (const Isa isa : all_isas)
        if (isa_supported(isa)) isas.push_back(isa);
    return isas;
}

/// RenderOptions of which a test names those it is about.
struct How {
    unsigned threads = 0;
    Isa isa = best_isa();
    std::uint32_t wave_size = 0;
    std::function<void(double, std::uint64_t)> progress = {};
    std::function<bool()> interrupted = {};
};

inline RenderResult render(const Scene& scene, const How& how = {}) {
    return orrery::render(Plan(scene), {how.threads, how.isa, how.wave_size, how.progress, how.interrupted});
}

inline Image image_of(const Scene& scene, const How& how = {}) { return render(scene, how).image; }

}  // namespace orrery::test
