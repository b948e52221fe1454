// The commands of the program. Each returns an exit code; UsageError and other exceptions are for main to report.
#pragma once

#include <optional>

#include "cli/arguments.hpp"
#include "plan/plan.hpp"

namespace orrery {

/// `orrery render`: scene -> images.
int render_command(const Arguments& arguments);

/// `orrery info`: scene -> what render would do, and why.
int info_command(const Arguments& arguments);

/// `orrery generate`: a kind of world -> a scene file.
int generate_command(const Arguments& arguments);

/// `orrery compare`: two images -> how much they differ, and whether that is more than allowed.
int compare_command(const Arguments& arguments);

/// The scene with the command line's overrides, every diagnostic of the file printed. Empty where the scene has
/// errors. Throws UsageError where the overrides do not fit it.
std::optional<Scene> load_scene(const Arguments& arguments);

/// The scene's plan. Where building its tree takes long, a terminal is told.
Plan plan_visibly(const Arguments& arguments, Scene scene);

/// Unless --quiet.
void print_warnings(const Arguments& arguments, const Plan& plan);

}  // namespace orrery
