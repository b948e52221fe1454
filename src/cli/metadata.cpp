#include "cli/metadata.hpp"

#include <fmt/format.h>

#include "cli/values.hpp"
#include "cli/version.hpp"
#include "scene/settings.hpp"

namespace orrery {

std::string canonical_options(const RenderSettings& settings, const Goal& goal, ImageFormat format) {
    std::string text;
    const auto add = [&](std::string_view option, auto value) {
        text += fmt::format("{}--{} {}", text.empty() ? "" : " ", option, value);
    };
    const bool eight_bit = format == ImageFormat::ppm || format == ImageFormat::png;
    for (const Setting& setting : all_settings()) {
        if (setting.option == "spp" && goal.asked()) {
            if (goal.error > 0) add("error", goal.error);
            if (goal.seconds > 0) add("time", fmt::format("{}s", goal.seconds));
            if (goal.samples > 0) add("spp", goal.samples);
            add("adaptive", on_off[goal.adaptive ? 0 : 1]);
        } else if (setting.matters(settings) && (eight_bit || setting.option != "tonemap")) {
            add(setting.option, text_of(setting, settings));
        }
    }
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
