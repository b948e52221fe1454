#include <fmt/format.h>

#include <iterator>
#include <memory>

#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/options.hpp"
#include "cli/process.hpp"
#include "cli/request.hpp"
#include "scene/image_memory.hpp"
#include "scene/settings.hpp"
#include "system/printable.hpp"
#include "wavefront/wave_storage.hpp"

namespace orrery {
namespace {

constexpr const char* example =
    "Prints what render would do with the same options: the settings, the memory, and which parts of the pipeline run "
    "and why.\n"
    "\n"
    "Example:\n"
    "  {0} info scenes/assignment_08.json --transport naive";

std::string bytes_text(std::uint64_t bytes) {
    constexpr double mebi = 1024 * 1024;
    if (bytes < 1024 * 1024) return fmt::format("{:.1f} KiB", static_cast<double>(bytes) / 1024);
    return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / mebi);
}

std::string samples_text(const Plan& plan, const Goal& goal) {
    if (goal.asked()) {
        std::string text = goal.error > 0 ? fmt::format("until the error is below {:.3g} %", 100 * goal.error) : "";
        if (goal.seconds > 0) text += fmt::format("{}what fits into {} s", text.empty() ? "" : ", or ", goal.seconds);
        if (goal.samples > 0) text += fmt::format(", at most {} per pixel", goal.samples);
        return text + (goal.adaptive ? ", adaptive" : ", the same for all pixels");
    }
    const RenderSettings& settings = plan.settings();
    std::string text = fmt::format("{} per pixel, {}", plan.samples(), text_of(setting("estimator"), settings));
    if (settings.estimator == Estimator::stratified) text += fmt::format(" {} x {}", plan.strata(), plan.strata());
    if (plan.samples() != settings.samples) text += fmt::format(" ({} asked)", settings.samples);
    return text;
}

/// The queues of a thread where their length is given; what one (pixel, sample) pair takes where render decides it.
std::string queues_text(const Plan& plan, std::uint32_t wave_size) {
    constexpr std::uint32_t many = 1u << 16;  // so that padding does not count
    const auto bytes = [&](std::uint32_t count) { return queue_bytes(plan, count); };
    std::string text = fmt::format("{} bytes per (pixel, sample) pair in flight", bytes(many) / many);
    if (wave_size != 0) text += fmt::format(", {} per thread for waves of {}", bytes_text(bytes(wave_size)), wave_size);
    return text;
}

int info(const Request& request) {
    std::optional<Scene> scene = load_scene(request);
    if (!scene) return exit_code::misused;
    const Plan plan = plan_visibly(request, std::move(*scene));
    print_warnings(request, plan);
    const RenderSettings& settings = plan.settings();
    const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;

    std::string text;
    const auto row = [&](std::string_view name, std::string_view value) {
        fmt::format_to(std::back_inserter(text), "{:<14} {}\n", name, printable_whole(value));
    };
    row("scene", plan.scene().file.string());
    row("output", settings.output.empty() ? "none named" : settings.output.string());
    row("samples", samples_text(plan, goal_of(request)));
    for (const Setting& setting : all_settings())
        if (setting.matters(settings)) row(setting.option, text_of(setting, settings));
    row("film", bytes_text(pixels * bytes_per_pixel));
    row("queues", queues_text(plan, request.wave_size));
    row("isa", fmt::format("{} (this machine supports {})", isa_name(request.isa), supported_isas()));

    text += "\nplan\n";
    for (const Decision& decision : plan.decisions()) {
        fmt::format_to(std::back_inserter(text), "  {:<8} {:<26} {}\n", decision.runs ? "runs" : "left out",
                       decision.part, printable_whole(decision.reason));
    }
    print_result(text);
    return exit_code::done;
}

}  // namespace

Work add_info(CLI::App& app) {
    const auto request = std::make_shared<Request>();
    add_scene(app, *request);
    add_settings(app, *request);
    add_quiet(app, request->quiet);
    app.footer(fmt::format(example, typed_command()));
    return [request] { return info(*request); };
}

}  // namespace orrery
