#include "cli/request.hpp"

#include <fmt/format.h>

#include <new>
#include <stdexcept>

#include "cli/options.hpp"
#include "cli/process.hpp"
#include "cli/progress.hpp"
#include "scene/counted.hpp"
#include "scene/read.hpp"
#include "wavefront/render.hpp"

namespace orrery {
namespace {

constexpr std::uint32_t most_threads = 1024;

void add_overrides(CLI::App& app, Overrides& overrides) {
    for (const Setting& setting : all_settings()) {
        const std::string other = setting.required ? "" : ", else " + text_of(setting, RenderSettings{});
        add_override(app, overrides, setting, "the scene's" + other);
    }
}

void add_stops(CLI::App& app, Request& request) {
    const char* group = "Stop (--spp is a ceiling to these, on the average over pixels)";
    add_option(app, "--error", "SHARE",
               "Render until the image's relative error is estimated to be this, such as 1% or 0.01",
               [&](const std::string& text) { request.error = parse_share(text); })
        ->group(group);
    add_option(app, "--time", "TIME",
               "Render what fits into this, such as 30s, 2m or 500ms; another run gives another image",
               [&](const std::string& text) { request.seconds = parse_duration(text); })
        ->group(group);
    add_option(app, "--adaptive", "on|off",
               "Take more samples where the error is larger; without a stop of this group there is none to adapt to "
               "(default: on)",
               [&](const std::string& text) { request.adaptive = parse_word(text, on_off) == 0; })
        ->group(group);
}

void add_machine(CLI::App& app, Request& request) {
    const char* group = "Machine (these change no image beyond rounding)";
    add_option(app, "--threads", "N", "How many threads (default: all cores)", [&](const std::string& text) {
        request.threads = parse_integer(text, 1, most_threads);
    })->group(group);
    add_option(app, "--isa", "auto|scalar|sse2|avx2|avx512",
               "Instruction set (default: auto, the best this machine has)",
               [&](const std::string& text) { request.isa = parse_isa(text); })
        ->group(group);
    add_option(app, "--wave-size", "N",
               "For experts: samples traced together per thread (default: what fits its cache)",
               [&](const std::string& text) { request.wave_size = parse_integer(text, 1, largest_wave); })
        ->group(group);
}

void print_diagnostics(const Request& request, const std::vector<Diagnostic>& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity == Severity::warning && request.quiet) continue;
        print_line(format_diagnostic(request.scene.string(), diagnostic));
    }
}

/// Throws UsageError where the settings together are none a scene file could hold: `--integrator wrt` may be what makes
/// the scene's own depth too much.
void apply(const Request& request, RenderSettings& settings) {
    const Overrides& overrides = request.overrides;
    for (const auto& [setting, value] : overrides) setting->member.set(settings, value);
    settings.crop = request.crop;
    if (settings.crop && (settings.crop->x1 > settings.width || settings.crop->y1 > settings.height))
        throw UsageError(fmt::format("--crop: found {}, expected a window of the image of {} x {}",
                                     text_of(*settings.crop), settings.width, settings.height));
    for (const Conflict& conflict : conflicts(settings)) {
        const std::string whose = overrides.contains(&conflict.setting)
                                      ? fmt::format("--{}", conflict.setting.option)
                                      : fmt::format("the scene's {}", conflict.setting.key);
        throw UsageError(whose + ": " + conflict.message);
    }
}

ReadResult read_visibly(const Request& request) {
    const LateNotice notice(!request.quiet, fmt::format("reading {} ...", request.scene.filename().string()));
    try {
        return read_scene(request.scene);
    } catch (const std::bad_alloc&) {
        throw std::runtime_error(fmt::format("{}: out of memory while reading this scene", request.scene.string()));
    }
}

}  // namespace

void add_scene(CLI::App& app, Request& request) {
    add_option(app, "SCENE", "FILE", "The scene to read, a JSON file",
               [&](const std::string& text) { request.scene = text; })
        ->required()
        ->group("Scene");
}

