// Cases made of independent random trials.
#pragma once

#include "cases.hpp"
#include "modes.hpp"

namespace orrery::extremes {

/// trial(errors, dice), so many times, in the arithmetic of V.
template <class V, class Trial>
void add_trials(std::vector<Case>& cases, const char* group, const std::string& name, const char* unit, double limit,
                std::uint64_t trials, const Trial& trial, std::uint64_t times_on_page = 10) {
    cases.push_back({group, name, mode_name<V>(), unit, limit, trials,
                     [trial](Errors& errors, std::uint64_t count, Dice& dice) {
                         for (std::uint64_t i = 0; i < count; ++i) trial(errors, dice);
                     },
                     times_on_page});
}

}  // namespace orrery::extremes
