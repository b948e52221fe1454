#include "cli/film_subject.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "cli/options.hpp"
#include "cli/process.hpp"
#include "scene/fingerprint.hpp"
#include "scene/settings.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

/// Of a goal; a film goes on with others, but for --adaptive.
constexpr std::string_view goal_error = "goal: error", goal_time = "goal: time", goal_samples = "goal: spp",
                           goal_adaptive = "goal: adaptive";

constexpr const char* no_crop = "off";

/// Empty where there is no such entry.
std::string_view value_in(const FilmSubject& subject, std::string_view key) {
    const auto entry = std::ranges::find(subject, key, [](const auto& pair) { return std::string_view(pair.first); });
    return entry != subject.end() ? std::string_view(entry->second) : std::string_view();
}

template <class Number>
Number number_in(const FilmSubject& subject, std::string_view key, Number least = 0) {
    const std::string_view text = value_in(subject, key);
    Number number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool good = error == std::errc() && end == text.data() + text.size() && number >= least;
    return good ? number : throw std::runtime_error(fmt::format("damaged: found no \"{}\" in it", key));
}

/// Instruction sets that round alike.
std::string_view arithmetic(Isa isa) { return isa == Isa::sse2 ? "of sse2" : "of scalar, avx2 and avx512"; }

/// What images show and films do not.
bool is_of_images(std::string_view key) { return key == "scene" || key == "tonemap" || key == "exposure"; }

/// Whether a film with another value may go on.
bool may_change(std::string_view key) {
    return is_of_images(key) || key == "spp" || (key.starts_with("goal: ") && key != goal_adaptive);
}

std::string difference(const std::string& key, std::string_view found, std::string_view asked) {
    const bool in_digits = key == "camera" || key == "spheres" || key == "point lights" || key == "background";
    if (in_digits) return fmt::format("the {} of the scene {} not the same", key, key.ends_with('s') ? "are" : "is");
    const auto text = [](std::string_view value) { return value.empty() ? "none" : in_quotes(value); };
    return fmt::format("{}: found {}, expected {}", key == goal_adaptive ? "adaptive" : key.c_str(), text(found),
                       text(asked));
}

}  // namespace

FilmSubject film_subject(const Plan& plan, const Goal& goal, Isa isa, double exposure) {
    FilmSubject subject = {{"version", std::string(version())}, {"scene", plan.scene().file.filename().string()}};
    for (auto& part : fingerprints(plan.scene())) subject.push_back(std::move(part));
    subject.emplace_back("arithmetic", arithmetic(isa));
    for (const Setting& setting : all_settings())
        if (setting.matters(plan.settings())) subject.emplace_back(setting.option, text_of(setting, plan.settings()));
    const std::optional<Window>& crop = plan.settings().crop;
    subject.emplace_back("crop", crop ? text_of(*crop) : no_crop);
    subject.emplace_back("exposure", fmt::format("{}", exposure));
    if (goal.asked()) {
        subject.emplace_back(goal_error, fmt::format("{}", goal.error));
        subject.emplace_back(goal_time, fmt::format("{}", goal.seconds));
        subject.emplace_back(goal_samples, fmt::format("{}", goal.samples));
        subject.emplace_back(goal_adaptive, on_off[goal.adaptive ? 0 : 1]);
    }
    return subject;
}

std::vector<std::string> differences(const FilmSubject& found, const FilmSubject& asked) {
    std::vector<std::string> list;
    for (const auto& [key, value] : asked) {
        // A film without passes has not decided whether they are adaptive.
        const std::string_view other = value_in(found, key);
        if (other != value && !may_change(key) && !(key == goal_adaptive && other.empty()))
            list.push_back(difference(key, other, value));
    }
    return list;
}

std::vector<std::string> differences_of_shards(const FilmSubject& found, const FilmSubject& first) {
    std::vector<std::string> list;
    for (const auto& [key, value] : first)
        if (const std::string_view other = value_in(found, key); other != value && !is_of_images(key))
            list.push_back(difference(key, other, value));
    return list;
}

Making making_of(const FilmSubject& subject) {
    Making making;
    making.scene = value_in(subject, "scene");
    making.version = value_in(subject, "version");
    making.exposure = number_in<double>(subject, "exposure", -100);
    RenderSettings& settings = making.settings;
    for (const Setting& setting : all_settings()) {
        const std::string_view text = value_in(subject, setting.option);
        if (text.empty()) continue;
        const auto value = value_of(setting, text);
        if (!value) throw std::runtime_error(fmt::format("damaged: found {} for its {}", in_quotes(text), setting.key));
        setting.member.set(settings, *value);
    }
    if (const std::string_view crop = value_in(subject, "crop"); crop != no_crop) settings.crop = parse_window(crop);
    if (!value_in(subject, goal_adaptive).empty()) {
        making.goal.error = number_in<double>(subject, goal_error);
        making.goal.seconds = number_in<double>(subject, goal_time);
        making.goal.samples = number_in<std::uint64_t>(subject, goal_samples);
        making.goal.adaptive = value_in(subject, goal_adaptive) == on_off[0];
    }
    return making;
}

}  // namespace orrery
