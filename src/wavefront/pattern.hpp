// Which samples a pixel gets in one go, and where in the pixel they lie.
#pragma once

#include <cstdint>

#include "film/film.hpp"
#include "plan/plan.hpp"

namespace orrery {

/// A grid of strata x strata cells, visited row by row, every row `visits` times before the next.
struct Pattern {
    std::uint32_t strata = 1;
    std::uint32_t visits = 1;
    std::uint32_t first = 0;  ///< number of the first sample; the others follow

    std::uint32_t samples() const { return strata * strata * visits; }
};

/// All samples of a pixel at once, as the plan says. To samples that are not stratified the pixel is one cell.
inline Pattern whole_pattern(const Plan& plan) {
    const bool stratified = plan.settings().estimator == Estimator::stratified;
    return {plan.strata(), stratified ? 1 : plan.samples(), 0};
}

/// All samples of one of Sobol's sequences against all of the other.
inline Contrasting contrasting_of(const RenderSettings& settings) {
    return settings.estimator == Estimator::sobol ? Contrasting::one : Contrasting::many;
}

}  // namespace orrery
