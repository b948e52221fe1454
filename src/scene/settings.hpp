// The settings of a render: one table, one row a setting. Scene files, the command line and its help, `info`, --stats,
// image metadata and the comparison of settings (bench/tradeoff) take them from here; scenes/scene.schema.json and the
// table in scenes/README.md are compared with it by a test.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

namespace orrery {

/// A setting's value: the index of one of its words, or its number, or its two numbers.
using SettingValue = std::array<std::uint32_t, 2>;

enum class SettingKind : std::uint8_t { word, number, size };

struct SettingMember {
    SettingValue (*get)(const RenderSettings&) = nullptr;
    void (*set)(RenderSettings&, SettingValue) = nullptr;
};

struct Setting {
    std::string_view key = {};     ///< in a scene's `renderer`
    std::string_view option = {};  ///< on the command line, behind two dashes
    std::string_view group = {};   ///< heading in the help
    SettingKind kind = SettingKind::number;
    std::vector<std::string_view> words = {};  ///< as in a scene; everywhere else in small letters
    std::uint32_t low = 0, high = 0;           ///< of each number
    bool required = false;                     ///< a scene must say it; else RenderSettings{} has the default
    bool same_expectation = false;             ///< whatever its value: it trades time for noise
    bool but_for_point_lights = false;         ///< it changes what these send, in scenes that have some
    std::string_view meaning = {};             ///< a sentence without its full stop
    SettingMember member = {};                 ///< what it is of RenderSettings
    /// Whether the image can depend on it, the other settings being as they are.
    bool (*matters)(const RenderSettings&) = [](const RenderSettings&) { return true; };

    /// Whether its words are "on" and "off": a scene may then also say true and false.
    bool is_switch() const { return words.size() == 2 && words[0] == "on"; }
};

/// The table, in the order in which settings are listed.
std::span<const Setting> all_settings();

/// The row of an option that is in the table.
const Setting& setting(std::string_view option);

/// A value as the command line takes it: "mis", "8", "640x480".
std::string text_of(const Setting& setting, SettingValue value);
inline std::string text_of(const Setting& setting, const RenderSettings& settings) {
    return text_of(setting, setting.member.get(settings));
}

/// What `text` on the command line stands for; empty where it is none of the setting's values.
std::optional<SettingValue> value_of(const Setting& setting, std::string_view text);

/// The values in words: "naive|nee|mis", "a whole number from 1 to 9".
std::string expected_text(const Setting& setting);

/// Decimal digits alone, from `low` to `high`.
std::optional<std::uint32_t> whole_number(std::string_view text, std::uint32_t low, std::uint32_t high);

/// Settings that are in range one by one and cannot be together, or not on this machine: too deep a Whitted tree, an
/// image too large for the memory.
struct Conflict {
    const Setting& setting;  ///< the one to change
    std::string message;     ///< found, expected
};
std::vector<Conflict> conflicts(const RenderSettings& settings);

/// The settings' tone mapper; where they name none, sigmoid for radiance and none for DEPTH, which lies in [0, 1)
/// already.
ToneMap tone_mapper(const RenderSettings& settings);

}  // namespace orrery
