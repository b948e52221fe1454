// Stage `intersect` where the right answer is known by hand: tangents, touching, nested and nearly coincident spheres,
// origins exactly on a surface.
#include "intersect_fixture.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;

class IntersectCases : public IntersectTest {};

TEST_P(IntersectCases, TangentsMiss) {
    const World world({{glm::dvec3(0, 0, 0), 1}});
    EXPECT_EQ(one(world, {-5, 1, 0}, {1, 0, 0}).id, no_sphere);
    EXPECT_EQ(one(world, {0, -1, 8}, {0, 0, -1}).id, no_sphere);
    EXPECT_EQ(one(world, {-5, 1 + 0x1p-20, 0}, {1, 0, 0}).id, no_sphere);
    EXPECT_EQ(one(world, {-5, 1 - 0x1p-20, 0}, {1, 0, 0}).id, 0u);
    EXPECT_EQ(one(world, {5, 0, 0}, {1, 0, 0}).id, no_sphere) << "behind the ray";
}

// The origin to the last bit on a sphere it did not leave (c == 0): nothing is hit at t = 0.
TEST_P(IntersectCases, OriginOnASurfaceMeetsItOnlyFurtherOn) {
    const World world({{glm::dvec3(2, 0, 0), 1}});
    EXPECT_EQ(one(world, {1, 0, 0}, {-1, 0, 0}).id, no_sphere);
    EXPECT_EQ(one(world, {1, 0, 0}, {0, 1, 0}).id, no_sphere) << "along the surface";
    const Result far = one(world, {1, 0, 0}, {1, 0, 0});
    EXPECT_EQ(far.id, 0 | inside_bit);
    EXPECT_EQ(far.t, 2);
    const Result slanted = one(world, {1, 0, 0}, {0.6, 0.8, 0});
    EXPECT_EQ(slanted.id, 0 | inside_bit);
    EXPECT_NEAR(slanted.t, 1.2, 1e-6);
}

TEST_P(IntersectCases, TouchingSpheres) {
    const World world({{glm::dvec3(0, 0, 0), 1}, {glm::dvec3(2, 0, 0), 1}});
    const glm::dvec3 touch(1, 0, 0);
    const Result across = one(world, touch, {1, 0, 0}, 0);
    EXPECT_EQ(across.id, 1 | inside_bit) << "out of the first, it is on the second already: its far side is next";
    EXPECT_EQ(across.t, 2);
    const Result back = one(world, touch, {-1, 0, 0}, 0 | inside_bit);
    EXPECT_EQ(back.id, 0 | inside_bit);
    EXPECT_EQ(back.t, 2);
    EXPECT_EQ(one(world, touch, {0, 1, 0}, 0).id, no_sphere) << "between them";
    EXPECT_EQ(one(world, {-3, 0, 0}, {1, 0, 0}).id, 0u);
}

TEST_P(IntersectCases, NestedSpheres) {
    const World world({{glm::dvec3(0), 2}, {glm::dvec3(0), 1}, {glm::dvec3(0), 0.5}});
    const auto expect = [&](const glm::dvec3& o, const glm::dvec3& d, std::uint32_t left, std::uint32_t id, double t) {
        const Result hit = one(world, o, d, left);
        EXPECT_EQ(hit.id, id);
        EXPECT_EQ(hit.t, t);
    };
    expect({-4, 0, 0}, {1, 0, 0}, no_sphere, 0, 2);
    expect({-2, 0, 0}, {1, 0, 0}, 0 | inside_bit, 1, 1);
    expect({-1, 0, 0}, {1, 0, 0}, 1 | inside_bit, 2, 0.5);
    expect({-0.5, 0, 0}, {1, 0, 0}, 2 | inside_bit, 2 | inside_bit, 1);
    expect({0.5, 0, 0}, {1, 0, 0}, 2, 1 | inside_bit, 0.5);
    expect({1, 0, 0}, {1, 0, 0}, 1, 0 | inside_bit, 1);
    expect({0, 0, 0}, {0, 0, 1}, no_sphere, 2 | inside_bit, 0.5);
}

// A thin shell: 2^-12 of the radius between two surfaces, crossed at every angle.
TEST_P(IntersectCases, NearlyCoincidentSpheresStayInOrder) {
    const World world({{glm::dvec3(0), 1}, {glm::dvec3(0), 1 - 0x1p-12}});
    Numbers random(11);
    Rays rays(kernels::round_up(1001));
    for (std::uint32_t i = 0; i < 1001; ++i) {
        const glm::dvec3 n = random.direction();
        glm::dvec3 d = random.direction();
        if (glm::dot(d, n) > 0) d = -d;
        if (glm::dot(d, n) > -0.1) d = glm::normalize(d - n);  // steep enough to reach the inner one
        put_ray(*rays, i, n, d, 0 | inside_bit);
    }
    const Hits hits = run(world, rays, 1001);
    for (std::uint32_t i = 0; i < 1001; ++i) ASSERT_EQ(hits->id[i], 1u);
}

TEST_P(IntersectCases, NoSpheresNoHits) {
    const World world(std::vector<Ball>{});
    Rays rays(32);
    for (std::uint32_t i = 0; i < 17; ++i) put_ray(*rays, i, {0, 0, 0}, {0, 0, 1});
    const Hits hits = run(world, rays, 17);
    for (std::uint32_t i = 0; i < 17; ++i) {
        EXPECT_EQ(hits->id[i], no_sphere);
        EXPECT_EQ(hits->t[i], std::numeric_limits<float>::infinity());
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, IntersectCases, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
