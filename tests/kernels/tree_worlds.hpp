// Worlds that are hard on a tree, and rays that are hard on both.
#pragma once

#include <functional>
#include <string>

#include "numbers.hpp"
#include "world.hpp"

namespace orrery::kernel_tests {

struct TreeWorld {
    std::string name;
    std::vector<Ball> balls;
};

inline std::vector<Ball> balls_of(std::uint32_t count, const std::function<Ball(std::uint32_t)>& make) {
    std::vector<Ball> balls;
    for (std::uint32_t i = 0; i < count; ++i) balls.push_back(make(i));
    return balls;
}

/// About as many hits as misses for rays aimed at random.
inline std::vector<Ball> scattered_balls(std::uint32_t count, std::uint64_t seed) {
    Numbers random(seed);
    const double radius = 4 / std::cbrt(count + 1.0);
    return balls_of(count, [&](std::uint32_t) { return Ball{random.point(10), radius * random.scale(0.3, 1.2)}; });
}

inline std::vector<TreeWorld> hard_worlds() {
    Numbers random(11);
    std::vector<TreeWorld> worlds;
    worlds.push_back({"clusters", balls_of(900, [&](std::uint32_t i) {
                          Numbers place(i % 9);
                          return Ball{place.point(10) + random.point(0.3), random.scale(0.01, 0.1)};
                      })});
    worlds.push_back({"shells in shells", balls_of(300, [](std::uint32_t i) {
                          return Ball{glm::dvec3(1, 2, 3), 0.1 * (i + 1)};
                      })});
    worlds.push_back({"the same place", balls_of(200, [](std::uint32_t) { return Ball{glm::dvec3(1, 2, 3), 1}; })});
    worlds.push_back({"every size", balls_of(700, [&](std::uint32_t) {
                          const double radius = random.scale(1e-4, 1e4);
                          return Ball{random.direction() * (1.2 * radius + random.between(0, 20)), radius};
                      })});
    worlds.push_back({"beads on a ground", balls_of(700, [&](std::uint32_t i) {
                          if (i == 350) return Ball{glm::dvec3(0, -1e4, 0), 1e4};
                          return Ball{random.point(10) * glm::dvec3(1, 0, 1) + glm::dvec3(0, 0.1, 0), 0.1};
                      })});
    worlds.push_back({"lattice", balls_of(512, [](std::uint32_t i) {
                          return Ball{glm::dvec3(i % 8, i / 8 % 8, i / 64) * 2.0 - 7.0, 0.5};
                      })});
    worlds.push_back({"a row, doubling", balls_of(100, [](std::uint32_t i) {
                          return Ball{glm::dvec3(std::exp2(0.25 * i), 0, 0), 0.05 * std::exp2(0.25 * i)};
                      })});
    worlds.push_back({"far from the origin", balls_of(300, [&](std::uint32_t) {
                          return Ball{glm::dvec3(1e5, -1e5, 3e4) + random.point(10), random.scale(0.1, 1)};
                      })});
    return worlds;
}

/// Puts ray i of many kinds: from free space, within and on spheres, aimed anywhere, at spheres, past their rims by a
/// hair, and along the axes.
class HardRays {
public:
    HardRays(const World& world, std::uint64_t seed) : world_(world), random_(seed) {}

    void operator()(std::uint32_t i, const RayView& rays) {
        const std::uint32_t from = some(), to = some();
        const glm::dvec3 n = random_.direction();
        glm::dvec3 o = world_.centre(from) + n * (world_.radius(from) * (i % 5 == 0 ? random_.uniform() : 1));
        const bool on = i % 5 > 1;
        if (i % 5 == 1) o += random_.point(10);
        glm::dvec3 d = random_.direction();
        if (i % 3 != 0) {  // at a sphere; every other one at its rim
            const glm::dvec3 axis = world_.centre(to) - o;
            const double aside = i % 2 == 0 ? random_.between(0.999, 1.001) : random_.uniform();
            d = axis + glm::cross(glm::normalize(axis + d), random_.direction()) * (world_.radius(to) * aside);
        }
        if (i % 11 == 0) d = along_axes[random_.below(10)];
        if (glm::length(d) == 0) d = n;
        const std::uint32_t side = glm::dot(d, n) > 0 ? 0 : kernels::inside_bit;
        put_ray(rays, i, o, d, on ? from | side : kernels::no_sphere);
    }

private:
    /// Negative zeros too: the sign chooses which planes are near.
    static constexpr glm::dvec3 along_axes[10] = {{1, 0, 0},     {-1, 0, 0},    {0, 1, 0}, {0, -1, -0.0},
                                                  {0, -0.0, 1},  {-0.0, 0, -1}, {1, 1, 0}, {-1, 0, 1e-30},
                                                  {1e-42, 1, 0}, {0, 1, -1}};
    std::uint32_t some() { return random_.below(world_.spheres.count); }

    const World& world_;
    Numbers random_;
};

}  // namespace orrery::kernel_tests
