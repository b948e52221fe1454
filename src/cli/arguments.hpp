// The command line, read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kernels/isa.hpp"
#include "scene/settings.hpp"
#include "wavefront/goal.hpp"
#include "worlds/world.hpp"

namespace orrery {

enum class Command { render, info, generate, compare };

/// What the command line says instead of the scene file.
using Overrides = std::map<const Setting*, SettingValue>;

/// What `orrery generate` is to write, and where.
struct Generation {
    worlds::Kind kind = worlds::Kind::random;
    std::uint32_t spheres = 0;
    std::uint32_t seed = 0;
    std::optional<std::filesystem::path> output;  ///< empty: standard output
};

/// What `orrery compare` is to compare, what it may find, and where that goes.
struct ComparisonRequest {
    std::filesystem::path a, b;  ///< b is the reference
    std::optional<std::filesystem::path> error_a, error_b;
    std::optional<double> max_rmse, max_mrse;
    std::optional<std::filesystem::path> difference;
    std::optional<std::string> json;  ///< a file, or "-" for standard output
};

struct Arguments {
    Command command = Command::render;
    std::filesystem::path scene;
    Overrides overrides;
    Generation generation;
    ComparisonRequest comparison;
    std::vector<std::filesystem::path> outputs;  ///< empty: where the scene says
    std::optional<std::filesystem::path> error_image;
    std::optional<double> error;    ///< --error, as a share: 1 % is 0.01
    std::optional<double> seconds;  ///< --time
    std::optional<bool> adaptive;
    std::optional<std::string> stats;  ///< a file, or "-" for standard output
    unsigned threads = 0;              ///< 0: all cores
    Isa isa = best_isa();              ///< supported by this machine
    std::uint32_t wave_size = 0;       ///< 0: the default
    bool profile = false;              ///< print where the time went
    bool quiet = false;                ///< neither progress nor warnings
};

/// When to stop, where that is not the scene's number of samples. Throws UsageError where --adaptive has nothing to
/// adapt to.
Goal goal_of(const Arguments& arguments);

/// A command line that is answered with text and nothing else: help, the version, or what is wrong with it.
struct Answer {
    int exit_code = 0;
    std::string output;  ///< for standard output
    std::string error;   ///< for standard error
};

std::variant<Arguments, Answer> read_arguments(int argc, const char* const* argv);

}  // namespace orrery
