// Generated scenes: sound, of the size asked for, repeatable, and in the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "generated.hpp"
#include "scene/read.hpp"

namespace orrery::worlds {
namespace {

class WorldTest : public testing::TestWithParam<Kind> {};

Scene read(const std::string& text) {
    ReadResult result = read_scene_text(text, "folder/world.json");
    for (const Diagnostic& diagnostic : result.diagnostics) ADD_FAILURE() << format_diagnostic("world", diagnostic);
    return result.scene.value_or(Scene());
}

TEST_P(WorldTest, ReadsWithoutADiagnosticWhateverItsSize) {
    for (const std::uint64_t spheres : {1, 2, 3, 8, 1000, 20'000}) {
        const Scene scene = read(generated(GetParam(), spheres));
        EXPECT_EQ(scene.primitives.size(), spheres);
        EXPECT_GE(scene.point_lights.size(), 1u);
        EXPECT_EQ(scene.settings.output, "folder/picture.png");
    }
}

TEST_P(WorldTest, ASeedIsAWorld) {
    EXPECT_EQ(generated(GetParam(), 500, 7), generated(GetParam(), 500, 7));
    EXPECT_NE(generated(GetParam(), 500, 7), generated(GetParam(), 500, 8));
}

TEST_P(WorldTest, LinesHoldOneShapeOrOnePrimitive) {
    const std::string text = generated(GetParam(), 100);
    std::size_t shapes = 0, primitives = 0;
    for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
        end = text.find('\n', begin);
        ASSERT_NE(end, std::string::npos);
        const std::string line = text.substr(begin, end - begin);
        EXPECT_LE(line.size(), 120u) << line;
        shapes += line.find("\"sphere\"") != std::string::npos;
        primitives += line.find("\"geometric\"") != std::string::npos;
    }
    EXPECT_EQ(shapes, 100u);
    EXPECT_EQ(primitives, 100u);
}

/// Where spheres land on the image plane: x and y within [-1, 1] is in the picture.
struct Framing {
    double inside = 0;  ///< share of the spheres
    double width = 0;   ///< between the 5th and the 95th percentile of x, of 2
    double cover = 0;   ///< sum of the disks' areas over the picture's; overlaps count twice
};

Framing framing(const Scene& scene) {
    const Camera& camera = scene.camera;
    const glm::dvec3 z = glm::normalize(camera.target - camera.position);
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z)), y = glm::cross(z, x);
    const double half = std::tan(camera.fov * 3.14159265358979 / 360);
    std::vector<double> across;
    Framing found;
    for (const Primitive& p : scene.primitives) {
        const glm::dvec3 to = p.centre - camera.position;
        const double depth = glm::dot(to, z);
        if (depth <= p.radius) continue;  // behind the eye, or around it
        const double u = glm::dot(to, x) / depth / half, v = glm::dot(to, y) / depth / half;
        across.push_back(u);
        if (std::abs(u) > 1 || std::abs(v) > 1) continue;
        found.inside += 1;
        found.cover += 3.14159 * std::pow(p.radius / depth / half, 2) / 4;
    }
    std::sort(across.begin(), across.end());
    found.inside /= static_cast<double>(scene.primitives.size());
    found.width = across[across.size() * 95 / 100] - across[across.size() * 5 / 100];
    return found;
}

TEST_P(WorldTest, FillsThePictureForAnyNumberOfSpheres) {
    for (const std::uint64_t spheres : {200, 5000, 50'000}) {
        const Framing found = framing(read(generated(GetParam(), spheres)));
        EXPECT_GT(found.inside, GetParam() == Kind::cosmos ? 0.5 : 0.9) << spheres;
        EXPECT_GT(found.width, 0.6) << spheres;
        EXPECT_GT(found.cover, 0.02) << spheres;
    }
}

std::string name_of(const testing::TestParamInfo<Kind>& instance) {
    constexpr const char* names[] = {"random", "lattice", "cluster", "cosmos"};
    return names[static_cast<std::size_t>(instance.param)];
}

INSTANTIATE_TEST_SUITE_P(Kinds, WorldTest, testing::Values(Kind::random, Kind::lattice, Kind::cluster, Kind::cosmos),
                         name_of);

TEST(Lattice, SpheresOfARowDoNotTouch) {
    const World world = lattice(27, 0);
    for (std::uint64_t i = 0; i < 27; ++i)
        for (std::uint64_t j = 0; j < i; ++j)
            EXPECT_GT(glm::distance(world.sphere(i).centre, world.sphere(j).centre), 2.5 * world.sphere(i).radius);
}

TEST(Cosmos, RadiiSpanOrdersOfMagnitude) {
    const World world = cosmos(100'000, 0);
    std::vector<double> radii;
    for (std::uint64_t i = 0; i < 100'000; i += 2) radii.push_back(world.sphere(i).radius);  // of one galaxy
    std::sort(radii.begin(), radii.end());
    EXPECT_GT(radii.back() / radii.front(), 30);
    EXPECT_LT(radii[radii.size() / 2] / radii.front(), 2) << "most stars are small";
}

}  // namespace
}  // namespace orrery::worlds
