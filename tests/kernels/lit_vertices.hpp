// Vertices as `scatter` leaves them for the stages that connect them with lights.
#pragma once

#include <span>

#include "geometry.hpp"
#include "numbers.hpp"
#include "owned.hpp"

namespace orrery::kernel_tests {

struct LitVertices {
    static constexpr std::uint32_t begin = 16;  ///< of the run
    Rays rays;
    Lobes lobes;
    std::uint32_t count;
};

/// On all spheres of a world and on both sides, but only inside the one that is `around` the others; every fifth dead.
inline LitVertices lit_vertices(const World& world, std::span<const glm::dvec3> lights, std::uint32_t count,
                                std::uint32_t around = kernels::no_sphere) {
    constexpr std::uint32_t begin = LitVertices::begin;
    const std::uint32_t capacity = begin + kernels::padded_run(count) + 16;
    LitVertices w{Rays(capacity), Lobes(capacity), count};
    Numbers random(count);
    for (std::uint32_t i = begin; i < begin + count; ++i) {
        const std::uint32_t k = random.below(world.spheres.count);
        const bool inward = i % 3 == 0 || k == around;
        const glm::dvec3 outward = random.direction(), n = inward ? -outward : outward;
        put_ray(*w.rays, i, world.centre(k) + world.radius(k) * outward, random.direction(),
                inward ? k | kernels::inside_bit : k, i % 5 == 4 ? glm::dvec3(0) : random.colour());
        w.rays->slot[i] = 5000 - i;
        glm::dvec3 lobe = random.direction();
        if (glm::dot(lobe, n) < 0) lobe = -lobe;
        // Half of the lobes look where a light is, or a narrow one would hardly ever see it.
        const auto which = lights.size() > 1 ? random.below(static_cast<std::uint32_t>(lights.size())) : 0;
        const glm::dvec3& light = lights[which];
        const glm::dvec3 to = glm::normalize(light - origin_of(*w.rays, i));
        if (i % 2 == 0 && glm::dot(to, n) > 0) lobe = glm::normalize(to + 0.03 * random.direction());
        put3(w.lobes->x, w.lobes->y, w.lobes->z, i, lobe);
    }
    return w;
}

}  // namespace orrery::kernel_tests
