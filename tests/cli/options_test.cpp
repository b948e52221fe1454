// Every option does something, and only what it says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "image/codec.hpp"
#include "kernels/isa.hpp"
#include "program.hpp"

namespace orrery::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

/// Renders a scene of the repository with some options and returns the statistics.
Json stats_of(const std::string& scene, const Arguments& options) {
    const TemporaryFolder folder;
    Arguments arguments = {"render", scene_file(scene), "-o", (folder / "x.pfm").string(), "--stats", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = orrery(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return Json::parse(outcome.output);
}

/// As above, and the bytes of the image.
std::string image_of(const std::string& scene, const Arguments& options, const std::string& name = "x.pfm") {
    const TemporaryFolder folder;
    Arguments arguments = {"render", scene_file(scene), "--quiet", "-o", (folder / name.c_str()).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = orrery(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(outcome.error, "");
    return load(folder / name.c_str());
}

TEST(Options, SizeChangesTheImageAndNotTheView) {
    const std::string square = image_of("tests/depth.json", {"--size", "2x2", "--spp", "1"});
    const std::string wide = image_of("tests/depth.json", {"--size", "200x2", "--spp", "1"});
    EXPECT_THAT(square, StartsWith("PF\n2 2\n"));
    EXPECT_THAT(wide, StartsWith("PF\n200 2\n"));
    EXPECT_EQ(stats_of("tests/depth.json", {"--size", "5x3"})["size"], Json({5, 3}));
}

TEST(Options, SppIsRoundedDownToWhatTheEstimatorTakes) {
    EXPECT_EQ(stats_of("tests/diffuse_area.json", {"--spp", "7", "--estimator", "stratified"})["samples_per_pixel"], 4);
    EXPECT_EQ(stats_of("tests/diffuse_area.json", {"--spp", "7"})["samples_per_pixel"], 6);
    EXPECT_EQ(stats_of("tests/diffuse_area.json", {"--spp", "7", "--estimator", "uniform"})["samples_per_pixel"], 7);
}

TEST(Options, SeedChangesTheNoise) {
    const std::string image = image_of("tests/diffuse_area.json", {});
    EXPECT_EQ(image_of("tests/diffuse_area.json", {"--seed", "0"}), image);
    EXPECT_NE(image_of("tests/diffuse_area.json", {"--seed", "4294967295"}), image);
}

TEST(Options, SayWhenFewerSamplesAreTakenThanAsked) {
    const auto said = [](Arguments options) {
        const TemporaryFolder folder;
        Arguments arguments = {"render", scene_file("tests/depth.json"), "--size", "4x4",
                               "-o",     (folder / "x.pfm").string()};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = orrery(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
        return outcome.error;
    };
    const auto stratified = [&](const char* samples) { return said({"--spp", samples, "--estimator", "stratified"}); };
    EXPECT_THAT(stratified("8"), HasSubstr("orrery: note: stratified takes 4 samples per pixel"));
    EXPECT_THAT(stratified("3"), HasSubstr("takes 1 sample per pixel, the square number below the 3 asked\n"));
    EXPECT_THAT(stratified("9"), Not(HasSubstr("note")));
    EXPECT_THAT(said({"--spp", "9"}),
                HasSubstr("sobol takes 8 samples per pixel, the even number below the 9 asked\n"));
    for (const Arguments& exact : {Arguments{"--spp", "8"}, {"--spp", "8", "--estimator", "uniform"}})
        EXPECT_THAT(said(exact), Not(HasSubstr("note")));
    EXPECT_EQ(said({"--spp", "8", "--estimator", "stratified", "--quiet"}), "");
    EXPECT_EQ(
        stats_of("tests/depth.json", {"--size", "4x4", "--spp", "8", "--estimator", "stratified"})["samples_per_pixel"],
        4);
}

TEST(Options, OneIsSingular) {
    const TemporaryFolder folder;
    const auto said = [&](const char* threads, const char* samples) {
        return orrery({"render", scene_file("tests/depth.json"), "--size", "4x4", "-o", (folder / "x.pfm").string(),
                       "--threads", threads, "--spp", samples})
            .error;
    };
    EXPECT_THAT(said("1", "1"), AllOf(HasSubstr(", 1 thread)"), HasSubstr(" 1 sample per pixel")));
    EXPECT_THAT(said("2", "4"), AllOf(HasSubstr(", 2 threads)"), HasSubstr(" 4 samples per pixel")));
}

TEST(Options, IntegratorDepthCastsOneRayPerSample) {
    const Json stats = stats_of("tests/diffuse_area.json", {"--integrator", "depth"});
    EXPECT_EQ(stats["rays"]["closest"], 32 * 32 * 16);
    EXPECT_EQ(stats["rays"]["shadow"], 0);
    EXPECT_EQ(stats["integrator"], "depth");
}

TEST(Options, IntegratorWhittedKnowsNoIndirectLight) {
    const Json whitted = stats_of("tests/diffuse_area.json", {"--integrator", "wrt", "--light-sampling", "cone"});
    EXPECT_EQ(whitted["rays"]["closest"], 32 * 32 * 16) << "diffuse surfaces end a Whitted path";
    EXPECT_GT(whitted["rays"]["shadow"], 0);
    EXPECT_GT(stats_of("tests/diffuse_area.json", {"--integrator", "pt"})["rays"]["closest"], 32 * 32 * 16);
}

TEST(Options, DepthBoundsThePath) {
    EXPECT_EQ(stats_of("tests/diffuse_area.json", {"--depth", "0"})["rays"]["shadow"], 0);
    const auto rays = [](const char* depth) {
        return stats_of("tests/diffuse_area.json", {"--depth", depth})["rays"]["closest"].get<int>();
    };
    EXPECT_LT(rays("1"), rays("3"));
}

TEST(Options, TransportNaiveCastsNoShadowRays) {
    EXPECT_EQ(stats_of("tests/diffuse_area.json", {"--transport", "naive"})["rays"]["shadow"], 0);
    const Arguments nee = {"--transport", "nee", "--light-sampling", "cone"};
    EXPECT_GT(stats_of("tests/diffuse_area.json", nee)["rays"]["shadow"], 0);
    EXPECT_NE(image_of("tests/diffuse_area.json", {"--transport", "mis", "--light-sampling", "cone"}),
              image_of("tests/diffuse_area.json", nee));
}

TEST(Options, LightSamplingAndEstimatorChangeTheSamples) {
    const auto by = [](const char* word) { return image_of("tests/diffuse_area.json", {"--light-sampling", word}); };
    EXPECT_NE(by("area"), by("cone"));
    EXPECT_NE(by("cone"), by("exact"));
    EXPECT_NE(image_of("tests/diffuse_area.json", {"--estimator", "uniform"}),
              image_of("tests/diffuse_area.json", {"--estimator", "stratified"}));
}

TEST(Options, LightChoiceAimsAtOneLight) {
    const auto rays = [](Arguments options) {
        options.insert(options.end(), {"--size", "16x16", "--spp", "4"});
        return stats_of("bench/many_lights.json", options)["rays"]["shadow"].get<int>();
    };
    EXPECT_EQ(rays({"--light-choice", "all"}), rays({}));
    EXPECT_LT(10 * rays({"--light-choice", "uniform"}), rays({}));
    EXPECT_THAT(image_of("tests/diffuse_area.json", {"--light-choice", "power"}, "x.exr"),
                HasSubstr("--light-choice power"));
    EXPECT_EQ(image_of("tests/diffuse_area.json", {"--light-choice", "power"}), image_of("tests/diffuse_area.json", {}))
        << "it has one light";
}

TEST(Options, RouletteEndsPathsEarly) {
    const auto rays = [](const char* roulette) {
        return stats_of("tests/diffuse_area.json", {"--depth", "20", "--roulette", roulette})["rays"]["closest"]
            .get<int>();
    };
    EXPECT_LT(rays("on"), rays("off"));
}

TEST(Options, RouletteFromPostponesTheGame) {
    const auto rays = [](Arguments options) {
        if (!std::ranges::count(options, "--depth")) options.insert(options.begin(), {"--depth", "4"});
        return stats_of("tests/diffuse_area.json", options)["rays"]["closest"].get<int>();
    };
    EXPECT_EQ(rays({"--depth", "20", "--roulette-from", "8"}), rays({"--depth", "20"}));
    EXPECT_LT(rays({"--depth", "20", "--roulette-from", "7"}), rays({"--depth", "20"}));
    EXPECT_LT(rays({"--roulette-from", "0"}), rays({"--roulette-from", "1"}));
    EXPECT_LT(rays({"--roulette-from", "1"}), rays({"--roulette-from", "3"}));
    EXPECT_EQ(rays({"--roulette-from", "4"}), rays({"--roulette", "off"}));
    EXPECT_THAT(image_of("tests/diffuse_area.json", {"--roulette-from", "2"}, "x.exr"),
                HasSubstr("--roulette on --roulette-from 2"));
}

TEST(Options, TonemapMapsEightBitFormatsOnly) {
    const auto pixels = [](const char* name, Arguments options) {
        options.insert(options.end(), {"--size", "40x40", "--spp", "4"});
        const std::string file = image_of("assignment_08.json", options, name);
        return decode_image(std::as_bytes(std::span(file))).pixels;
    };
    const auto radiance = pixels("x.pfm", {});
    float largest = 0;
    for (const Rgb& p : radiance) largest = std::max(largest, p.g);
    ASSERT_GT(largest, 1);
    const auto expect_mapped = [&](const Arguments& options, const auto& map) {
        const auto mapped = pixels("x.ppm", options);
        ASSERT_EQ(mapped.size(), radiance.size());
        for (std::size_t i = 0; i < mapped.size(); ++i)
            ASSERT_NEAR(mapped[i].g, map(radiance[i].g), 0.501 / 255) << "pixel " << i;
    };
    expect_mapped({"--tonemap", "sigmoid"}, [](float x) { return x / (1 + x); });
    expect_mapped({"--tonemap", "linear"}, [&](float x) { return x / largest; });
    expect_mapped({"--tonemap", "none"}, [](float x) { return std::min(x, 1.0f); });
    expect_mapped({}, [](float x) { return x / (1 + x); });
    EXPECT_EQ(image_of("tests/diffuse_area.json", {"--tonemap", "linear"}, "x.exr"),
              image_of("tests/diffuse_area.json", {"--tonemap", "none"}, "x.exr"));
}

TEST(Options, WhatTheyLeaveOutTheSceneSays) {
    const Json stats = stats_of("tests/renderer_options.json", {});
    const std::string image = image_of("tests/renderer_options.json", {}, "x.exr");
    std::ifstream file(scene_file("tests/renderer_options.json"));
    const Json renderer = Json::parse(file)["scene"]["renderer"];
    EXPECT_EQ(stats["seed"], renderer["seed"]);
    EXPECT_THAT(image, HasSubstr("--estimator " + renderer["estimator"].get<std::string>()));
    EXPECT_THAT(image, HasSubstr("--transport " + renderer["transport"].get<std::string>()));
    EXPECT_THAT(image, HasSubstr("--light-sampling " + renderer["light sampling"].get<std::string>()));
}

TEST(Options, ThreadsAndWaveSizeAreReportedAndChangeNoByte) {
    for (const char* scene : {"tests/diffuse_area.json", "tests/translucent.json", "tests/lens.json"}) {
        const std::string image = image_of(scene, {"--threads", "1"}, "x.exr");
        for (const char* threads : {"1", "2", "7"})
            for (const char* wave_size : {"1", "17", "64", "1000", "5000"})
                EXPECT_EQ(image_of(scene, {"--threads", threads, "--wave-size", wave_size}, "x.exr"), image)
                    << scene << ", " << threads << " threads, waves of " << wave_size;
    }
    const Json stats = stats_of("tests/lens.json", {"--threads", "7", "--wave-size", "64"});
    EXPECT_EQ(stats["threads"], 7);
    EXPECT_EQ(stats["wave_size"], 64);
}

TEST(Options, WaveSizeChangesNoByteOfAWhittedImage) {
    const std::string image = image_of("tests/whitted.json", {}, "x.png");
    for (const char* wave_size : {"1", "100", "3000"})
        EXPECT_EQ(image_of("tests/whitted.json", {"--threads", "2", "--wave-size", wave_size}, "x.png"), image);
}

TEST(Options, TheForcedInstructionSetRuns) {
    for (const Isa isa : all_isas) {
        const std::string name(isa_name(isa));
        if (isa_supported(isa)) {
            EXPECT_EQ(stats_of("tests/diffuse_area.json", {"--isa", name})["isa"], name);
        } else {
            const Outcome outcome =
                orrery({"render", scene_file("tests/diffuse_area.json"), "-o", "/x.ppm", "--isa", name});
            EXPECT_EQ(outcome.exit_code, 2);
            EXPECT_THAT(outcome.error, HasSubstr(name));
        }
    }
    EXPECT_EQ(stats_of("tests/diffuse_area.json", {"--isa", "auto"})["isa"], isa_name(best_isa()));
}

TEST(Options, Avx2AndAvx512GiveTheSameBytes) {
    if (!isa_supported(Isa::avx512)) GTEST_SKIP() << "takes AVX-512";
    EXPECT_EQ(image_of("tests/nested_glass.json", {"--isa", "avx512"}, "x.exr"),
              image_of("tests/nested_glass.json", {"--isa", "avx2"}, "x.exr"));
}

TEST(Options, PrecisionAutoIsTheDefault) {
    EXPECT_EQ(image_of("tests/lens.json", {"--precision", "float"}), image_of("tests/lens.json", {}));
    EXPECT_EQ(stats_of("large_ground.json", {"--size", "8x8", "--spp", "1"})["precision"], "double");
}

TEST(Options, ErrorIsReachedAndReported) {
    const Json stats = stats_of("tests/diffuse_area.json", {"--error", "6%", "--size", "24x24"});
    EXPECT_EQ(stats["stopped_by"], "error");
    EXPECT_EQ(stats["goal"], Json::parse(R"({"error": 0.06, "adaptive": true})"));
    EXPECT_LE(stats["relative_error"]["estimate"], 0.06);
    EXPECT_GE(stats["passes"], 1);
    EXPECT_LE(stats["samples_of_any_pixel"][0], stats["samples_per_pixel"]);
    EXPECT_GE(stats["samples_of_any_pixel"][1], stats["samples_per_pixel"]);
    EXPECT_EQ(stats_of("tests/diffuse_area.json", {"--error", "0.06", "--size", "24x24"})["samples_per_pixel"],
              stats["samples_per_pixel"]);
}

TEST(Options, SppIsACeilingToError) {
    const Json stats = stats_of("tests/diffuse_area.json", {"--error", "0.1%", "--spp", "50", "--adaptive", "off"});
    EXPECT_EQ(stats["stopped_by"], "samples");
    EXPECT_LE(stats["samples_per_pixel"], 50);
    EXPECT_EQ(stats["samples_of_any_pixel"][0], stats["samples_of_any_pixel"][1]);
}

TEST(Options, TimeIsKept) {
    const Json stats = stats_of("tests/diffuse_area.json", {"--time", "200ms"});
    EXPECT_EQ(stats["stopped_by"], "time");
    EXPECT_EQ(stats["goal"]["seconds"], 0.2);
    EXPECT_GT(stats["seconds"], 0.1);
}

TEST(Options, AnImageThatStoppedByItselfSaysHowToRepeatIt) {
    const std::string image = image_of("tests/diffuse_area.json", {"--error", "9%", "--spp", "900"}, "x.png");
    EXPECT_THAT(image, HasSubstr("--error 0.09 --spp 900 --adaptive on"));
    EXPECT_EQ(image_of("tests/diffuse_area.json",
                       {"--error", "9%", "--spp", "900", "--threads", "1", "--wave-size", "33"}, "x.png"),
              image);
}

TEST(Options, TheSummarySaysWhyItStopped) {
    const TemporaryFolder folder;
    const auto said = [&](Arguments options) {
        Arguments arguments = {"render", scene_file("tests/diffuse_area.json"), "-o", (folder / "x.ppm").string()};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return orrery(arguments).error;
    };
    EXPECT_THAT(said({"--error", "9%"}), HasSubstr("stopped at the 9 % asked"));
    EXPECT_THAT(said({"--error", "0.1%", "--spp", "32"}), HasSubstr("stopped by --spp, not yet at the 0.1 % asked"));
    EXPECT_THAT(said({"--time", "50ms"}), HasSubstr("stopped by --time: another run gives another image"));
    EXPECT_THAT(said({"--spp", "32"}), Not(HasSubstr("stopped")));
}

TEST(Options, QuietSilencesWarningsAndNotErrors) {
    const TemporaryFolder folder;
    const std::string scene = scene_file("assignment_08.json");
    Arguments arguments = {"render", scene, "--size", "8x8", "--spp", "1", "-o", (folder / "x.ppm").string()};
    const Outcome loud = orrery(arguments);
    arguments.push_back("--quiet");
    const Outcome quiet = orrery(arguments);
    EXPECT_EQ(loud.output, quiet.output);
    EXPECT_NE(loud.error, "");
    EXPECT_EQ(quiet.error, "");
    EXPECT_NE(orrery({"render", "missing.json", "--quiet"}).error, "");
}

}  // namespace
}  // namespace orrery::test
