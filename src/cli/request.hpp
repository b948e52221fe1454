// What `orrery render` and `orrery info` are asked for, and the scene with it.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "film/film_state.hpp"
#include "kernels/isa.hpp"
#include "plan/plan.hpp"
#include "scene/settings.hpp"
#include "wavefront/goal.hpp"

namespace orrery {

/// What the command line says instead of the scene file.
using Overrides = std::map<const Setting*, SettingValue>;

struct Request {
    std::filesystem::path scene;
    Overrides overrides;
    std::vector<std::filesystem::path> outputs;  ///< render only; empty: where the scene says
    std::optional<std::filesystem::path> error_image;
    std::optional<double> error;    ///< --error, as a share: 1 % is 0.01
    std::optional<double> seconds;  ///< --time
    std::optional<bool> adaptive;
    std::optional<Window> crop;
    std::optional<double> exposure;
    std::optional<std::filesystem::path> film;
    std::vector<std::filesystem::path> films;  ///< develop only
    std::optional<double> film_every;          ///< seconds
    std::optional<Shard> shard;
    std::optional<std::string> stats;  ///< a file, or "-" for standard output
    unsigned threads = 0;              ///< 0: all cores
    Isa isa = best_isa();              ///< supported by this machine
    std::uint32_t wave_size = 0;       ///< 0: the default
    bool profile = false;              ///< print where the time went
    bool quiet = false;                ///< neither progress nor warnings
};

/// When to stop, where that is not the scene's number of samples. Throws UsageError where --adaptive has nothing to
/// adapt to.
Goal goal_of(const Request& request);

/// Declare options that fill `request`.
void add_outputs(CLI::App& app, Request& request, const std::string& otherwise);
void add_error_image(CLI::App& app, Request& request);
void add_crop(CLI::App& app, Request& request);
void add_exposure(CLI::App& app, Request& request, const std::string& otherwise);
/// `otherwise`: its default in words.
void add_override(CLI::App& app, Overrides& overrides, const Setting& setting, const std::string& otherwise);
void add_scene(CLI::App& app, Request& request);
/// The settings, when to stop, and what to run on.
void add_settings(CLI::App& app, Request& request);
void add_quiet(CLI::App& app, bool& quiet);

/// The scene with the command line's overrides, every diagnostic of the file printed. Empty where the scene has
/// errors. Throws UsageError where the overrides do not fit it.
std::optional<Scene> load_scene(const Request& request);

/// The scene's plan. Where building its tree takes long, a terminal is told.
Plan plan_visibly(const Request& request, Scene scene);

/// Unless --quiet.
void print_warnings(const Request& request, const Plan& plan);

}  // namespace orrery
