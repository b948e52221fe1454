// Every kind of fault, alone and in company: place, wording, severity.
#include <gtest/gtest.h>

#include <set>

#include "scene/faults.hpp"

namespace orrery::test {
namespace {

class FaultTest : public testing::TestWithParam<Fault> {};

TEST_P(FaultTest, IsNamedOnceAtItsPlace) {
    const Fault& fault = GetParam();
    const ReadResult result = read(broken_world(fault));
    // An entry that cannot be identified or a registry that cannot be read must not make every reference to it a fault,
    // but an entry that is no object leaves the id it should have had dangling: those messages are right.
    const bool leaves_danglers = fault.name == "entry_is_a_number";
    ASSERT_EQ(result.diagnostics.size(), leaves_danglers ? 3u : 1u) << listing(result);

    const Diagnostic& diagnostic = result.diagnostics[0];
    EXPECT_EQ(diagnostic.severity, fault.severity) << listing(result);
    EXPECT_EQ(diagnostic.where, fault.where) << listing(result);
    for (const std::string& part : fault.says) {
        EXPECT_NE(diagnostic.message.find(part), std::string::npos) << "lacks " << part << ": " << listing(result);
    }
    EXPECT_EQ(result.scene.has_value(), fault.severity == Severity::warning);
}

INSTANTIATE_TEST_SUITE_P(Table, FaultTest, testing::ValuesIn(faults()),
                         [](const testing::TestParamInfo<Fault>& test) { return test.param.name; });

TEST(Faults, SoundWorldHasNone) {
    const ReadResult result = read(world());
    EXPECT_TRUE(result.diagnostics.empty()) << listing(result);
    EXPECT_TRUE(result.scene.has_value());
}

TEST(Faults, SeveralAreAllReported) {
    Json json = world();
    json["cameras"][0]["fov"] = 200;
    json["materials"][0]["rho"] = {2, -1, "x"};
    json["shapes"][1]["radius"] = -1;
    json["lights"][0]["power"] = nullptr;
    json["scene"]["primitives"][3]["material"] = "glas";
    json["scene"]["renderer"]["dimensions"] = {0, 70000};
    json["scene"]["renderer"]["type"] = "PR";
    const ReadResult result = read(json);
    std::multiset<std::string> places;
    for (const Diagnostic& diagnostic : result.diagnostics) places.insert(diagnostic.where);
    EXPECT_EQ(places, (std::multiset<std::string>{"/cameras/0/fov", "/materials/0/rho/0", "/materials/0/rho/1",
                                                  "/materials/0/rho/2", "/shapes/1/radius", "/lights/0/power",
                                                  "/scene/primitives/3/material", "/scene/renderer/dimensions/0",
                                                  "/scene/renderer/dimensions/1", "/scene/renderer/type"}))
        << listing(result);
    EXPECT_FALSE(result.scene.has_value());
}

/// Fields in an order of their own, each read where it stands.
TEST(Faults, FieldsComeInAnyOrder) {
    std::string text = world().dump();
    const std::string in_order = R"({"aspect":1,"distance":5,"fov":45,"id":"eye",)";
    const std::size_t at = text.find(in_order);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, in_order.size(), R"({"fov":45,"id":"eye","distance":5,"aspect":1,)");
    const ReadResult result = read_scene_text(text, "x.json");
    EXPECT_TRUE(result.diagnostics.empty()) << listing(result);
}

TEST(Faults, WhittedDepthIsLimitedAndOthersAreNot) {
    Json json = world();
    json["scene"]["renderer"]["depth"] = 21;
    EXPECT_TRUE(read(json).scene.has_value());
    json["scene"]["renderer"]["type"] = "WRT";
    const ReadResult result = read(json);
    ASSERT_EQ(result.diagnostics.size(), 1u) << listing(result);
    EXPECT_EQ(result.diagnostics[0].where, "/scene/renderer/depth");
    EXPECT_NE(result.diagnostics[0].message.find("found 21, expected an integer from 0 to 20"), std::string::npos);
    json["scene"]["renderer"]["depth"] = 20;
    EXPECT_TRUE(read(json).scene.has_value());
}

TEST(Faults, ReferenceToEmptyRegistrySaysSo) {
    Json json = world();
    json["materials"] = Json::array();
    const ReadResult result = read(json);
    ASSERT_EQ(result.diagnostics.size(), 6u) << listing(result);
    for (const Diagnostic& diagnostic : result.diagnostics) {
        EXPECT_NE(diagnostic.message.find("no material is declared"), std::string::npos) << diagnostic.message;
    }
}

TEST(Faults, UnlistedEmissivePrimitiveStillEmits) {
    Json json = world();
    json["scene"]["lights"] = Json::array();
    const ReadResult result = read(json);
    ASSERT_TRUE(result.scene.has_value()) << listing(result);
    EXPECT_TRUE(result.diagnostics.empty()) << listing(result);
    EXPECT_TRUE(result.scene->point_lights.empty());
    EXPECT_EQ(result.scene->primitives.at(5).emission, glm::dvec3(30, 20, 10));
}

TEST(Faults, LightThatOnlyAPrimitiveNamesIsUsed) {
    Json json = world();
    json["scene"]["lights"] = Json::array();
    json["lights"][1]["power"] = {-1, 0, 0};
    const ReadResult result = read(json);
    ASSERT_EQ(result.diagnostics.size(), 1u) << listing(result);
    EXPECT_EQ(result.diagnostics[0].where, "/lights/1/power/0");
    EXPECT_EQ(result.diagnostics[0].severity, Severity::error);
}

TEST(Faults, FormatNamesFilePlaceAndSeverity) {
    EXPECT_EQ(format_diagnostic("a.json", {Severity::error, "3:7", "found this"}), "a.json:3:7: error: found this");
    EXPECT_EQ(format_diagnostic("a.json", {Severity::warning, "/scene", "found that"}),
              "a.json:/scene: warning: found that");
    EXPECT_EQ(format_diagnostic("a.json", {Severity::error, "", "cannot open"}), "a.json: error: cannot open");
}

TEST(Faults, UnreadableFileIsOneErrorWithoutPlace) {
    for (const auto& path : {scenes_folder() / "no such scene.json", scenes_folder()}) {
        const ReadResult result = read_scene(path);
        ASSERT_EQ(result.diagnostics.size(), 1u) << path;
        EXPECT_EQ(result.diagnostics[0].severity, Severity::error);
        EXPECT_EQ(result.diagnostics[0].where, "");
        EXPECT_FALSE(result.scene.has_value());
    }
}

}  // namespace
}  // namespace orrery::test
