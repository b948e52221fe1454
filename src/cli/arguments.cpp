#include "cli/arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "cli/compare_arguments.hpp"
#include "cli/exit_code.hpp"
#include "cli/generate_arguments.hpp"
#include "cli/help.hpp"
#include "cli/option.hpp"
#include "cli/values.hpp"
#include "cli/version.hpp"
#include "scene/spelling.hpp"
#include "system/printable.hpp"
#include "wavefront/render.hpp"

namespace orrery {
namespace {

constexpr std::uint32_t most_threads = 1024;

void add_scene(CLI::App& app, Arguments& arguments) {
    add_option(app, "SCENE", "FILE", "The scene to read, a JSON file",
               [&](const std::string& text) { arguments.scene = text; })
        ->required()
        ->group("Scene");
}

void add_outputs(CLI::App& app, Arguments& arguments) {
    add_option(app, "-o,--output", "FILE",
               "Image to write: .ppm or .png (8 bit, tone mapped), .pfm or .exr (linear radiance); repeat it for more "
               "(default: the scene's output)",
               [&](const std::string& text) { arguments.outputs.emplace_back(text); })
        // Each -o is read on its own: a list option of CLI11 would also swallow the SCENE after it.
        ->trigger_on_parse()
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->group("Image");
}

void add_settings(CLI::App& app, Overrides& overrides) {
    for (const Setting& setting : all_settings()) {
        const std::string label = setting.kind == SettingKind::word     ? expected_text(setting)
                                  : setting.kind == SettingKind::number ? "N"
                                                                        : "WxH";
        const std::string other = setting.required ? "" : ", else " + text_of(setting, RenderSettings{});
        add_option(app, "--" + std::string(setting.option), label,
                   fmt::format("{} (default: the scene's{})", setting.meaning, other),
                   [&](const std::string& text) {
                       const auto value = value_of(setting, text);
                       if (!value) throw unexpected(text, expected_text(setting));
                       overrides[&setting] = *value;
                   })
            ->group(std::string(setting.group));
    }
}

void add_stops(CLI::App& app, Arguments& arguments) {
    const char* group = "Stop (--spp is a ceiling to these, on the average over pixels)";
    add_option(app, "--error", "SHARE",
               "Render until the image's relative error is estimated to be this, such as 1% or 0.01",
               [&](const std::string& text) { arguments.error = parse_share(text); })
        ->group(group);
    add_option(app, "--time", "TIME",
               "Render what fits into this, such as 30s, 2m or 500ms; another run gives another image",
               [&](const std::string& text) { arguments.seconds = parse_duration(text); })
        ->group(group);
    add_option(app, "--adaptive", "on|off",
               "Take more samples where the error is larger; without a stop of this group there is none to adapt to "
               "(default: on)",
               [&](const std::string& text) { arguments.adaptive = parse_word(text, on_off) == 0; })
        ->group(group);
}

void add_machine(CLI::App& app, Arguments& arguments) {
    const char* group = "Machine (these change no image beyond rounding)";
    add_option(app, "--threads", "N", "How many threads (default: all cores)", [&](const std::string& text) {
        arguments.threads = parse_integer(text, 1, most_threads);
    })->group(group);
    add_option(app, "--isa", "auto|scalar|sse2|avx2|avx512",
               "Instruction set (default: auto, the best this machine has)",
               [&](const std::string& text) { arguments.isa = parse_isa(text); })
        ->group(group);
    add_option(app, "--wave-size", "N",
               "For experts: samples traced together per thread (default: what fits its cache)",
               [&](const std::string& text) { arguments.wave_size = parse_integer(text, 1, largest_wave); })
        ->group(group);
}

void add_reports(CLI::App& app, Arguments& arguments) {
    add_option(app, "--error-image", "FILE", "Write every pixel's standard error, linear: .pfm or .exr",
               [&](const std::string& text) { arguments.error_image = text; })
        ->group("Reports");
    add_option(app, "--stats", "FILE.json",
               "Write times, ray counts, the image's error and the plan as JSON; - is standard output",
               [&](const std::string& text) { arguments.stats = text; })
        ->group("Reports");
    app.add_flag("--profile", arguments.profile, "Print where the time went, by stage and bounce")->group("Reports");
}

void add_quiet(CLI::App& app, Arguments& arguments) {
    app.add_flag("--quiet", arguments.quiet, "Show neither progress nor warnings; errors are always shown")
        ->group("Reports");
}

constexpr const char* render_example =
    "Example: a quick look, then the real thing in two formats\n"
    "  {0} render scenes/assignment_08.json --size 256x256 --spp 16 -o look.png\n"
    "  {0} render scenes/assignment_08.json --error 2% -o image.png -o image.exr\n"
    "\n"
    "Standard output names the images written, one on a line. Exit code: 0 written, 1 the work failed, 2 bad usage or "
    "a "
    "bad scene.";

constexpr const char* info_example =
    "Prints what render would do with the same options: the settings, the memory, and which parts of the pipeline run "
    "and why.\n"
    "\n"
    "Example:\n"
    "  {0} info scenes/assignment_08.json --transport naive";

/// The words that nobody knows, and what they could have meant. Empty where there is none.
std::string unknown_words(const CLI::App& app) {
    const std::vector<std::string> words = app.remaining();
    if (words.empty()) return "";
    // A misspelt option's value may be taken for the scene, and the scene is then among the rest.
    const auto option = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with('-'); });
    const std::string& word = option != words.end() ? *option : words.front();
    std::vector<std::string> names;
    if (option != words.end()) {
        for (const CLI::Option* known : app.get_options()) {
            for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
            for (const std::string& name : known->get_snames()) names.push_back("-" + name);
        }
    } else {
        for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string_view near = Spelling().likely(word.substr(0, word.find('=')), known);
    const char* const expected = option != words.end() ? "an option that --help names"
                                 : names.empty()       ? "no further argument"
                                                       : "a command, render, info, generate or compare";
    return fmt::format("found {}, expected {}{}", in_quotes(word), expected,
                       near.empty() ? "" : fmt::format("; did you mean {}?", near));
}

Answer failure(const CLI::App& app, const CLI::ParseError& error) {
    const auto chosen = app.get_subcommands();
    std::string fault = unknown_words(chosen.empty() ? app : *chosen.front());
    // CLI11 says that a subcommand is required, not which there are.
    if (fault.empty() && chosen.empty() && error.get_name() == "RequiredError")
        fault = "expected a command, render, info, generate or compare";
    if (fault.empty()) fault = printable_whole(error.what());
    const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
    return {exit_code::misused, "",
            fmt::format("orrery: error: {}\nTry: {}{} --help\n", fault, typed_command(), command)};
}

}  // namespace

