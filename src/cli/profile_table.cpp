#include "cli/profile_table.hpp"

#include <fmt/format.h>

namespace orrery {
namespace {

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

}  // namespace

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

}  // namespace orrery
