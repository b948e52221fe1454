// Every row of the table of settings does what its option says, and is told wherever settings are.
#include "scene/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/setting_json.hpp"
#include "world.hpp"

namespace orrery::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using Json = nlohmann::json;

class Settings : public ::testing::TestWithParam<const Setting*> {
protected:
    Settings() { store(folder_ / "scene.json", to_bytes(world_.dump())); }

    /// Another value than the scene's or the default: the last word, the largest number that renders soon.
    SettingValue another() const {
        if (setting_.kind == SettingKind::size) return {7, 5};
        if (setting_.kind == SettingKind::number)
            return {std::min(setting_.member.get(RenderSettings{})[0] + 9, setting_.high)};
        const auto last = static_cast<std::uint32_t>(setting_.words.size() - 1);
        return {last != setting_.member.get(RenderSettings{})[0] ? last : 0};
    }
    /// As --stats has it.
    Json told(SettingValue value) const {
        return setting_.kind == SettingKind::word ? Json(text_of(setting_, value)) : in_file<Json>(setting_, value);
    }
    std::string option() const { return "--" + std::string(setting_.option); }
    std::string underscored() const {
        std::string name(setting_.option);
        std::ranges::replace(name, '-', '_');
        return name;
    }

    Outcome run(std::vector<std::string> arguments) const { return orrery(arguments, {.folder = folder_.path()}); }
    Json stats(const std::vector<std::string>& options) const {
        std::vector<std::string> arguments = {"render", "scene.json", "-o", "x.png", "--stats", "-"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
        return Json::parse(outcome.output);
    }

    const Setting& setting_ = *GetParam();
    const TemporaryFolder folder_;
    Json world_ = small_world();
};

TEST_P(Settings, IsTakenFromTheCommandLine) {
    ASSERT_NE(stats({})[underscored()], told(another()));
    EXPECT_EQ(stats({option(), text_of(setting_, another())})[underscored()], told(another()));
    EXPECT_THAT(load(folder_ / "x.png"), HasSubstr(option() + " " + text_of(setting_, another())));
}

TEST_P(Settings, IsTakenFromTheSceneUnlessTheCommandLineSaysOtherwise) {
    world_["scene"]["renderer"][std::string(setting_.key)] = in_file<Json>(setting_, another());
    store(folder_ / "scene.json", to_bytes(world_.dump()));
    EXPECT_EQ(stats({})[underscored()], told(another()));
    const SettingValue third = setting_.kind == SettingKind::size     ? SettingValue{3, 2}
                               : setting_.kind == SettingKind::number ? SettingValue{4}
                                                                      : SettingValue{another()[0] == 1 ? 0u : 1u};
    EXPECT_EQ(stats({option(), text_of(setting_, third)})[underscored()], told(third));
}

TEST_P(Settings, IsShownByInfo) {
    EXPECT_THAT(run({"info", "scene.json", option(), text_of(setting_, another())}).output,
                ContainsRegex(std::string(setting_.option) + " +" + text_of(setting_, another()) + "\n"));
}

TEST_P(Settings, IsExplainedByTheHelpOfRenderAndInfo) {
    for (const char* command : {"render", "info"}) {
        std::string help = run({command, "--help"}).output;
        EXPECT_THAT(help, HasSubstr(option() + " "));
        const auto without_blanks = [](std::string text) {
            std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
            return text;
        };
        EXPECT_THAT(without_blanks(help), HasSubstr(without_blanks(std::string(setting_.meaning))));
    }
}

std::vector<const Setting*> rows() {
    std::vector<const Setting*> rows;
    for (const Setting& setting : all_settings()) rows.push_back(&setting);
    return rows;
}

INSTANTIATE_TEST_SUITE_P(Table, Settings, ::testing::ValuesIn(rows()),
                         [](const ::testing::TestParamInfo<const Setting*>& test) {
                             std::string name(test.param->option);
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace orrery::test
