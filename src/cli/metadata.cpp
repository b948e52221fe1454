#include "cli/metadata.hpp"

#include <fmt/format.h>

#include "cli/overrides.hpp"
#include "cli/version.hpp"
#include "cli/words.hpp"

namespace orrery {

std::string canonical_options(const RenderSettings& s, const Goal& goal, ImageFormat format) {
    std::string text =
        fmt::format("--integrator {} --size {}x{}", word_for(integrator_words, s.integrator), s.width, s.height);
    const auto add = [&](std::string_view option, auto value) { text += fmt::format(" --{} {}", option, value); };
    if (goal.asked()) {
        if (goal.error > 0) add("error", goal.error);
        if (goal.seconds > 0) add("time", fmt::format("{}s", goal.seconds));
        if (goal.samples > 0) add("spp", goal.samples);
        add("adaptive", word_for(switch_words, goal.adaptive));
    } else {
        add("spp", s.samples);
    }
    add("estimator", word_for(estimator_words, s.estimator));
    add("seed", s.seed);
    if (s.integrator != Integrator::depth) {
        add("depth", s.depth);
        add("light-sampling", word_for(light_sampling_words, s.light_sampling));
    }
    if (s.integrator == Integrator::path_tracing) {
        add("transport", word_for(transport_words, s.transport));
        add("light-choice", word_for(light_choice_words, s.light_choice));
        add("roulette", word_for(switch_words, s.roulette));
        if (s.roulette) add("roulette-from", s.roulette_from);
    }
    if (format == ImageFormat::ppm || format == ImageFormat::png) {
        add("tonemap", word_for(tonemap_words, tone_mapper(s)));
    }
    add("precision", word_for(precision_words, s.precision));
    return text;
}

Metadata image_metadata(const Plan& plan, ImageFormat format, const Making& making) {
    const RenderSettings& settings = plan.settings();
    Metadata metadata = {{"scene", plan.scene().file.filename().string()},
                         {"seed", std::to_string(settings.seed)},
                         {"samples", fmt::format("{}", making.samples > 0 ? making.samples : plan.samples())},
                         {"options", canonical_options(settings, making.goal, format)},
                         {"version", fmt::format("orrery {}", version())}};
    if (making.content != "radiance") metadata.emplace_back("content", making.content);
    return metadata;
}

}  // namespace orrery