void add_override(CLI::App& app, Overrides& overrides, const Setting& setting, const std::string& otherwise) {
    const std::string label = setting.kind == SettingKind::word     ? expected_text(setting)
                              : setting.kind == SettingKind::number ? "N"
                                                                    : "WxH";
    add_option(app, "--" + std::string(setting.option), label,
               fmt::format("{} (default: {})", setting.meaning, otherwise),
               [&setting, &overrides](const std::string& text) {
                   const auto value = value_of(setting, text);
                   if (!value) throw unexpected(text, expected_text(setting));
                   overrides[&setting] = *value;
               })
        ->group(std::string(setting.group));
}

void add_outputs(CLI::App& app, Request& request, const std::string& otherwise) {
    add_option(app, "-o,--output", "FILE",
               "Image to write: .ppm or .png (8 bit, tone mapped), .pfm or .exr (linear radiance); repeat it for more" +
                   otherwise,
               [&](const std::string& text) { request.outputs.emplace_back(text); })
        // Each -o is read on its own: a list option of CLI11 would also swallow the SCENE after it.
        ->trigger_on_parse()
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->group("Image");
}

void add_crop(CLI::App& app, Request& request) {
    add_option(
        app, "--crop", "X0,Y0,X1,Y1",
        "Render a window of the image alone: columns X0 to below X1, rows Y0 to below Y1, counted from the top left",
        [&](const std::string& text) { request.crop = parse_window(text); })
        ->group("Image");
}

void add_exposure(CLI::App& app, Request& request, const std::string& otherwise) {
    add_option(
        app, "--exposure", "EV",
        fmt::format("Multiply radiance by 2^EV, from -100 to 100, before it is tone mapped (default: {})", otherwise),
        [&](const std::string& text) { request.exposure = parse_exposure(text); })
        ->group("Image");
}

void add_error_image(CLI::App& app, Request& request) {
    add_option(app, "--error-image", "FILE", "Write every pixel's standard error, linear: .pfm or .exr",
               [&](const std::string& text) { request.error_image = text; })
        ->group("Reports");
}

void add_settings(CLI::App& app, Request& request) {
    add_overrides(app, request.overrides);
    add_stops(app, request);
    add_machine(app, request);
}

void add_quiet(CLI::App& app, bool& quiet) {
    app.add_flag("--quiet", quiet, "Show neither progress nor warnings; errors are always shown")->group("Reports");
}

Goal goal_of(const Request& request) {
    const auto samples = request.overrides.find(&setting("spp"));
    const Goal goal{.error = request.error.value_or(0),
                    .seconds = request.seconds.value_or(0),
                    .samples = samples != request.overrides.end() ? samples->second[0] : 0,
                    .adaptive = request.adaptive.value_or(true)};
    if (request.shard && request.shard->of > 1 && goal.asked())
        throw UsageError(fmt::format("--shard: found --{} beside it, which is of the whole image, expected --spp alone",
                                     goal.error > 0 ? "error" : "time"));
    if (request.crop && goal.asked())
        throw UsageError(fmt::format("--crop: found --{} beside it, which is of the whole image, expected --spp alone",
                                     goal.error > 0 ? "error" : "time"));
    if (request.adaptive && !goal.asked())
        throw UsageError("--adaptive: found no stop to adapt to, expected --error or --time beside it");
    return goal;
}

std::optional<Scene> load_scene(const Request& request) {
    ReadResult result = read_visibly(request);
    print_diagnostics(request, result.diagnostics);
    if (result.scene) apply(request, result.scene->settings);
    return std::move(result.scene);
}

Plan plan_visibly(const Request& request, Scene scene) {
    const LateNotice notice(!request.quiet,
                            fmt::format("building a tree of {} ...", counted(scene.primitives.size(), "sphere")));
    return Plan(std::move(scene), request.threads);
}

void print_warnings(const Request& request, const Plan& plan) { print_diagnostics(request, plan.warnings()); }

}  // namespace orrery
