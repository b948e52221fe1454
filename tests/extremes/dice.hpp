// Random input, the same on every machine: of the standard library only the engine is specified to the bit.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>

#include "kernels/vec3.hpp"

namespace orrery::extremes {

using Double3 = kernels::Vec3<double>;

class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    /// Uniform in the logarithm.
    double scale(double low, double high) { return low * std::pow(high / low, uniform()); }
    /// Integers from low to high, both included.
    int integer(int low, int high) {
        return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
    }
    bool coin() { return (engine_() >> 63) != 0; }
    Double3 direction() {
        const double z = between(-1, 1), phi = between(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    /// Unit length, at a right angle to `axis`.
    Double3 across(const Double3& axis) {
        while (true) {
            const Double3 v = kernels::cross(axis, direction());
            if (kernels::dot(v, v) > 1e-4 * kernels::dot(axis, axis)) return kernels::unit(v);
        }
    }

private:
    std::mt19937_64 engine_;
};

template <class Real>
kernels::Vec3<Real> rounded(const Double3& v) {
    return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

/// The unit of rounding: half the distance from 1 to the next number.
template <class Real>
inline constexpr double rounding_unit = std::numeric_limits<Real>::epsilon() / 2;

/// x moved by n representable numbers.
template <class Real>
Real nudged(Real x, int n) {
    const Real to = n > 0 ? std::numeric_limits<Real>::infinity() : -std::numeric_limits<Real>::infinity();
    for (int i = 0; i < std::abs(n); ++i) x = std::nextafter(x, to);
    return x;
}

}  // namespace orrery::extremes
