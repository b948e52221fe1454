// The figures of a comparison, for scripts to read.
#pragma once

#include <string>

#include "cli/arguments.hpp"
#include "film/compare.hpp"

namespace orrery {

/// "name value" lines: "mse 0.0001". Numbers read back to the same double.
std::string comparison_lines(const Comparison& comparison);

/// An object of the same names, the files compared among them, with a newline at its end. What is not finite is null.
std::string comparison_json(const Comparison& comparison, const ComparisonRequest& request);

}  // namespace orrery