std::variant<Arguments, Answer> read_arguments(int argc, const char* const* argv) {
    Arguments arguments;
    const std::string typed = typed_command();
    CLI::App app("Renders worlds of spheres: a scene file in, an image out.", typed);
    app.formatter(help_formatter(help_columns()));
    app.set_version_flag("--version", fmt::format("orrery {}", version()), "Print the version");
    app.set_help_flag("-h,--help", "Print this help");
    app.require_subcommand(1);
    app.footer(fmt::format("Help on a command:\n  {} render --help", typed));

    CLI::App& render = *app.add_subcommand("render", "Render a scene to an image");
    add_scene(render, arguments);
    add_outputs(render, arguments);
    add_settings(render, arguments.overrides);
    add_stops(render, arguments);
    add_machine(render, arguments);
    add_reports(render, arguments);
    add_quiet(render, arguments);
    render.footer(fmt::format(render_example, typed));

    CLI::App& info = *app.add_subcommand("info", "Show how a scene would be rendered, and why so");
    add_scene(info, arguments);
    add_settings(info, arguments.overrides);
    add_stops(info, arguments);
    add_machine(info, arguments);
    add_quiet(info, arguments);
    info.footer(fmt::format(info_example, typed));

    CLI::App& generate = *app.add_subcommand("generate", "Write a scene of as many spheres as you like");
    add_generation(generate, arguments.generation);
    add_quiet(generate, arguments);

    CLI::App& compare = *app.add_subcommand("compare", "Measure how much two images differ");
    add_comparison(compare, arguments.comparison);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) return failure(app, error);
        std::ostringstream output, unused;
        app.exit(error, output, unused);  // help or version
        return Answer{exit_code::done, output.str(), ""};
    }
    const std::pair<const CLI::App*, Command> others[] = {
        {&info, Command::info}, {&generate, Command::generate}, {&compare, Command::compare}};
    for (const auto& [command, meant] : others)
        if (command->parsed()) arguments.command = meant;
    return arguments;
}

Goal goal_of(const Arguments& arguments) {
    const auto samples = arguments.overrides.find(&setting("spp"));
    const Goal goal{.error = arguments.error.value_or(0),
                    .seconds = arguments.seconds.value_or(0),
                    .samples = samples != arguments.overrides.end() ? samples->second[0] : 0,
                    .adaptive = arguments.adaptive.value_or(true)};
    if (arguments.adaptive && !goal.asked())
        throw UsageError("--adaptive: found no stop to adapt to, expected --error or --time beside it");
    return goal;
}

}  // namespace orrery
