// Input for the kernels: deterministic numbers, and items of queues as plain vectors.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "kernels/queues.hpp"
#include "support/random_numbers.hpp"

namespace orrery::kernel_tests {

class Numbers : public test::RandomNumbers {
public:
    using RandomNumbers::RandomNumbers;
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(uniform() * n); }
    glm::dvec3 direction() { return on_sphere<glm::dvec3>(); }
    glm::dvec3 point(double reach) { return {between(-reach, reach), between(-reach, reach), between(-reach, reach)}; }
    glm::dvec3 colour() { return {uniform(), uniform(), uniform()}; }
};

inline float narrow(double x) { return static_cast<float>(x); }

template <class Real>
void put3(Real* x, Real* y, Real* z, std::size_t i, const glm::dvec3& v) {
    x[i] = static_cast<Real>(v.x);
    y[i] = static_cast<Real>(v.y);
    z[i] = static_cast<Real>(v.z);
}
template <class Real>
glm::dvec3 get3(const Real* x, const Real* y, const Real* z, std::size_t i) {
    return {x[i], y[i], z[i]};
}

using RayView = kernels::RayQueue<float>;
inline glm::dvec3 origin_of(const RayView& q, std::size_t i) { return get3(q.ox, q.oy, q.oz, i); }
inline glm::dvec3 direction_of(const RayView& q, std::size_t i) { return get3(q.dx, q.dy, q.dz, i); }
inline glm::dvec3 throughput_of(const RayView& q, std::size_t i) { return get3(q.tr, q.tg, q.tb, i); }

/// A ray of a path in flight. What the path is keyed with differs from ray to ray.
inline void put_ray(const RayView& q, std::uint32_t i, const glm::dvec3& origin, const glm::dvec3& direction,
                    std::uint32_t left = kernels::no_sphere, const glm::dvec3& throughput = glm::dvec3(1)) {
    put3(q.ox, q.oy, q.oz, i, origin);
    put3(q.dx, q.dy, q.dz, i, glm::normalize(direction));
    put3(q.tr, q.tg, q.tb, i, throughput);
    if (q.pdf != nullptr) q.pdf[i] = std::numeric_limits<float>::infinity();
    if (q.roulette_scale != nullptr) q.roulette_scale[i] = 1;
    q.departed[i] = left;
    q.slot[i] = i;
    q.pixel[i] = i / 4;
    q.sample[i] = i % 4;
}

}  // namespace orrery::kernel_tests
