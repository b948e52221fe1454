// Decisions from a byte string: what a fuzzer changes byte by byte becomes numbers, kinds and counts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <iterator>
#include <span>

namespace orrery::fuzz {

/// Reads a byte string from front to back; behind its end are zeros. Every string is a valid list of decisions.
class Choices {
public:
    explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::uint32_t byte() {
        if (bytes_.empty()) return 0;
        const std::uint32_t first = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return first;
    }
    /// 0 .. n - 1, n <= 256.
    std::uint32_t below(std::uint32_t n) { return byte() % n; }
    /// So often in 256 times; never behind the end.
    bool chance(std::uint32_t of_256) { return byte() > 255 - of_256; }
    template <class Options>
    auto one_of(const Options& options) {
        return options[below(static_cast<std::uint32_t>(std::size(options)))];
    }

    /// [0, 1].
    double unit() {
        const std::uint32_t high = byte();
        return (256 * high + byte()) / 65535.0;
    }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// 10^low .. 10^high, each power of ten as likely.
    double power_of_ten(double low, double high) { return std::pow(10.0, between(low, high)); }
    glm::dvec3 point(double reach) {
        const double x = between(-reach, reach), y = between(-reach, reach);
        return {x, y, between(-reach, reach)};
    }
    /// Of unit length.
    glm::dvec3 direction() {
        const glm::dvec3 p = point(1);
        const double length = glm::length(p);
        return length > 1e-3 ? p / length : glm::dvec3(0, 0, 1);
    }

private:
    std::span<const std::uint8_t> bytes_;
};

}  // namespace orrery::fuzz
