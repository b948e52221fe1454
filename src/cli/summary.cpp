#include "cli/summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cli/progress.hpp"
#include "cli/statistics.hpp"
#include "scene/counted.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

std::string samples_text(const RenderStats& stats) {
    if (stats.passes == 1)
        return fmt::format("{} sample{} per pixel", stats.samples_per_pixel, stats.samples_per_pixel == 1 ? "" : "s");
    std::string text = fmt::format("{:.0f} samples per pixel", stats.samples_per_pixel);
    if (stats.least_samples != stats.most_samples)
        text += fmt::format(" ({} to {})", stats.least_samples, stats.most_samples);
    return text + fmt::format(" in {} passes", stats.passes);
}

/// Nothing where nothing is known, as with one sample per pixel.
std::string error_text(const RootMeanSquare& error) {
    if (!std::isfinite(error.value)) return "";
    if (!std::isfinite(error.high))
        return fmt::format(", error {:.2g} % (at least {:.2g}: few samples tell)", 100 * error.value, 100 * error.low);
    return fmt::format(", error {:.3g} % ({:.3g} to {:.3g})", 100 * error.value, 100 * error.low, 100 * error.high);
}

std::string stop_text(const Goal& goal, StopReason reason) {
    if (!goal.asked()) return "";
    const std::string error = goal.error > 0 ? fmt::format(", not yet at the {:.3g} % asked", 100 * goal.error) : "";
    switch (reason) {
        case StopReason::error:
            return fmt::format("; stopped at the {:.3g} % asked", 100 * goal.error);
        case StopReason::time:
            return fmt::format("; stopped by --time{}: another run gives another image", error);
        case StopReason::samples:
            return fmt::format("; stopped by --spp{}", error);
    }
    return "";
}

}  // namespace

std::string summary(const Plan& plan, const Goal& goal, const RenderStats& stats) {
    const RenderSettings& settings = plan.settings();
    return fmt::format("{}: {} x {}, {} in {:.2f} s, {:.1f} Mrays/s ({}, {}){}{}\n",
                       printable_whole(plan.scene().file.string()), settings.width, settings.height,
                       samples_text(stats), stats.seconds, rays_per_second(stats) / 1e6, isa_name(stats.isa),
                       counted(stats.threads, "thread"), error_text(stats.error.relative),
                       stop_text(goal, stats.stopped_by));
}

}  // namespace orrery
