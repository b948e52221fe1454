// scene.schema.json and the reader agree: what the schema rejects the reader remarks on, what the reader accepts
// without a remark the schema accepts, and what only the reader can see is marked so in the table of faults.
#include <gtest/gtest.h>

#include <fstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "scene/faults.hpp"

namespace orrery::test {
namespace {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

Json load(const std::filesystem::path& path) {
    std::ifstream stream(path);
    return Json::parse(stream);
}

bool schema_accepts(const Json& json) {
    static const valijson::Schema& schema = *[] {
        // Kept for the life of the process, so that no order of destruction matters.
        auto* parsed = new valijson::Schema;
        const Json text = load(scenes_folder() / "scene.schema.json");
        valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(text), *parsed);
        return parsed;
    }();
    valijson::Validator validator;
    return validator.validate(schema, Adapter(json), nullptr);
}

TEST(SchemaTest, AcceptsEverySceneFile) {
    const auto files = scene_files();
    ASSERT_GE(files.size(), 20u);
    for (const auto& file : files) EXPECT_TRUE(schema_accepts(load(file))) << file;
}

TEST(SchemaTest, EverySceneFilePointsToIt) {
    for (const auto& file : scene_files()) {
        const Json json = load(file);
        ASSERT_TRUE(json.contains("$schema")) << file;
        const auto target = file.parent_path() / json["$schema"].get<std::string>();
        EXPECT_TRUE(std::filesystem::equivalent(target, scenes_folder() / "scene.schema.json")) << file;
    }
}

TEST(SchemaTest, AcceptsTheSoundWorld) { EXPECT_TRUE(schema_accepts(world())); }

class SchemaFaultTest : public testing::TestWithParam<Fault> {};

TEST_P(SchemaFaultTest, IsSeenByTheSchemaAsTheTableSays) {
    EXPECT_EQ(!schema_accepts(broken_world(GetParam())), GetParam().schema_sees_it);
}

INSTANTIATE_TEST_SUITE_P(Table, SchemaFaultTest, testing::ValuesIn(faults()),
                         [](const testing::TestParamInfo<Fault>& test) { return test.param.name; });

TEST(SchemaTest, KnowsTheDepthOfWhitted) {
    Json json = world();
    json["scene"]["renderer"]["depth"] = 21;
    EXPECT_TRUE(schema_accepts(json));
    json["scene"]["renderer"]["type"] = "WRT";
    EXPECT_FALSE(schema_accepts(json));
}

/// Removes or replaces the values of `json` one at a time, everywhere, and hands on each result.
template <class Visit>
void mutate_everywhere(const Json& json, const Visit& visit) {
    const Json flat = json.flatten();
    for (const auto& [pointer, old] : flat.items()) {
        const Json::json_pointer at(pointer);
        for (const Json& value :
             {Json(nullptr), Json("x"), Json(-1), Json(0.5), Json(1e20), Json::array(), Json::object()}) {
            Json changed = json;
            changed[at] = value;
            visit(changed, pointer + " = " + value.dump());
        }
        Json changed = json;
        Json& parent = changed[at.parent_pointer()];
        if (parent.is_object()) {
            parent.erase(at.back());
        } else {
            parent.erase(std::stoul(at.back()));
        }
        visit(changed, pointer + " removed");
    }
}

TEST(SchemaTest, RejectsNothingTheReaderAcceptsInSilence) {
    int silent = 0, rejected = 0;
    mutate_everywhere(world(), [&](const Json& changed, const std::string& what) {
        const ReadResult result = read(changed);
        const bool accepted = schema_accepts(changed);
        rejected += accepted ? 0 : 1;
        if (!result.diagnostics.empty()) return;
        ++silent;
        EXPECT_TRUE(accepted) << what;
    });
    EXPECT_GT(silent, 50);
    EXPECT_GT(rejected, 500);
}

}  // namespace
}  // namespace orrery::test
