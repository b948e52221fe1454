// The options of `orrery compare`.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/arguments.hpp"

namespace orrery {

/// Declares them in `app`; parsing fills `request`.
void add_comparison(CLI::App& app, ComparisonRequest& request);

}  // namespace orrery
