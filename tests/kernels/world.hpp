// Tables from plain structs: spheres, materials, lights. What lies behind the last entry is poison.
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "kernels/queues.hpp"
#include "kernels/sphere.hpp"

namespace orrery::kernel_tests {

struct Ball {
    glm::dvec3 centre{0};
    double radius = 1;
    std::uint32_t material = 0;
    int light = -1;  ///< index of what it emits, -1 for nothing
};

/// A point light.
struct Point {
    glm::dvec3 place, intensity;
};

struct Surface {
    kernels::Scattering kind = kernels::Scattering::diffuse;
    glm::dvec3 rho{0.5};
    glm::dvec3 tau{0.5};
    double eta = 1.5;
    double beta = 0.3;
};

/// Owns what the kernels' tables point to. The numbers are rounded to float once, and read back from the tables by the
/// scalar code the kernels are compared with.
class World {
public:
    explicit World(const std::vector<Ball>& balls, const std::vector<Surface>& surfaces = {Surface{}},
                   const std::vector<glm::dvec3>& radiances = {}, const std::vector<Point>& points = {}) {
        const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
        for (auto& column : lights_) column.resize(points.size() + radiances.size());
        words_[2].resize(points.size() + radiances.size(), kernels::no_sphere);
        const auto put_light = [&](std::size_t at, const glm::dvec3& place, double radius, const glm::dvec3& colour) {
            for (std::size_t c = 0; c < 3; ++c) {
                lights_[c][at] = static_cast<float>(place[static_cast<int>(c)]);
                lights_[4 + c][at] = static_cast<float>(colour[static_cast<int>(c)]);
            }
            lights_[3][at] = static_cast<float>(radius);
        };
        for (std::size_t i = 0; i < points.size(); ++i) put_light(i, points[i].place, 0, points[i].intensity);
        for (const Ball& ball : balls) {
            push3(columns_, 0, ball.centre);
            const auto radius = static_cast<float>(ball.radius);
            columns_[3].push_back(radius);
            columns_[12].push_back(radius * radius);
            columns_[13].push_back(1 / radius);
            const auto kind = static_cast<std::uint32_t>(surfaces[ball.material].kind);
            words_[0].push_back(ball.material | kind << kernels::surface_material_bits |
                                (ball.light >= 0 ? kernels::surface_emits : 0));
            words_[1].push_back(ball.light < 0 ? 0 : count(points) + static_cast<std::uint32_t>(ball.light));
            if (ball.light < 0) continue;
            const auto& radiance = radiances[static_cast<std::size_t>(ball.light)];
            put_light(words_[1].back(), ball.centre, ball.radius, radiance);
            words_[2][words_[1].back()] = count(words_[0]) - 1;
        }
        for (const Surface& surface : surfaces) {
            push3(columns_, 4, surface.rho);
            push3(columns_, 7, surface.tau);
            columns_[10].push_back(static_cast<float>(surface.eta));
            columns_[11].push_back(static_cast<float>(surface.beta));
        }
        const auto pad = [](auto& columns) {
            for (auto& column : columns)
                column.resize(column.size() + kernels::widest, std::numeric_limits<float>::quiet_NaN());
        };
        pad(columns_), pad(lights_);
        for (auto& column : words_) column.resize(column.size() + kernels::widest, 0xFFB5EED5u);
        spheres.count = count(balls);
        spheres.cx = columns_[0].data(), spheres.cy = columns_[1].data(), spheres.cz = columns_[2].data();
        spheres.radius = columns_[3].data(), spheres.radius2 = columns_[12].data();
        spheres.inverse_radius = columns_[13].data();
        spheres.surface = words_[0].data(), spheres.light = words_[1].data();
        materials.count = count(surfaces);
        materials.rho_r = columns_[4].data(), materials.rho_g = columns_[5].data(),
        materials.rho_b = columns_[6].data();
        materials.tau_r = columns_[7].data(), materials.tau_g = columns_[8].data(),
        materials.tau_b = columns_[9].data();
        materials.eta = columns_[10].data(), materials.roughness = columns_[11].data();
        lights.points = count(points);
        lights.count = count(points) + count(radiances);
        lights.px = lights_[0].data(), lights.py = lights_[1].data(), lights.pz = lights_[2].data();
        lights.radius = lights_[3].data();
        lights.r = lights_[4].data(), lights.g = lights_[5].data(), lights.b = lights_[6].data();
        lights.sphere = words_[2].data();
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    kernels::SphereTable<float> spheres;
    kernels::MaterialTable<float> materials;
    kernels::LightTable<float> lights;
    kernels::Background<float> background;

    /// The numbers as the kernels see them.
    glm::dvec3 centre(std::uint32_t k) const { return {spheres.cx[k], spheres.cy[k], spheres.cz[k]}; }
    double radius(std::uint32_t k) const { return spheres.radius[k]; }

private:
    template <class Columns>
    static void push3(Columns& columns, std::size_t first, const glm::dvec3& v) {
        for (int c = 0; c < 3; ++c) columns[first + static_cast<std::size_t>(c)].push_back(static_cast<float>(v[c]));
    }

    std::array<std::vector<float>, 14> columns_;       // centre radius, rho tau eta beta, radius2 1/radius
    std::array<std::vector<float>, 7> lights_;         // position radius colour
    std::array<std::vector<std::uint32_t>, 3> words_;  // surface light, of lights the sphere
};

}  // namespace orrery::kernel_tests
