#include <fmt/format.h>

#include <iterator>

#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/standard_streams.hpp"
#include "cli/values.hpp"
#include "cli/words.hpp"
#include "plan/plan.hpp"
#include "scene/counted.hpp"
#include "scene/image_memory.hpp"
#include "system/printable.hpp"
#include "wavefront/wave_storage.hpp"

namespace orrery {
namespace {

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
    std::string text = fmt::format("{} per pixel, {}", plan.samples(), word_for(estimator_words, settings.estimator));
    if (settings.estimator == Estimator::stratified) text += fmt::format(" {} x {}", plan.strata(), plan.strata());
    if (plan.samples() != settings.samples) text += fmt::format(" ({} asked)", settings.samples);
    return text;
}

std::string method_text(const RenderSettings& s) {
    std::string text(word_for(integrator_words, s.integrator));
    if (s.integrator == Integrator::depth) return text;
    text += fmt::format(", depth {}", s.depth);
    if (s.integrator == Integrator::path_tracing) {
        text += fmt::format(", transport {}, light choice {}, roulette {}", word_for(transport_words, s.transport),
                            word_for(light_choice_words, s.light_choice), word_for(switch_words, s.roulette));
        if (s.roulette && s.roulette_from > 0)
            text += fmt::format(" after more than {}", counted(s.roulette_from, "event"));
    }
    return text + fmt::format(", light sampling {}", word_for(light_sampling_words, s.light_sampling));
}

/// The queues of a thread where their length is given; what one (pixel, sample) pair takes where render decides it.
std::string queues_text(const Plan& plan, std::uint32_t wave_size) {
    constexpr std::uint32_t many = 1u << 16;  // so that padding does not count
    const auto bytes = [&](std::uint32_t count) { return queue_bytes(plan, count); };
    std::string text = fmt::format("{} bytes per (pixel, sample) pair in flight", bytes(many) / many);
    if (wave_size != 0) text += fmt::format(", {} per thread for waves of {}", bytes_text(bytes(wave_size)), wave_size);
    return text;
}

}  // namespace

int info_command(const Arguments& arguments) {
    std::optional<Scene> scene = load_scene(arguments);
    if (!scene) return exit_code::misused;
    const Plan plan = plan_visibly(arguments, std::move(*scene));
    print_warnings(arguments, plan);
    const RenderSettings& settings = plan.settings();
    const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;

    std::string text;
    const auto row = [&](std::string_view name, std::string_view value) {
        fmt::format_to(std::back_inserter(text), "{:<10} {}\n", name, printable_whole(value));
    };
    row("scene", plan.scene().file.string());
    row("image", fmt::format("{} x {} pixels, tone mapper {}", settings.width, settings.height,
                             word_for(tonemap_words, tone_mapper(settings))));
    row("output", settings.output.empty() ? "none named" : settings.output.string());
    row("samples", samples_text(plan, goal_of(arguments)));
    row("seed", std::to_string(settings.seed));
    row("method", method_text(settings));
    row("film", bytes_text(pixels * bytes_per_pixel));
    row("queues", queues_text(plan, arguments.wave_size));
    row("isa", fmt::format("{} (this machine supports {})", isa_name(arguments.isa), supported_isas()));
    row("precision", word_for(precision_words, settings.precision));

    text += "\nplan\n";
    for (const Decision& decision : plan.decisions()) {
        fmt::format_to(std::back_inserter(text), "  {:<8} {:<26} {}\n", decision.runs ? "runs" : "left out",
                       decision.part, printable_whole(decision.reason));
    }
    print_result(text);
    return exit_code::done;
}

}  // namespace orrery
