// Images compared by the program: figures, reports and exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/image_file.hpp"
#include "program.hpp"

namespace orrery::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;
using Arguments = std::vector<std::string>;

/// A folder with a.pfm and b.exr, of two pixels, whose figures are known; and others beside them.
class Compare : public ::testing::Test {
protected:
    Compare() {
        write("a.pfm", {2, 1, {{1, 2, 3}, {0, 0, 0}}});
        write("b.exr", {2, 1, {{1, 1, 1}, {0.5f, 0, 0}}});
    }

    void write(const std::string& name, const Image& image) {
        write_image(folder_ / name.c_str(), image, ToneMap::none, {});
    }

    Image read(const std::string& name) { return read_image(folder_ / name.c_str()); }

    Outcome compare(Arguments arguments) {
        arguments.insert(arguments.begin(), "compare");
        return orrery(arguments, {.folder = folder_.path()});
    }

    /// The lines of standard output.
    std::map<std::string, double> figures(const Arguments& arguments) {
        const Outcome outcome = compare(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
        EXPECT_EQ(outcome.error, "");
        std::map<std::string, double> found;
        std::istringstream lines(outcome.output);
        for (std::string line; std::getline(lines, line);) {
            const std::size_t blank = line.find(' ');
            EXPECT_TRUE(found.emplace(line.substr(0, blank), std::stod(line.substr(blank))).second) << line;
        }
        return found;
    }

    const TemporaryFolder folder_;
};

TEST_F(Compare, PrintsFiguresByName) {
    const auto found = figures({"a.pfm", "b.exr"});
    EXPECT_EQ(found.at("pixels"), 2);
    EXPECT_EQ(found.at("not_finite_a"), 0);
    EXPECT_EQ(found.at("mse"), 0.875);
    EXPECT_EQ(found.at("rmse"), std::sqrt(0.875)) << "printed to the last bit";
    EXPECT_DOUBLE_EQ(found.at("mrse"), (1 / 1.01 + 4 / 1.01 + 0.25 / 0.26) / 6);
    EXPECT_EQ(found.at("largest_error"), 2);
    EXPECT_EQ(found.at("largest_error_x"), 0);
    EXPECT_EQ(found.at("percentile_99.9_error"), 2);
    EXPECT_EQ(found.at("mean_difference_b"), 1);
    EXPECT_FALSE(found.contains("z"));
}

TEST_F(Compare, StandardErrorsGiveZ) {
    write("ea.pfm", {2, 1, {{0.3f, 0.5f, 1}, {0.4f, 0, 0}}});
    write("eb.exr", {2, 1, {{0, 0, 0}, {0, 1.2f, 0}}});
    auto found = figures({"a.pfm", "b.exr", "--error-a", "ea.pfm"});
    EXPECT_NEAR(found.at("z_r"), -1, 1e-6);
    EXPECT_NEAR(found.at("z_g"), 2, 1e-6);
    EXPECT_NEAR(found.at("z_b"), 2, 1e-6);
    EXPECT_NEAR(found.at("z"), 1.25, 1e-6);
    found = figures({"a.pfm", "b.exr", "--error-a", "ea.pfm", "--error-b", "eb.exr"});
    EXPECT_NEAR(found.at("standard_error_g"), 0.65, 1e-6);
}

TEST_F(Compare, EightBitImagesCompareByTheirValues) {
    write("a.png", {1, 1, {{1, 0.2f, 0}}});
    write("b.ppm", {1, 1, {{0.6f, 0.2f, 0}}});
    const auto found = figures({"a.png", "b.ppm"});
    EXPECT_NEAR(found.at("largest_error"), 0.4, 1e-7);
    EXPECT_NEAR(found.at("mean_difference_g"), 0, 0);
}

TEST_F(Compare, LimitsDecideTheExitCode) {
    EXPECT_EQ(compare({"a.pfm", "b.exr", "--max-rmse", "0.94"}).exit_code, 0);
    EXPECT_EQ(compare({"a.pfm", "b.exr", "--max-rmse", "0.94", "--max-mrse", "1"}).exit_code, 0);
    EXPECT_EQ(compare({"a.pfm", "a.pfm", "--max-rmse", "0", "--max-mrse", "0"}).exit_code, 0);
    const Outcome beyond = compare({"a.pfm", "b.exr", "--max-rmse", "0.93"});
    EXPECT_EQ(beyond.exit_code, 3);
    EXPECT_THAT(beyond.output, HasSubstr("mse 0.875\n"));
    EXPECT_EQ(beyond.error, "orrery: error: rmse is 0.9354143466934853, expected at most 0.93\n");
    const Outcome both = compare({"a.pfm", "b.exr", "--max-rmse", "0", "--max-mrse", "9e-1"});
    EXPECT_EQ(both.exit_code, 3);
    EXPECT_THAT(both.error, AllOf(HasSubstr("rmse is"), HasSubstr("mrse is")));
}

TEST_F(Compare, APixelThatIsNotFiniteIsBeyondEveryLimit) {
    write("a.pfm", {2, 1, {{1, 1, 1}, {0, std::numeric_limits<float>::quiet_NaN(), 0}}});
    EXPECT_EQ(figures({"a.pfm", "b.exr"}).at("not_finite_a"), 1);
    const Outcome outcome = compare({"a.pfm", "b.exr", "--max-rmse", "1000"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.error, HasSubstr("1 pixels of A and 0 of B are not finite"));
}

TEST_F(Compare, DifferenceIsAnImage) {
    for (const std::string name : {"d.pfm", "d.exr"}) {
        figures({"a.pfm", "b.exr", "--difference", name});
        EXPECT_EQ(read(name).pixels, (std::vector<Rgb>{{0, 1, 2}, {-0.5f, 0, 0}}));
    }
    for (const std::string name : {"d.ppm", "d.png"}) {
        figures({"a.pfm", "b.exr", "--difference", name});
        const Image seen = read(name);
        EXPECT_EQ(seen.pixels[0], (Rgb{0, 128 / 255.0f, 1})) << "relative to 2, the 99.9th percentile";
        EXPECT_EQ(seen.pixels[1], (Rgb{64 / 255.0f, 0, 0}));
    }
}

TEST_F(Compare, DifferenceOfOnePixelInManyIsSeen) {
    Image a{100, 100, std::vector<Rgb>(10'000)};
    write("black.pfm", a);
    a.at(50, 50).g = 0.01f;
    write("dot.pfm", a);
    figures({"dot.pfm", "black.pfm", "--difference", "d.png"});
    EXPECT_EQ(read("d.png").at(50, 50), (Rgb{0, 1, 0}));
}

TEST_F(Compare, JsonHoldsTheSameFigures) {
    write("e.pfm", {2, 1, {{0.3f, 0.5f, 0}, {0.4f, 0, 0}}});
    const auto found = figures({"a.pfm", "b.exr", "--error-a", "e.pfm", "--json", "c.json"});
    const auto json = nlohmann::json::parse(load(folder_ / "c.json"));
    EXPECT_EQ(json.at("a"), "a.pfm");
    EXPECT_EQ(json.at("b"), "b.exr");
    EXPECT_EQ(json.size(), found.size() + 2);
    for (const auto& [name, value] : found)
        if (name == "z_b") {
            EXPECT_TRUE(json.at(name).is_null()) << "JSON has no infinity";
        } else {
            EXPECT_EQ(json.at(name), value) << name;
        }
    const Outcome alone = compare({"a.pfm", "b.exr", "--error-a", "e.pfm", "--json", "-"});
    EXPECT_EQ(nlohmann::json::parse(alone.output), json);
}

TEST_F(Compare, WhatCannotBeComparedIsNamed) {
    write("wide.pfm", {3, 1, std::vector<Rgb>(3)});
    store(folder_ / "garbage.png", to_bytes("garbage"));
    const auto refused = [&](const Arguments& arguments, int exit_code, const std::string& why) {
        const Outcome outcome = compare(arguments);
        EXPECT_EQ(outcome.exit_code, exit_code) << why;
        EXPECT_EQ(outcome.output, "");
        EXPECT_THAT(outcome.error, HasSubstr(why));
    };
    refused({"a.pfm", "wide.pfm"}, 2, "wide.pfm: found 3 x 1 pixels, expected 2 x 1 as in a.pfm");
    refused({"a.pfm", "b.exr", "--error-b", "wide.pfm"}, 2, "wide.pfm: found 3 x 1");
    refused({"a.pfm", "missing.pfm"}, 1, "missing.pfm");
    refused({"garbage.png", "a.pfm"}, 1, "garbage.png");
    refused({"a.pfm"}, 2, "B is required");
    refused({"a.pfm", "b.exr", "--max-rmse", "-1"}, 2, "expected a number >= 0");
    refused({"a.pfm", "b.exr", "--max-mrse", "nan"}, 2, "expected a number >= 0");
    refused({"a.pfm", "b.exr", "--max-rmse", "1x"}, 2, "--max-rmse: found \"1x\"");
    refused({"a.pfm", "b.exr", "--difference", "d.bmp"}, 2, "--difference: d.bmp");
    refused({"a.pfm", "b.exr", "--difference", "./a.pfm"}, 2, "this file is named twice");
    refused({"a.pfm", "b.exr", "--difference", "d.png", "--json", "d.png"}, 2, "this file is named twice");
    refused({"a.pfm", "b.exr", "--difference", "none/d.png"}, 1, "none/d.png");
    EXPECT_THAT(folder_.names(), UnorderedElementsAre("a.pfm", "b.exr", "garbage.png", "wide.pfm"));
}

TEST_F(Compare, TwoRendersOfOneSceneAgree) {
    for (const std::string seed : {"1", "2"})
        orrery({"render", scene_file("tests/diffuse_area.json"), "--size", "16x16", "--spp", "64", "--seed", seed,
                "--quiet", "-o", seed + ".pfm"},
               {.folder = folder_.path()});
    EXPECT_EQ(compare({"1.pfm", "1.pfm", "--max-rmse", "0"}).exit_code, 0);
    const auto found = figures({"1.pfm", "2.pfm"});
    EXPECT_GT(found.at("rmse"), 0);
    EXPECT_LT(found.at("mrse"), 0.01);
}

}  // namespace
}  // namespace orrery::test
