// The table of settings against everything that is not made from it: the schema, the documentation, RenderSettings.
#include "scene/settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "scene/world.hpp"
#include "support/setting_json.hpp"

namespace orrery::test {
namespace {

std::string text_of_file(const std::string& name) {
    std::stringstream text;
    text << std::ifstream(scenes_folder() / name).rdbuf();
    return text.str();
}

SettingValue default_of(const Setting& setting) { return setting.member.get(RenderSettings{}); }

/// All words; the ends of a range and a number between them.
std::vector<SettingValue> values_of(const Setting& setting) {
    if (setting.kind == SettingKind::size) return {{1, 2}, {65536, 1}, {640, 480}};
    if (setting.kind == SettingKind::number)
        return {{setting.low}, {setting.low + (setting.high - setting.low) / 2}, {setting.high}};
    std::vector<SettingValue> values;
    for (std::uint32_t word = 0; word < setting.words.size(); ++word) values.push_back({word});
    return values;
}

/// The setting's property in the schema.
Json schema_of(const Setting& setting) {
    Json json = {{"description", fmt::format("{}.", setting.meaning)}};
    const Json number = {{"type", "integer"}, {"minimum", setting.low}, {"maximum", setting.high}};
    if (setting.kind == SettingKind::word) {
        json["enum"] = setting.words;
        if (setting.is_switch()) json["enum"].insert(json["enum"].end(), {true, false});
    } else if (setting.kind == SettingKind::number) {
        json.update(number);
    } else {
        json.update({{"type", "array"}, {"items", number}, {"minItems", 2}, {"maxItems", 2}});
    }
    if (!setting.required) json["default"] = in_file<Json>(setting, default_of(setting));
    return json;
}

/// The setting's line in scenes/README.md.
std::string line_of(const Setting& setting) {
    const bool has_default = !setting.required;
    std::string values;
    for (std::uint32_t word = 0; word < setting.words.size(); ++word) {
        const char* bold = has_default && default_of(setting)[0] == word ? "**" : "";
        values += fmt::format("{0}{1}`{2}`{1}", word == 0 ? "" : " ", bold, setting.words[word]);
    }
    if (setting.kind == SettingKind::number) {
        const bool bounded = setting.high != std::numeric_limits<std::uint32_t>::max();
        values = fmt::format("{} {}", setting.low, bounded ? fmt::format("to {}", setting.high) : "or more");
        if (has_default) values += fmt::format("; **{}**", default_of(setting)[0]);
    } else if (setting.kind == SettingKind::size) {
        values = fmt::format("[w, h], each {} to {}", setting.low, setting.high);
    }
    return fmt::format("| `{}` | `--{}` | {} | {} |\n", setting.key, setting.option, values, setting.meaning);
}

TEST(Settings, AreInTheSchema) {
    const Json schema = Json::parse(text_of_file("scene.schema.json"));
    const Json& renderer = schema["definitions"]["renderer"];
    std::set<std::string> known = {"output"}, required;
    for (const Setting& setting : all_settings()) {
        const std::string key(setting.key);
        known.insert(key);
        if (setting.required) required.insert(key);
        EXPECT_EQ(renderer["properties"].value(key, Json()), schema_of(setting))
            << "expected \"" << key << "\": " << schema_of(setting);
    }
    for (const auto& [key, property] : renderer["properties"].items()) EXPECT_TRUE(known.contains(key)) << key;
    EXPECT_EQ(renderer["required"].get<std::set<std::string>>(), required);
}

TEST(Settings, AreInTheDocumentation) {
    std::string table = "<!-- begin settings -->\n| key | option | values | meaning |\n|---|---|---|---|\n";
    for (const Setting& setting : all_settings()) table += line_of(setting);
    table += "<!-- end settings -->\n";
    EXPECT_NE(text_of_file("README.md").find(table), std::string::npos) << "expected in scenes/README.md:\n" << table;
}

TEST(Settings, HaveNamesOfTheirOwn) {
    std::set<std::string_view> keys, options;
    for (const Setting& setting : all_settings()) {
        EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
        EXPECT_TRUE(options.insert(setting.option).second) << setting.option;
        EXPECT_EQ(&orrery::setting(setting.option), &setting);
    }
}

TEST(Settings, TakeEveryValueFromSceneAndCommandLine) {
    for (const Setting& setting : all_settings()) {
        std::set<std::string> texts;
        for (const SettingValue& value : values_of(setting)) {
            const std::string text = text_of(setting, value);
            EXPECT_TRUE(texts.insert(text).second) << setting.key << ' ' << text;
            EXPECT_EQ(value_of(setting, text), value) << setting.key << ' ' << text;
            if (setting.kind == SettingKind::size) continue;  // which the memory may not hold
            Json json = world();
            json["scene"]["renderer"][std::string(setting.key)] = in_file<Json>(setting, value);
            const ReadResult result = read(json);
            ASSERT_TRUE(result.scene.has_value()) << listing(result);
            EXPECT_TRUE(result.diagnostics.empty()) << listing(result);
            EXPECT_EQ(setting.member.get(result.scene->settings), value) << setting.key << ' ' << text;
        }
    }
}

TEST(Settings, TakeNoOther) {
    for (const Setting& setting : all_settings()) {
        for (const std::string text : {"", "x", "0x1", "640x", "x480", "640X480", "640x480x1", "-1", "+1", " 1", "1 ",
                                       "1.0", "1e3", "65537x1", "1x0", "4294967296", "PT", "Mis"})
            EXPECT_EQ(value_of(setting, text), std::nullopt) << setting.key << ' ' << text;
        for (const Json& value : {Json(-1), Json(0.5), Json("x"), Json(nullptr), Json(4294967296), Json{1, 2, 3},
                                  Json{0, 1}, Json::object()}) {
            Json json = world();
            json["scene"]["renderer"][std::string(setting.key)] = value;
            const ReadResult result = read(json);
            ASSERT_EQ(result.diagnostics.size(), 1u) << setting.key << ' ' << value << listing(result);
            EXPECT_TRUE(result.diagnostics[0].where.starts_with("/scene/renderer/" + std::string(setting.key)))
                << listing(result);
        }
    }
}

/// Each is a member of its own.
TEST(Settings, ChangeNoOther) {
    for (const Setting& changed : all_settings()) {
        for (const SettingValue& value : values_of(changed)) {
            RenderSettings settings;
            settings.tonemap = ToneMap::linear;  // which else depends on the integrator
            const RenderSettings before = settings;
            changed.member.set(settings, value);
            for (const Setting& other : all_settings()) {
                EXPECT_EQ(other.member.get(settings), &other == &changed ? value : other.member.get(before))
                    << changed.key << ' ' << other.key;
            }
        }
    }
}

TEST(Settings, TheToneMapperOfDepthIsNone) {
    RenderSettings settings;
    EXPECT_EQ(tone_mapper(settings), ToneMap::sigmoid);
    settings.integrator = Integrator::depth;
    EXPECT_EQ(tone_mapper(settings), ToneMap::none);
    settings.tonemap = ToneMap::sigmoid;
    EXPECT_EQ(tone_mapper(settings), ToneMap::sigmoid);
}

}  // namespace
}  // namespace orrery::test
