// The sample, the small scenes of scenes/tests, and the kinds that values select.
#include <gtest/gtest.h>

#include <set>

#include "scene/world.hpp"

namespace orrery::test {
namespace {

Scene load(const std::string& name) {
    const ReadResult result = read_scene(scenes_folder() / (name + ".json"));
    EXPECT_TRUE(result.diagnostics.empty()) << name << '\n' << listing(result);
    return result.scene.value();
}

Material ball_material(const Scene& scene) { return scene.materials.at(scene.primitives.at(1).material); }

TEST(SmallScenes, AllReadWithoutRemarkAndAreSmall) {
    std::set<MaterialKind> kinds;
    std::set<Integrator> integrators;
    int count = 0;
    for (const auto& file : scene_files()) {
        if (file.parent_path().filename() != "tests") continue;
        const Scene scene = load("tests/" + file.stem().string());
        EXPECT_GE(std::min(scene.settings.width, scene.settings.height), 16u) << file;
        EXPECT_LE(std::max(scene.settings.width, scene.settings.height), 64u) << file;
        EXPECT_EQ(scene.settings.output.filename(), file.stem().string() + ".pfm");
        for (const Material& material : scene.materials) kinds.insert(material.kind);
        integrators.insert(scene.settings.integrator);
        ++count;
    }
    EXPECT_GE(count, 12);
    EXPECT_EQ(kinds.size(), 5u) << "every kind of material has its scene";
    EXPECT_EQ(integrators.size(), 3u);
}

TEST(SmallScenes, EachBallWearsWhatItsFileIsNamedAfter) {
    EXPECT_EQ(ball_material(load("tests/diffuse_point")).kind, MaterialKind::diffuse);
    EXPECT_EQ(ball_material(load("tests/specular")).kind, MaterialKind::specular);
    EXPECT_EQ(ball_material(load("tests/glossy")).kind, MaterialKind::glossy);
    EXPECT_EQ(ball_material(load("tests/dielectric")).kind, MaterialKind::dielectric);
    const Material translucent = ball_material(load("tests/translucent"));
    EXPECT_EQ(translucent.kind, MaterialKind::translucent);
    EXPECT_EQ(translucent.roughness, 0.2);
    EXPECT_EQ(translucent.rho, glm::dvec3(0.95));
    EXPECT_EQ(translucent.rho_t, glm::dvec3(0.9, 0.95, 1.0));
}

TEST(SmallScenes, LightsAreWhereTheyBelong) {
    const Scene point = load("tests/diffuse_point");
    ASSERT_EQ(point.point_lights.size(), 1u);
    EXPECT_EQ(point.point_lights[0].id, "lamp");
    EXPECT_EQ(point.point_lights[0].position, glm::dvec3(-3, 4, -3));
    EXPECT_EQ(point.point_lights[0].intensity, glm::dvec3(60, 50, 40));
    const Scene area = load("tests/diffuse_area");
    EXPECT_TRUE(area.point_lights.empty());
    EXPECT_EQ(area.primitives.at(2).emission, glm::dvec3(60, 50, 40));
    EXPECT_FALSE(area.primitives.at(0).emission.has_value());
}

TEST(SmallScenes, LensCameraHasItsLens) {
    const Scene scene = load("tests/lens");
    EXPECT_EQ(scene.camera.aperture, 0.4);
    EXPECT_EQ(scene.camera.focal_distance, 5);
    EXPECT_EQ(scene.camera.aspect, 1.5);
    EXPECT_EQ(scene.settings.width, 48u);
    EXPECT_EQ(scene.settings.height, 32u);
}

TEST(SmallScenes, EmptySceneHasOnlyItsBackground) {
    const Scene scene = load("tests/empty");
    EXPECT_TRUE(scene.primitives.empty());
    EXPECT_TRUE(scene.point_lights.empty());
    EXPECT_TRUE(scene.materials.empty());
    EXPECT_EQ(scene.background, glm::dvec3(0.25, 0.5, 0.75));
}

TEST(SmallScenes, RendererOptionsOverrideDefaults) {
    const RenderSettings chosen = load("tests/renderer_options").settings;
    EXPECT_EQ(chosen.estimator, Estimator::uniform);
    EXPECT_EQ(chosen.transport, Transport::nee);
    EXPECT_EQ(chosen.light_sampling, LightSampling::area);
    EXPECT_FALSE(chosen.roulette);
    EXPECT_EQ(chosen.tonemap, ToneMap::linear);
    EXPECT_EQ(chosen.seed, 7u);

    const RenderSettings defaults = load("tests/diffuse_point").settings;
    EXPECT_EQ(defaults.estimator, Estimator::sobol);
    EXPECT_EQ(defaults.transport, Transport::mis);
    EXPECT_EQ(defaults.light_sampling, LightSampling::exact);
    EXPECT_TRUE(defaults.roulette);
    EXPECT_FALSE(defaults.tonemap.has_value());
    EXPECT_EQ(defaults.seed, 0u);
}

TEST(SmallScenes, RouletteIsAWordOrABoolean) {
    for (const auto& [value, on] : {std::pair<Json, bool>{"on", true}, {"off", false}, {true, true}, {false, false}}) {
        Json json = world();
        json["scene"]["renderer"]["roulette"] = value;
        const ReadResult result = read(json);
        ASSERT_TRUE(result.scene.has_value()) << listing(result);
        EXPECT_EQ(result.scene->settings.roulette, on) << value;
    }
}

TEST(SmallScenes, LightChoiceIsAWord) {
    EXPECT_EQ(load("tests/diffuse_point").settings.light_choice, LightChoice::all);
    for (const auto& [word, choice] :
         {std::pair{"all", LightChoice::all}, {"uniform", LightChoice::uniform}, {"power", LightChoice::power}}) {
        Json json = world();
        json["scene"]["renderer"]["light choice"] = word;
        const ReadResult result = read(json);
        ASSERT_TRUE(result.scene.has_value()) << listing(result);
        EXPECT_EQ(result.scene->settings.light_choice, choice);
        EXPECT_TRUE(result.diagnostics.empty()) << listing(result);
    }
}

TEST(SmallScenes, RouletteStartsWhereTheSceneSays) {
    EXPECT_EQ(load("tests/diffuse_point").settings.roulette_from, 8u);
    Json json = world();
    json["scene"]["renderer"]["roulette from"] = 3;
    const ReadResult result = read(json);
    ASSERT_TRUE(result.scene.has_value()) << listing(result);
    EXPECT_EQ(result.scene->settings.roulette_from, 3u);
    EXPECT_TRUE(result.diagnostics.empty()) << listing(result);
}

TEST(SmallScenes, SampleReads) {
    const Scene scene = load("sample");
    EXPECT_EQ(scene.primitives.size(), 2u);
    EXPECT_EQ(scene.point_lights.size(), 1u);
    EXPECT_EQ(scene.camera.aperture, 0);
}

TEST(SmallScenes, ZerosSelectTheSimplerKind) {
    Json json = world();
    json["materials"][2]["roughness"] = 0;
    json["materials"][4]["roughness"] = 0;
    json["cameras"][1]["alpha"] = 0;
    json["scene"]["camera"] = "lens";
    const ReadResult result = read(json);
    ASSERT_TRUE(result.scene.has_value()) << listing(result);
    const auto kind_of = [&](std::size_t i) {
        return result.scene->materials.at(result.scene->primitives.at(i).material).kind;
    };
    EXPECT_EQ(kind_of(2), MaterialKind::specular);
    EXPECT_EQ(kind_of(4), MaterialKind::dielectric);
    EXPECT_EQ(result.scene->camera.aperture, 0);
}

TEST(SmallScenes, OutputIsRelativeToTheSceneFile) {
    const std::string text = world().dump();
    EXPECT_EQ(read_scene_text(text, "scenes/a.json").scene->settings.output, "output/world.ppm");
    EXPECT_EQ(read_scene_text(text, "a.json").scene->settings.output, "../output/world.ppm");
    EXPECT_EQ(read_scene_text(text, "/x/scenes/a.json").scene->settings.output, "/x/output/world.ppm");
    Json json = world();
    json["scene"]["renderer"]["output"] = "/tmp/a.ppm";
    EXPECT_EQ(read(json).scene->settings.output, "/tmp/a.ppm");
    json["scene"]["renderer"].erase("output");
    EXPECT_TRUE(read(json).scene->settings.output.empty());
}

}  // namespace
}  // namespace orrery::test
