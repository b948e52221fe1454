// The commands of the program, a file each.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace orrery {

/// What a command does once its options have been read. Returns an exit code; UsageError and other exceptions are for
/// main to report.
using Work = std::function<int()>;

// Each declares its options in `app` and returns its work.

/// `orrery render`: scene -> images.
Work add_render(CLI::App& app);

/// `orrery info`: scene -> what render would do, and why.
Work add_info(CLI::App& app);

/// `orrery develop`: films -> images.
Work add_develop(CLI::App& app);

/// `orrery generate`: a kind of world -> a scene file.
Work add_generate(CLI::App& app);

/// `orrery compare`: two images -> how much they differ, and whether that is more than allowed.
Work add_compare(CLI::App& app);

}  // namespace orrery
