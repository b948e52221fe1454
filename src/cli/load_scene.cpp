#include <fmt/format.h>

#include <new>
#include <stdexcept>

#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/late_notice.hpp"
#include "cli/standard_streams.hpp"
#include "scene/counted.hpp"
#include "scene/read.hpp"

namespace orrery {

namespace {

void print_diagnostics(const Arguments& arguments, const std::vector<Diagnostic>& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity == Severity::warning && arguments.quiet) continue;
        print_line(format_diagnostic(arguments.scene.string(), diagnostic));
    }
}

/// Throws UsageError where the settings together are none a scene file could hold: `--integrator wrt` may be what makes
/// the scene's own depth too much.
void apply(const Overrides& overrides, RenderSettings& settings) {
    for (const auto& [setting, value] : overrides) setting->member.set(settings, value);
    for (const Conflict& conflict : conflicts(settings)) {
        const std::string whose = overrides.contains(&conflict.setting)
                                      ? fmt::format("--{}", conflict.setting.option)
                                      : fmt::format("the scene's {}", conflict.setting.key);
        throw UsageError(whose + ": " + conflict.message);
    }
}

ReadResult read_visibly(const Arguments& arguments) {
    const LateNotice notice(!arguments.quiet, fmt::format("reading {} ...", arguments.scene.filename().string()));
    try {
        return read_scene(arguments.scene);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(fmt::format("{}: out of memory while reading this scene", arguments.scene.string()));
    }
}

}  // namespace

std::optional<Scene> load_scene(const Arguments& arguments) {
    ReadResult result = read_visibly(arguments);
    print_diagnostics(arguments, result.diagnostics);
    if (result.scene) apply(arguments.overrides, result.scene->settings);
    return std::move(result.scene);
}

Plan plan_visibly(const Arguments& arguments, Scene scene) {
    const LateNotice notice(!arguments.quiet,
                            fmt::format("building a tree of {} ...", counted(scene.primitives.size(), "sphere")));
    return Plan(std::move(scene), arguments.threads);
}

void print_warnings(const Arguments& arguments, const Plan& plan) { print_diagnostics(arguments, plan.warnings()); }

}  // namespace orrery
