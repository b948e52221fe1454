#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include "cli/commands.hpp"
#include "cli/late_notice.hpp"
#include "cli/standard_streams.hpp"
#include "scene/counted.hpp"
#include "scene/read.hpp"

namespace orrery {

namespace {

ReadResult read_visibly(const Arguments& arguments) {
    const LateNotice notice(!arguments.quiet, fmt::format("reading {} ...", arguments.scene.filename().string()));
    return read_scene(arguments.scene);
}

}  // namespace

std::optional<Scene> load_scene(const Arguments& arguments) {
    ReadResult result = read_visibly(arguments);
    for (const Diagnostic& diagnostic : result.diagnostics) {
        if (diagnostic.severity == Severity::warning && arguments.quiet) continue;
        print_message(format_diagnostic(arguments.scene.string(), diagnostic) + "\n");
    }
    if (result.scene) apply(arguments.overrides, result.scene->settings);
    return std::move(result.scene);
}

Plan plan_visibly(const Arguments& arguments, Scene scene) {
    const LateNotice notice(!arguments.quiet,
                            fmt::format("building a tree of {} ...", counted(scene.primitives.size(), "sphere")));
    // The builder takes all cores it is granted.
    const auto cores = static_cast<std::size_t>(tbb::info::default_concurrency());
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    arguments.threads != 0 ? arguments.threads : cores);
    return Plan(std::move(scene));
}

}  // namespace orrery
