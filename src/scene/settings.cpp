#include "scene/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <type_traits>

#include "scene/image_memory.hpp"
#include "scene/spelling.hpp"
#include "system/memory.hpp"

namespace orrery {
namespace {

constexpr std::uint32_t any = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t largest_dimension = 65536;
constexpr std::uint32_t deepest_whitted = 20;  // two branches per hit: 2^20 rays per sample is as far as it goes

/// A number, or an enumeration whose values are numbered as the setting's words; true is "on", the first.
template <auto pointer>
constexpr SettingMember member = {
    .get = [](const RenderSettings& settings) -> SettingValue {
        const auto value = settings.*pointer;
        if constexpr (std::is_same_v<decltype(value), const bool>) return {!value};
        return {static_cast<std::uint32_t>(value)};
    },
    .set =
        [](RenderSettings& settings, SettingValue value) {
            using Member = std::remove_reference_t<decltype(settings.*pointer)>;
            settings.*pointer = static_cast<Member>(std::is_same_v<Member, bool> ? value[0] == 0 : value[0]);
        }};

bool with_light(const RenderSettings& s) { return s.integrator != Integrator::depth; }
bool with_paths(const RenderSettings& s) { return s.integrator == Integrator::path_tracing; }
bool with_roulette(const RenderSettings& s) { return with_paths(s) && s.roulette; }

std::vector<Setting> table() {
    using S = RenderSettings;
    constexpr auto word = SettingKind::word;
    return {
        // clang-format off
        {.key = "type", .option = "integrator", .group = "Method", .kind = word, .words = {"PT", "WRT", "DEPTH"},
         .required = true, .meaning = "Path tracing, Whitted ray tracing, or the distance to the first hit",
         .member = member<&S::integrator>},
        {.key = "dimensions", .option = "size", .group = "Image", .kind = SettingKind::size, .low = 1,
         .high = largest_dimension, .required = true,
         .meaning = "Width and height of the image in pixels; the camera's view stays as it is",
         .member = {[](const S& s) { return SettingValue{s.width, s.height}; },
                    [](S& s, SettingValue value) { s.width = value[0], s.height = value[1]; }}},
        {.key = "samples", .option = "spp", .group = "Image", .low = 1, .high = any, .required = true,
         .meaning = "Samples per pixel; stratified takes the square number below, sobol the even one and is at its best "
                    "with powers of two",
         .member = member<&S::samples>},
        {.key = "estimator", .option = "estimator", .group = "Method", .kind = word,
         .words = {"uniform", "stratified", "sobol"}, .same_expectation = true,
         .meaning = "Samples of a pixel: independent; stratified, one per cell of a grid; or Sobol's sequence in all "
                    "dimensions of a path",
         .member = member<&S::estimator>},
        {.key = "seed", .option = "seed", .group = "Image", .high = any,
         .meaning = "Another seed is another noise; the same one, the same file", .member = member<&S::seed>},
        {.key = "depth", .option = "depth", .group = "Method", .high = any, .required = true,
         .meaning = "Greatest number of scattering events on a path from eye to light; at most 20 for Whitted",
         .member = member<&S::depth>, .matters = with_light},
        {.key = "light sampling", .option = "light-sampling", .group = "Method", .kind = word,
         .words = {"area", "cone", "exact"}, .same_expectation = true,
         .meaning = "Points on a spherical light: uniform over its surface, or over the cone it subtends; or, with "
                    "exact, no samples where its light is known in closed form",
         .member = member<&S::light_sampling>, .matters = with_light},
        {.key = "transport", .option = "transport", .group = "Method", .kind = word, .words = {"naive", "nee", "mis"},
         .same_expectation = true,
         .meaning = "Area lights are found by the paths that hit them, sampled (next event estimation), or both "
                    "(multiple importance sampling)",
         .member = member<&S::transport>, .matters = with_paths},
        {.key = "light choice", .option = "light-choice", .group = "Method", .kind = word,
         .words = {"all", "uniform", "power"}, .same_expectation = true,
         .meaning = "Lights sampled at a vertex of a path: all, or one, chosen uniformly or by emitted power",
         .member = member<&S::light_choice>, .matters = with_paths},
        {.key = "caustics", .option = "caustics", .group = "Method", .kind = word, .words = {"on", "off"},
         .same_expectation = true, .but_for_point_lights = true,
         .meaning = "Light that comes to a surface over one glass, mirror or glossy sphere is sampled on purpose; off "
                    "leaves out that of point lights",
         .member = member<&S::caustics>, .matters = with_paths},
        {.key = "guide", .option = "guide", .group = "Method", .kind = word, .words = {"auto", "on", "off"},
         .same_expectation = true,
         .meaning = "Bounces off diffuse surfaces are guided to spots that lamps near diffuse spheres make on them; auto "
                    "does so where that pays",
         .member = member<&S::guide>, .matters = with_paths},
        {.key = "roulette", .option = "roulette", .group = "Method", .kind = word, .words = {"on", "off"},
         .same_expectation = true, .meaning = "Russian roulette ends paths of low throughput",
         .member = member<&S::roulette>, .matters = with_paths},
        {.key = "roulette from", .option = "roulette-from", .group = "Method", .high = any, .same_expectation = true,
         .meaning = "Scattering events at the beginning of a path that are not followed by Russian roulette",
         .member = member<&S::roulette_from>, .matters = with_roulette},
        {.key = "tonemap", .option = "tonemap", .group = "Image", .kind = word, .words = {"sigmoid", "linear", "none", "srgb"},
         .meaning = "From radiance I to 8 bit: I/(1+I), I/max(I), I clamped to 1, or that as screens take it; the default for DEPTH is none",
         .member = {[](const S& s) { return SettingValue{static_cast<std::uint32_t>(tone_mapper(s))}; },
                    [](S& s, SettingValue value) { s.tonemap = static_cast<ToneMap>(value[0]); }}},
        {.key = "precision", .option = "precision", .group = "Method", .kind = word,
         .words = {"auto", "float", "double"}, .same_expectation = true,
         .meaning = "Number type to compute in; auto is float where that is good enough for the scene, else double",
         .member = member<&S::precision>},
        // clang-format on
    };
}

std::string lower_case(std::string_view word) {
    std::string text(word);
    std::ranges::transform(text, text.begin(), lower);
    return text;
}

}  // namespace

std::span<const Setting> all_settings() {
    static const std::vector<Setting> settings = table();
    return settings;
}

const Setting& setting(std::string_view option) { return *std::ranges::find(all_settings(), option, &Setting::option); }

std::string text_of(const Setting& setting, SettingValue value) {
    switch (setting.kind) {
        case SettingKind::word:
            return lower_case(setting.words.at(value[0]));
        case SettingKind::number:
            return fmt::format("{}", value[0]);
        case SettingKind::size:
            break;
    }
    return fmt::format("{}x{}", value[0], value[1]);
}

std::optional<SettingValue> value_of(const Setting& setting, std::string_view text) {
    if (setting.kind == SettingKind::word) {
        const auto word =
            std::ranges::find(setting.words, text, [](std::string_view known) { return lower_case(known); });
        if (word == setting.words.end()) return std::nullopt;
        return SettingValue{static_cast<std::uint32_t>(word - setting.words.begin())};
    }
    const auto number = [&](std::string_view digits) { return whole_number(digits, setting.low, setting.high); };
    if (setting.kind == SettingKind::number) {
        const auto value = number(text);
        return value ? std::optional(SettingValue{*value}) : std::nullopt;
    }
    const std::size_t cross = std::min(text.find('x'), text.size());
    const auto width = number(text.substr(0, cross)), height = number(text.substr(std::min(cross + 1, text.size())));
    return width && height ? std::optional(SettingValue{*width, *height}) : std::nullopt;
}

std::string expected_text(const Setting& setting) {
    if (setting.kind == SettingKind::word) return lower_case(fmt::format("{}", fmt::join(setting.words, "|")));
    const std::string range = fmt::format("from {} to {}", setting.low, setting.high);
    if (setting.kind == SettingKind::number) return "a whole number " + range;
    return "WIDTHxHEIGHT in pixels such as 640x480, each " + range;
}

std::optional<std::uint32_t> whole_number(std::string_view text, std::uint32_t low, std::uint32_t high) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || value < low || value > high) return std::nullopt;
    return value;
}

std::vector<Conflict> conflicts(const RenderSettings& settings) {
    std::vector<Conflict> found;
    if (settings.integrator == Integrator::whitted && settings.depth > deepest_whitted) {
        found.push_back({setting("depth"), fmt::format("found {}, expected an integer from 0 to {} for Whitted ray "
                                                       "tracing",
                                                       settings.depth, deepest_whitted)});
    }
    if (auto fault = too_many_pixels(settings.window().width(), settings.window().height(), memory_limit()))
        found.push_back({setting("size"), std::move(*fault)});
    return found;
}

ToneMap tone_mapper(const RenderSettings& settings) {
    return settings.tonemap.value_or(settings.integrator == Integrator::depth ? ToneMap::none : ToneMap::sigmoid);
}

}  // namespace orrery
