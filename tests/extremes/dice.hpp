// Random input in the kernels' vectors, and what a number format makes of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "kernels/vec3.hpp"
#include "support/random_numbers.hpp"

namespace orrery::extremes {

using Double3 = kernels::Vec3<double>;

class Dice : public test::RandomNumbers {
public:
    using RandomNumbers::RandomNumbers;
    /// Integers from low to high, both included.
    int integer(int low, int high) {
        return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
    }
    bool coin() { return (bits() >> 63) != 0; }
    Double3 direction() { return on_sphere<Double3>(); }
    /// Unit length, at a right angle to `axis`.
    Double3 across(const Double3& axis) {
        while (true) {
            const Double3 v = kernels::cross(axis, direction());
            if (kernels::dot(v, v) > 1e-4 * kernels::dot(axis, axis)) return kernels::unit(v);
        }
    }
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
