// --stats: what a benchmark or a student reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "program.hpp"

namespace orrery::test {
namespace {

using ::testing::ElementsAre;
using Json = nlohmann::json;

TEST(Statistics, HaveEveryFieldWithASaneValue) {
    const TemporaryFolder folder;
    const std::string scene = scene_file("tests/diffuse_area.json");
    const Outcome outcome = orrery({"render", scene, "-o", "x.ppm", "--stats", "s.json", "--threads", "2", "--seed",
                                    "9", "--size", "40x30", "--light-sampling", "cone"},
                                   {.folder = folder.path()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(outcome.output, "x.ppm\n");
    const Json s = Json::parse(load(folder / "s.json"));

    EXPECT_EQ(s["scene"], scene);
    EXPECT_EQ(s["images"], Json({"x.ppm"}));
    EXPECT_EQ(s["version"], version());
    EXPECT_EQ(s["size"], Json({40, 30}));
    EXPECT_EQ(s["seed"], 9);
    EXPECT_EQ(s["precision"], "float");
    EXPECT_EQ(s["threads"], 2);
    EXPECT_EQ(s["samples_per_pixel"], 16);
    EXPECT_EQ(s["dropped_samples"], 0);
    EXPECT_TRUE(s["isa"].is_string());

    const double seconds = s["seconds"];
    const double rays = s["rays"]["closest"].get<double>() + s["rays"]["shadow"].get<double>();
    EXPECT_GT(seconds, 0);
    EXPECT_LT(seconds, 600);
    EXPECT_GE(s["rays"]["closest"], 40 * 30 * 16);
    EXPECT_GT(s["rays"]["shadow"], 0);
    EXPECT_NEAR(s["rays_per_second"].get<double>(), rays / seconds, 1e-6 * rays / seconds);

    const std::uint64_t bytes_per_ray = s["bytes_per_ray"];
    EXPECT_GT(bytes_per_ray, 32u);
    EXPECT_LT(bytes_per_ray, 4096u);
    EXPECT_GT(s["wave_size"], 0);
    EXPECT_LT(s["queue_bytes_per_thread"], 4 << 20);
}

TEST(Statistics, TimeTheFiveStages) {
    const TemporaryFolder folder;
    const Outcome outcome = orrery({"render", scene_file("tests/diffuse_area.json"), "-o", "x.ppm", "--threads", "1",
                                    "--stats", "-", "--light-sampling", "cone"},
                                   {.folder = folder.path()});
    const auto s = nlohmann::ordered_json::parse(outcome.output);
    std::vector<std::string> names;
    double sum = 0;
    for (const auto& [name, seconds] : s["stage_seconds"].items()) {
        names.push_back(name);
        EXPECT_GT(seconds, 0) << name;
        sum += seconds.get<double>();
    }
    EXPECT_THAT(names, ElementsAre("generate", "intersect", "shade", "shadow", "roulette"));
    EXPECT_LE(sum, s["seconds"].get<double>()) << "one thread";
}

TEST(Statistics, ProfileEndsWithTheOthersAndSumsToTheWallTime) {
    const TemporaryFolder folder;
    const Outcome outcome = orrery({"render", scene_file("tests/diffuse_area.json"), "-o", "x.ppm", "--threads", "1",
                                    "--quiet", "--profile", "--stats", "s.json"},
                                   {.folder = folder.path()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(outcome.output, "x.ppm\n") << "the table is no result a script reads";
    EXPECT_TRUE(outcome.error.starts_with("stage ")) << outcome.error;
    const std::size_t last = outcome.error.rfind('\n', outcome.error.size() - 2);
    EXPECT_EQ(outcome.error.substr(last + 1, 7), "others ");

    const Json s = Json::parse(load(folder / "s.json"));
    double seconds = 0;
    std::uint64_t closest = 0;
    for (const Json& row : s["profile"]) {
        seconds += row["seconds"].get<double>();
        if (row["stage"] == "intersect") closest += row["rays"].get<std::uint64_t>();
    }
    EXPECT_EQ(s["profile"].back()["stage"], "others");
    EXPECT_NEAR(seconds, s["seconds"].get<double>(), 1e-6 * seconds);
    EXPECT_EQ(closest, s["rays"]["closest"].get<std::uint64_t>());
}

TEST(Statistics, TellTheErrorOfTheImageOrNullWhereNothingTells) {
    const TemporaryFolder folder;
    const auto stats = [&](const char* samples) {
        const Outcome outcome = orrery({"render", scene_file("tests/diffuse_area.json"), "-o", "x.ppm", "--spp",
                                        samples, "--estimator", "stratified", "--stats", "-"},
                                       {.folder = folder.path()});
        return Json::parse(outcome.output);
    };
    const Json coarse = stats("16"), fine = stats("1024");
    for (const char* kind : {"relative_error", "rmse"}) {
        const double error = coarse[kind]["estimate"];
        EXPECT_LT(coarse[kind]["interval_95"][0], error);
        EXPECT_GT(coarse[kind]["interval_95"][1], error);
        EXPECT_NEAR(fine[kind]["estimate"].get<double>() * 8, error, 0.25 * error) << "1 / sqrt(n)";
        EXPECT_TRUE(stats("1")[kind].is_null());
    }
}

TEST(Statistics, NameThePlan) {
    const TemporaryFolder folder;
    const Outcome outcome =
        orrery({"render", scene_file("tests/lens.json"), "-o", "x.ppm", "--stats", "-"}, {.folder = folder.path()});
    const Json s = Json::parse(outcome.output);
    bool lens = false;
    for (const Json& decision : s["plan"]) {
        EXPECT_NE(decision["part"], "");
        EXPECT_NE(decision["reason"], "");
        lens = lens || (decision["part"] == "generate: lens" && decision["runs"] == true);
    }
    EXPECT_TRUE(lens);
}

TEST(Statistics, AlsoHoldOnAStandardOutputThatIsTheirsAlone) {
    const TemporaryFolder folder;
    const Outcome outcome =
        orrery({"render", scene_file("tests/depth.json"), "-o", "a.ppm", "-o", "b.png", "--stats", "-"},
               {.folder = folder.path()});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(Json::parse(outcome.output)["images"], Json({"a.ppm", "b.png"}));
}

TEST(Statistics, AreWrittenWholeOrNotAtAll) {
    const TemporaryFolder folder;
    store(folder / "s.json", to_bytes("previous"));
    const Outcome outcome =
        orrery({"render", scene_file("tests/depth.json"), "--size", "2x2", "-o", "x.ppm", "--stats", "s.json"},
               {.folder = folder.path(), .largest_file = 600});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(load(folder / "s.json"), "previous");
    EXPECT_THAT(folder.names(), ElementsAre("s.json", "x.ppm"));
}

}  // namespace
}  // namespace orrery::test
