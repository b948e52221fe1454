#include "cli/commands.hpp"
#include "cli/standard_streams.hpp"
#include "scene/read.hpp"

namespace orrery {

std::optional<Scene> load_scene(const Arguments& arguments) {
    ReadResult result = read_scene(arguments.scene);
    for (const Diagnostic& diagnostic : result.diagnostics) {
        if (diagnostic.severity == Severity::warning && arguments.quiet) continue;
        print_message(format_diagnostic(arguments.scene.string(), diagnostic) + "\n");
    }
    if (result.scene) apply(arguments.overrides, result.scene->settings);
    return std::move(result.scene);
}

}  // namespace orrery
