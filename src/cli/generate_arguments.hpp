// The options of `orrery generate`.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/arguments.hpp"

namespace orrery {

/// Declares them in `app`; parsing fills `generation`.
void add_generation(CLI::App& app, Generation& generation);

}  // namespace orrery
