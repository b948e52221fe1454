#include "scene/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace orrery {
namespace {

bool within_bounds(const Range& range, double value) {
    const bool above = range.low_included ? value >= range.low : value > range.low;
    const bool below = range.high_included ? value <= range.high : value < range.high;
    return above && below;
}

}  // namespace

std::string describe(const Range& range) {
    std::string text = "a number";
    if (range.low > -Range::unlimited) text += fmt::format(" {} {}", range.low_included ? ">=" : ">", range.low);
    if (range.high < Range::unlimited) {
        text += fmt::format("{} {} {}", range.low > -Range::unlimited ? " and" : "", range.high_included ? "<=" : "<",
                            range.high);
    }
    return text;
}

std::optional<std::string> expectation(const Range& range, double value) {
    if (!within_bounds(range, value)) return describe(range);
    const double magnitude = std::abs(value);
    if (magnitude > range.largest) {
        return fmt::format("a magnitude of at most {}, which single precision can compute with", range.largest);
    }
    if (magnitude > 0 && magnitude < range.smallest) {
        return fmt::format("a magnitude of at least {}, which single precision can compute with", range.smallest);
    }
    if (!within_bounds(range, static_cast<double>(static_cast<float>(value)))) {
        return describe(range) + " when rounded to single precision, too";
    }
    return std::nullopt;
}

}  // namespace orrery
