// Random numbers of a generated world: the same on every machine, in any order of asking.
#pragma once

#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace orrery::worlds {

/// The dice of one thing in a world, the same whenever they are asked for: a sphere is written twice, as shape and as
/// primitive, by a writer that remembers none. One throw a statement: compilers order the parts of an expression as
/// they like.
class Dice {
public:
    Dice(std::uint32_t seed, std::uint32_t stream, std::uint64_t item)
        : state_(mixed(mixed(std::uint64_t{stream} << 32 | seed) + item)) {}

    /// SplitMix64 (Steele, Lea and Flood 2014).
    std::uint64_t bits() { return mixed(state_ += 0x9E3779B97F4A7C15); }

    /// In [0, 1), 53 bits.
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    /// In (-1, 1), near 0 more often than not: close to normal of deviation 1/3.
    double bell() {
        double sum = 0;
        for (int i = 0; i < 3; ++i) sum += uniform(-1, 1);
        return sum / 3;
    }

    /// On the unit sphere, uniform.
    glm::dvec3 direction() {
        const double z = uniform(-1, 1);
        const double angle = uniform(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

    /// In the unit ball, uniform.
    glm::dvec3 in_ball() {
        const double r = std::cbrt(uniform());
        return direction() * r;
    }

    /// Density ~ x^-exponent on [low, high], exponent > 1.
    double power_law(double low, double high, double exponent) {
        const double e = 1 - exponent, a = std::pow(low, e), b = std::pow(high, e);
        return std::pow(a + (b - a) * uniform(), 1 / e);
    }

private:
    static std::uint64_t mixed(std::uint64_t z) {
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
        z = (z ^ z >> 27) * 0x94D049BB133111EB;
        return z ^ z >> 31;
    }

    std::uint64_t state_;
};

}  // namespace orrery::worlds
