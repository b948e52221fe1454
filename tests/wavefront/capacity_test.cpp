// Queues hold what a wave can fill them with, however unluckily its rays are spread over the ways of scattering.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "wavefront/scenes.hpp"

namespace orrery::test {
namespace {

/// One row of pixels, wider than high, each looking at a ball of its own: pixel i meets materials[kinds[i]], but for a
/// few rays that pass its edge.
Scene row(const std::vector<std::size_t>& kinds) {
    Scene scene = picture({0, 0, 0}, {0, 0, 1}, 0.1, 2);
    scene.materials = {diffuse(dvec3{0.5}), mirror(0.6), glossy(0.7, 0.3), glass(0.8, 1.5), glass(0.9, 1.4, 0.2)};
    const auto count = static_cast<double>(kinds.size());
    const double half_width = 0.3;
    scene.settings.width = static_cast<std::uint32_t>(kinds.size());
    scene.settings.height = 1;
    scene.camera.aspect = half_width / std::tan(scene.camera.fov / 2 * std::numbers::pi / 180);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const double x = half_width * (2 * static_cast<double>(i) + 1 - count) / count;
        const dvec3 centre = glm::normalize(dvec3{x, 0, 1});
        scene.primitives.push_back({"", centre, half_width / count, static_cast<std::uint32_t>(kinds[i]), {}});
    }
    scene.background = {1, 2, 3};
    return scene;
}

// Sorted runs begin on whole vectors, and a compressed store writes a whole vector, so that every kind may need most of
// two vectors more than it has rays. The worst case has a few rays of every kind: here 18 of one and 2 of each other,
// and the last kind's in different vectors.
TEST(Capacity, HoldsAFewRaysOfEveryKind) {
    std::vector<std::size_t> kinds(26, 0);
    kinds[1] = kinds[2] = 1;
    kinds[3] = kinds[4] = 2;
    kinds[5] = kinds[6] = 3;
    kinds[7] = kinds[20] = 4;
    Scene scene = row(kinds);
    for (scene.settings.seed = 0; scene.settings.seed < 20; ++scene.settings.seed) {
        for (const Isa isa : supported_isas()) {
            const Image together = image_of(scene, {.isa = isa, .wave_size = 26});
            const Image alone = image_of(scene, {.isa = isa, .wave_size = 1});
            ASSERT_EQ(together.pixels, alone.pixels) << isa_name(isa) << ", seed " << scene.settings.seed;
        }
    }
}

TEST(Capacity, HoldsAnyMixtureOfKinds) {
    std::uint32_t state = 1;  // any sequence will do
    for (int round = 0; round < 400; ++round) {
        std::vector<std::size_t> kinds(24 + static_cast<std::size_t>(round) % 9);
        for (std::size_t& kind : kinds) {
            state = state * 1664525u + 1013904223u;
            const std::size_t drawn = state >> 27;  // 0..31: one kind is frequent, the others are rare
            kind = drawn < 8 ? 1 + drawn / 2 : 0;
        }
        const Scene scene = row(kinds);
        const auto wave = static_cast<std::uint32_t>(kinds.size());
        ASSERT_EQ(image_of(scene, {.wave_size = wave}).pixels, image_of(scene, {.wave_size = 1}).pixels) << round;
    }
}

}  // namespace
}  // namespace orrery::test
