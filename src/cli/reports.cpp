#include "cli/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/options.hpp"
#include "cli/process.hpp"
#include "scene/counted.hpp"
#include "scene/settings.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

/// Closest and shadow rays together, over the wall time.
double rays_per_second(const RenderStats& stats) {
    // The clock may not have moved during a render of one pixel.
    return stats.seconds > 0 ? static_cast<double>(stats.closest_rays + stats.shadow_rays) / stats.seconds : 0;
}

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

std::string row(std::string_view stage, std::string_view bounce, const StageCost& cost, double whole) {
    const auto rays = static_cast<double>(cost.rays);
    const std::string per_ray = cost.rays != 0 ? fmt::format("{:.2f}", cost.seconds / rays * 1e9) : "-";
    return fmt::format("{:<10}{:>7}{:>10.3f}{:>8.1f}{:>11.3f}{:>9}{:>9.2f}\n", stage, bounce, cost.seconds,
                       100 * cost.seconds / whole, rays / 1e6, per_ray, static_cast<double>(cost.bytes) / 1e9);
}

/// As row, with the share of lanes filled, which only stages whose vectors hold rays have.
std::string row_with_lanes(std::string_view stage, std::string_view bounce, const StageCost& cost, double whole,
                           double filled) {
    std::string line = row(stage, bounce, cost, whole);
    line.insert(line.size() - 1, filled > 0 ? fmt::format("{:>9.1f}", 100 * filled) : fmt::format("{:>9}", "-"));
    return line;
}

using Json = nlohmann::ordered_json;

/// By StopReason.
constexpr const char* stop_names[] = {"samples", "error", "time"};

Json stage_seconds(const RenderStats& stats) {
    Json seconds = Json::object();
    for (std::size_t stage = 0; stage < stage_names.size(); ++stage)
        seconds[stage_names[stage]] = stats.profile.total(static_cast<Stage>(stage)).seconds;
    return seconds;
}

Json profile(const RenderStats& stats) {
    Json rows = Json::array();
    for (std::size_t bounce = 0; bounce < profile_bounces; ++bounce) {
        for (std::size_t stage = 0; stage < stage_names.size(); ++stage) {
            const StageCost& cost = stats.profile.bounces[bounce][stage];
            if (cost.seconds == 0) continue;
            rows.push_back({{"stage", stage_names[stage]},
                            {"bounce", bounce},
                            {"seconds", cost.seconds},
                            {"rays", cost.rays},
                            {"lanes", cost.lanes},
                            {"lanes_filled", cost.filled},
                            {"bytes", cost.bytes}});
        }
    }
    rows.push_back({{"stage", "others"}, {"seconds", stats.profile.others}});
    return rows;
}

/// null where nothing tells, as with one sample per pixel; where an error is known to be "at least", its upper end.
Json error_json(const RootMeanSquare& error) {
    if (!std::isfinite(error.value)) return nullptr;
    const Json high = std::isfinite(error.high) ? Json(error.high) : Json(nullptr);
    return {{"estimate", error.value}, {"interval_95", {error.low, high}}};
}

/// null where the scene or --spp gave the number of samples.
Json goal_json(const Goal& goal) {
    if (!goal.asked()) return nullptr;
    Json json = Json::object();
    if (goal.error > 0) json["error"] = goal.error;
    if (goal.seconds > 0) json["seconds"] = goal.seconds;
    if (goal.samples > 0) json["samples_per_pixel"] = goal.samples;
    json["adaptive"] = goal.adaptive;
    return json;
}

Json decisions(const Plan& plan) {
    Json list = Json::array();
    for (const Decision& decision : plan.decisions())
        list.push_back({{"part", decision.part}, {"runs", decision.runs}, {"reason", decision.reason}});
    return list;
}

/// The options that, given to `orrery render`, make this image whatever the scene's renderer says and whatever the
/// defaults become. Only those that matter to it: a tone mapper to files that are tone mapped, light transport to path
/// tracing. In a fixed order, so that equal images carry equal text.
std::string canonical_options(const Making& making, ImageFormat format) {
    const RenderSettings& settings = making.settings;
    const Goal& goal = making.goal;
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
    if (settings.crop) add("crop", text_of(*settings.crop));
    if (eight_bit && making.exposure != 0) add("exposure", making.exposure);
    return text;
}

}  // namespace

