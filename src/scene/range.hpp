// Which numbers a scene may hold, and why.
//
// Each range joins two demands. The contract's: a radius is positive, a reflectance at most one. And single
// precision's, in which images are computed by default: a number must keep its meaning when rounded to float.
//   * A length may be 0 or of magnitude 1e-18 to 1e18, so that its square is a normal, finite float with room for a sum
//     of three and a factor of a hundred.
//   * Power and background reach 1e30: a lamp that bright still has a finite irradiance at a distance of 1e-4.
//   * Ratios (aspect, eta) span 1e-6 to 1e6; products of their squares with lengths stay finite.
// What violates the second demand only is an error as well, not a rounding in silence: the image would be another one.
#pragma once

#include <limits>
#include <optional>
#include <string>

namespace orrery {

struct Range {
    static constexpr double unlimited = std::numeric_limits<double>::infinity();

    double low = -unlimited;
    bool low_included = true;
    double high = unlimited;
    bool high_included = true;
    double smallest = 0;    ///< least magnitude of what is not 0
    double largest = 1e18;  ///< greatest magnitude
};

namespace range {

inline constexpr Range coordinate{};
inline constexpr Range length{.low = 0, .low_included = false, .smallest = 1e-18};
inline constexpr Range length_or_zero{.low = 0, .smallest = 1e-18};
inline constexpr Range ratio{.low = 0, .low_included = false, .smallest = 1e-6, .largest = 1e6};
inline constexpr Range field_of_view{.low = 0, .low_included = false, .high = 180, .high_included = false};
inline constexpr Range reflectance{.low = 0, .high = 1};
inline constexpr Range roughness{.low = 0, .high = 1, .high_included = false};
inline constexpr Range radiance{.low = 0, .largest = 1e30};

}  // namespace range

/// The bounds of the contract in words: "a number > 0 and < 180".
std::string describe(const Range& range);

/// What was expected where `value` lies outside; empty where it lies inside, both as written and rounded to float.
std::optional<std::string> expectation(const Range& range, double value);

}  // namespace orrery
