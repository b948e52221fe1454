#include "scene/renderer.hpp"

#include <fmt/format.h>

#include "scene/settings.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

std::optional<SettingValue> read_value(Fields& fields, const Setting& setting) {
    switch (setting.kind) {
        case SettingKind::word:
            if (setting.is_switch())
                if (const auto node = fields.any(setting.key, "\"on\" or \"off\""); node && node->value().is_boolean())
                    return SettingValue{node->value().get<bool>() ? 0u : 1u};
            if (const auto index = fields.word(setting.key, setting.words))
                return SettingValue{static_cast<std::uint32_t>(*index)};
            return std::nullopt;
        case SettingKind::number:
            if (const auto number = fields.integer(setting.key, setting.low, setting.high))
                return SettingValue{*number};
            return std::nullopt;
        case SettingKind::size:
            break;
    }
    return fields.integer_pair(setting.key, setting.low, setting.high);
}

void read_output(Fields& fields, const std::filesystem::path& folder, RenderSettings& settings) {
    if (!fields.has("output")) return;  // the command line may name it
    const std::optional<std::string_view> output = fields.text("output", "a file path");
    if (!output) return;
    // A path with a NUL would be cut there by the operating system, and another file written; with other control
    // characters it would be no name that anybody can see and type.
    if (output->empty() || !is_printable(*output)) {
        const char* expected = output->empty() ? "a file path" : "a file path without control characters";
        fields.fault("output", fmt::format("found {}, expected {}", in_quotes(*output), expected));
        return;
    }
    settings.output = (folder / *output).lexically_normal();
}

}  // namespace

RenderSettings read_renderer(const Node& renderer, const std::filesystem::path& folder, Report& report) {
    RenderSettings settings;
    Fields fields(renderer, "a renderer object", report);
    for (const Setting& setting : all_settings()) {
        if (!setting.required && !fields.has(setting.key)) continue;
        if (const auto value = read_value(fields, setting)) setting.member.set(settings, *value);
    }
    read_output(fields, folder, settings);
    for (const Conflict& conflict : conflicts(settings)) fields.fault(conflict.setting.key, conflict.message);
    fields.finish();
    return settings;
}

}  // namespace orrery
