// The eight scenes hold the facts of the assignment, value by value.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <ostream>

#include "scene/world.hpp"

namespace orrery::test {
namespace {

using glm::dvec3;

/// A sphere of the composition: where, and which material by id; radiance where it is a lamp.
struct Ball {
    dvec3 centre;
    double radius;
    std::string material;
    std::optional<dvec3> emission = std::nullopt;
};

struct Facts {
    int number;
    Integrator integrator;
    std::uint32_t samples, depth;
    dvec3 eye, target;
    std::vector<Ball> balls;  ///< walls first, then spheres, then lamps
    std::vector<PointLight> point_lights;
    std::vector<std::string> warnings;  ///< where
};

void PrintTo(const Facts& facts, std::ostream* stream) { *stream << "assignment " << facts.number; }

const Ball left_wall{{-505, 0, 0}, 500, "green diffuse"}, right_wall{{505, 0, 0}, 500, "red diffuse"},
    far_wall{{0, 0, 505}, 500, "grey diffuse"}, ceiling{{0, 505, 0}, 500, "grey diffuse"},
    ground{{0, -505, 0}, 500, "grey diffuse"};

std::vector<Ball> box_with(std::vector<Ball> inside) {
    inside.insert(inside.begin(), {left_wall, right_wall, far_wall, ceiling, ground});
    return inside;
}

Ball right(const std::string& material) { return {{2, -3.5, -1}, 1.5, material}; }
Ball left(const std::string& material) { return {{-2, -3.5, -1}, 1.5, material}; }
Ball lamp(dvec3 centre, dvec3 power) { return {centre, 1, "white diffuse", power}; }

std::vector<Facts> all_facts() {
    const auto wrt = Integrator::whitted;
    const auto pt = Integrator::path_tracing;
    const std::string glass = "fresnel dielectric";
    const dvec3 near_eye{0, 0, -15}, far_eye{0, 0, -20}, origin{0}, low{0, -3, 0}, low_eye{0, -3, -15},
        low_far{0, -3, -20};
    const PointLight top{"ceiling lamp", {0, 4, -1}, dvec3(300)};
    const auto row = [&](const std::string& first) {
        return std::vector<Ball>{far_wall,
                                 ground,
                                 {{6, -4, -1}, 1, first},
                                 {{3, -4, -1}, 1, glass},
                                 {{0, -4, -1}, 1, "specular"},
                                 {{-3, -4, -1}, 1, "grey diffuse"}};
    };
    const Ball blue_ground{ground.centre, ground.radius, "blue diffuse"};
    std::vector<Ball> lit_row = row("glossy");
    lit_row.push_back(lamp({6, 2, -1}, {32, 30, 28}));
    lit_row.push_back(lamp({-6, -4, -1}, {5, 6, 7}));
    return {
        {1, wrt, 8, 12, near_eye, origin, box_with({right(glass), left("specular")}), {top}, {}},
        {2,
         wrt,
         8,
         12,
         near_eye,
         origin,
         box_with({right("green diffuse"), left("blue diffuse")}),
         {top},
         {"/materials/8/eta"}},
        {3,
         pt,
         128,
         6,
         near_eye,
         origin,
         box_with({right(glass), left("glossy"), lamp({0, 1, -1}, dvec3(30))}),
         {},
         {}},
        {4,
         pt,
         4096,
         6,
         far_eye,
         origin,
         {ground, ground, right(glass), left("specular"), lamp({0, -2, 5}, dvec3(30))},  // the plan drops one
         {},
         {}},
        {5,
         pt,
         4096,
         6,
         far_eye,
         origin,
         {blue_ground,
          right("specular"),
          left("red diffuse"),
          {{0, -3.5, -5}, 1.5, glass},
          lamp({0, 4, 5}, dvec3(300)),
          lamp({-4, 4, 5}, dvec3(300)),
          lamp({4, 4, 5}, dvec3(300))},
         {},
         {"/materials/8/eta"}},
        {6,
         pt,
         1024,
         6,
         low_eye,
         low,
         box_with({right("glossy"),
                   left(glass),
                   {{-2.5, -4.5, -5.5}, 0.5, "blue diffuse"},
                   {{2.5, -4.5, -5.5}, 0.5, "green diffuse"},
                   lamp({0, -0.5, -3}, dvec3(30))}),
         {},
         {}},
        {7,
         wrt,
         36,
         6,
         low_far,
         low,
         row("specular"),
         {{"upper lamp", {6, 2, -1}, {320, 300, 280}}, {"lower lamp", {-6, -4, -1}, {50, 60, 70}}},
         {}},
        {8, pt, 4096, 6, low_far, low, lit_row, {}, {}},
    };
}

/// What a material id stands for in scene `number`.
Material expected_material(const std::string& id, int number) {
    const std::map<std::string, Material> table{
        {"red diffuse", {id, MaterialKind::diffuse, {0.9, 0, 0}, dvec3(0), 1, 0}},
        {"green diffuse", {id, MaterialKind::diffuse, {0, 0.9, 0}, dvec3(0), 1, 0}},
        {"blue diffuse",
         {id, MaterialKind::diffuse, number == 5 ? dvec3(0.4, 0.4, 0.9) : dvec3(0, 0, 0.9), dvec3(0), 1, 0}},
        {"grey diffuse", {id, MaterialKind::diffuse, dvec3(0.8), dvec3(0), 1, 0}},
        {"white diffuse", {id, MaterialKind::diffuse, dvec3(1), dvec3(0), 1, 0}},
        {"specular", {id, MaterialKind::specular, dvec3(0.9), dvec3(0), 1, 0}},
        {"glossy", {id, MaterialKind::glossy, dvec3(0.9), dvec3(0), 1, number == 8 ? 0.4 : 0.1}},
        {"fresnel dielectric", {id, MaterialKind::dielectric, dvec3(0.9), dvec3(0.9), 1.5, 0}},
    };
    return table.at(id);
}

class AssignmentTest : public testing::TestWithParam<Facts> {
protected:
    std::filesystem::path file() const {
        return scenes_folder() / ("assignment_0" + std::to_string(GetParam().number) + ".json");
    }
    ReadResult result_ = read_scene(file());
};

TEST_P(AssignmentTest, ReadsWithTheWarningsItsQuirksEarn) {
    ASSERT_TRUE(result_.scene.has_value()) << listing(result_);
    std::vector<std::string> places;
    for (const Diagnostic& diagnostic : result_.diagnostics) places.push_back(diagnostic.where);
    EXPECT_EQ(places, GetParam().warnings) << listing(result_);
}

TEST_P(AssignmentTest, CameraAndSettings) {
    const Facts& facts = GetParam();
    const Scene& scene = result_.scene.value();
    EXPECT_EQ(scene.file, file());
    EXPECT_EQ(scene.camera.position, facts.eye);
    EXPECT_EQ(scene.camera.target, facts.target);
    EXPECT_EQ(scene.camera.fov, 45);
    EXPECT_EQ(scene.camera.aspect, 1);
    EXPECT_EQ(scene.camera.aperture, 0);
    EXPECT_EQ(scene.settings.integrator, facts.integrator);
    EXPECT_EQ(scene.settings.width, 512u);
    EXPECT_EQ(scene.settings.height, 512u);
    EXPECT_EQ(scene.settings.samples, facts.samples);
    EXPECT_EQ(scene.settings.depth, facts.depth);
    EXPECT_EQ(scene.background, dvec3(0));
    const auto name = "assignment_0" + std::to_string(facts.number) + ".ppm";
    EXPECT_EQ(scene.settings.output, scenes_folder().parent_path() / "output" / name);
}

TEST_P(AssignmentTest, PrimitivesAndLights) {
    const Facts& facts = GetParam();
    const Scene& scene = result_.scene.value();
    ASSERT_EQ(scene.primitives.size(), facts.balls.size());
    for (std::size_t i = 0; i < facts.balls.size(); ++i) {
        const Primitive& primitive = scene.primitives[i];
        const Ball& ball = facts.balls[i];
        EXPECT_EQ(primitive.centre, ball.centre) << i;
        EXPECT_EQ(primitive.radius, ball.radius) << i;
        EXPECT_EQ(primitive.emission, ball.emission) << i;
        const Material& found = scene.materials.at(primitive.material);
        EXPECT_EQ(found.id, ball.material) << i;
        const Material expected = expected_material(found.id, facts.number);
        EXPECT_EQ(found.kind, expected.kind) << found.id;
        EXPECT_EQ(found.rho, expected.rho) << found.id;
        EXPECT_EQ(found.rho_t, expected.rho_t) << found.id;
        EXPECT_EQ(found.eta, expected.eta) << found.id;
        EXPECT_EQ(found.roughness, expected.roughness) << found.id;
    }
    ASSERT_EQ(scene.point_lights.size(), facts.point_lights.size());
    for (std::size_t i = 0; i < facts.point_lights.size(); ++i) {
        EXPECT_EQ(scene.point_lights[i].id, facts.point_lights[i].id);
        EXPECT_EQ(scene.point_lights[i].position, facts.point_lights[i].position);
        EXPECT_EQ(scene.point_lights[i].intensity, facts.point_lights[i].intensity);
    }
}

TEST_P(AssignmentTest, OnlyWornMaterialsAreKept) {
    const Scene& scene = result_.scene.value();
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        EXPECT_TRUE(std::any_of(scene.primitives.begin(), scene.primitives.end(), [&](const Primitive& primitive) {
            return primitive.material == i;
        })) << scene.materials[i].id;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, AssignmentTest, testing::ValuesIn(all_facts()),
                         [](const testing::TestParamInfo<Facts>& test) { return std::to_string(test.param.number); });

}  // namespace
}  // namespace orrery::test
