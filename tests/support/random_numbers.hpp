// Random input for tests, the same on every machine: of the standard library only the engine is specified to the bit.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string_view>

namespace orrery::test {

class RandomNumbers {
public:
    explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
    /// Other names, other numbers.
    explicit RandomNumbers(std::string_view name) {
        std::seed_seq letters(name.begin(), name.end());
        engine_.seed(letters);
    }
    std::uint64_t bits() { return engine_(); }
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    /// Uniform in the logarithm.
    double scale(double low, double high) { return low * std::pow(high / low, uniform()); }
    /// Uniform on the unit sphere.
    template <class Vector>
    Vector on_sphere() {
        const double z = between(-1, 1), phi = between(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace orrery::test
