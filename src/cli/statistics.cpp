#include "cli/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/json_text.hpp"
#include "cli/version.hpp"
#include "scene/settings.hpp"

namespace orrery {
namespace {

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

}  // namespace

double rays_per_second(const RenderStats& stats) {
    // The clock may not have moved during a render of one pixel.
    return stats.seconds > 0 ? static_cast<double>(stats.closest_rays + stats.shadow_rays) / stats.seconds : 0;
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

}  // namespace orrery