std::string summary(const Plan& plan, const Goal& goal, const RenderStats& stats) {
    const RenderSettings& settings = plan.settings();
    return fmt::format("{}: {} x {}, {} in {:.2f} s, {:.1f} Mrays/s ({}, {}){}{}\n",
                       printable_whole(plan.scene().file.string()), settings.window().width(),
                       settings.window().height(), samples_text(stats), stats.seconds, rays_per_second(stats) / 1e6,
                       isa_name(stats.isa), counted(stats.threads, "thread"), error_text(stats.error.relative),
                       stop_text(goal, stats.stopped_by));
}

std::string film_summary(double samples_per_pixel, const ImageError& error) {
    return fmt::format("{:.4g} sample{} per pixel{}", samples_per_pixel, samples_per_pixel == 1 ? "" : "s",
                       error_text(error.relative));
}

std::string profile_table(const RenderStats& stats) {
    const Profile& profile = stats.profile;
    const double whole = stats.seconds * stats.threads;
    std::string text = fmt::format("{:<10}{:>7}{:>10}{:>8}{:>11}{:>9}{:>9}{:>9}\n", "stage", "bounce", "seconds",
                                   "share %", "Mrays", "ns/ray", "GB", "lanes %");
    const auto filled = [](const StageCost& cost) {
        return cost.lanes != 0 ? static_cast<double>(cost.filled) / static_cast<double>(cost.lanes) : 0;
    };
    for (std::size_t b = 0; b < profile_bounces; ++b) {
        const std::string bounce = b + 1 < profile_bounces ? fmt::format("{}", b) : fmt::format("{}+", b);
        for (std::size_t s = 0; s < stage_names.size(); ++s) {
            const StageCost& cost = profile.bounces[b][s];
            if (cost.seconds > 0) text += row_with_lanes(stage_names[s], bounce, cost, whole, filled(cost));
        }
    }
    for (std::size_t s = 0; s < stage_names.size(); ++s) {
        const StageCost cost = profile.total(static_cast<Stage>(s));
        if (cost.seconds > 0) text += row_with_lanes(stage_names[s], "all", cost, whole, filled(cost));
    }
    StageCost others;
    others.seconds = profile.others;
    return text + row("others", "", others, whole);
}

std::string statistics_json(const Plan& plan, const Goal& goal, const RenderStats& stats,
                            const std::vector<std::filesystem::path>& images) {
    Json json = {
        {"scene", plan.scene().file.string()},
        {"images", Json::array()},
        {"version", version()},
    };
    for (const Setting& setting : all_settings()) {
        const SettingValue value = setting.member.get(plan.settings());
        std::string key(setting.option);
        std::ranges::replace(key, '-', '_');
        json[key] = setting.kind == SettingKind::word     ? Json(text_of(setting, value))
                    : setting.kind == SettingKind::number ? Json(value[0])
                                                          : Json(value);
    }
    if (const auto& crop = plan.settings().crop) json["crop"] = {crop->x0, crop->y0, crop->x1, crop->y1};
    json.update({
        {"samples_per_pixel", stats.samples_per_pixel},
        {"samples_of_any_pixel", {stats.least_samples, stats.most_samples}},
        {"goal", goal_json(goal)},
        {"stopped_by", stop_names[static_cast<std::size_t>(stats.stopped_by)]},
        {"passes", stats.passes},
        {"isa", isa_name(stats.isa)},
        {"threads", stats.threads},
        {"wave_size", stats.wave_size},
        {"bytes_per_ray", stats.bytes_per_ray},
        {"queue_bytes_per_thread", stats.queue_bytes},
        {"seconds", stats.seconds},
        {"rays", {{"closest", stats.closest_rays}, {"shadow", stats.shadow_rays}}},
        {"rays_per_second", rays_per_second(stats)},
        {"stage_seconds", stage_seconds(stats)},
        {"profile", profile(stats)},
        {"relative_error", error_json(stats.error.relative)},
        {"rmse", error_json(stats.error.absolute)},
        {"dropped_samples", stats.dropped_samples},
        {"plan", decisions(plan)},
    });
    for (const auto& image : images) json["images"].push_back(image.string());
    return json_text(json);
}

Metadata image_metadata(const Making& making, ImageFormat format) {
    Metadata metadata = {{"scene", making.scene},
                         {"seed", std::to_string(making.settings.seed)},
                         {"samples", fmt::format("{}", making.samples)},
                         {"options", canonical_options(making, format)},
                         {"version", fmt::format("orrery {}", making.version)}};
    if (making.content != "radiance") metadata.emplace_back("content", making.content);
    return metadata;
}

std::string json_text(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace orrery
