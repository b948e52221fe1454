// Stage `intersect` on random worlds: sizes over six orders of magnitude, rays from outside, inside and on the spheres.
#include "intersect_fixture.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;

/// Spheres over six orders of magnitude, large ones far away, overlapping as they happen to.
std::vector<Ball> assorted_balls(std::uint32_t count, std::uint64_t seed) {
    Numbers random(seed);
    std::vector<Ball> balls(count);
    for (Ball& ball : balls) {
        ball.radius = random.scale(1e-3, 1e3);
        ball.centre = random.direction() * (random.between(0.2, 4) * ball.radius + random.between(0, 2));
    }
    return balls;
}

glm::dvec3 on_ball(const World& world, std::uint32_t k, const glm::dvec3& normal) {
    return world.centre(k) + world.radius(k) * normal;
}

TEST_P(IntersectTest, RaysFromAnywhereAtSpheresOfEverySize) {
    const std::vector<Ball> balls = assorted_balls(20, 1);
    const World world(balls);
    Numbers random(2);
    for (const std::uint32_t count : awkward_counts)
        expect_agrees(world, count, [&](std::uint32_t i, const RayView& rays) {
            put_ray(rays, i, random.direction() * random.scale(1e-2, 1e3), random.direction());
        });
    // Aimed at one of them, so that the small ones are met as well.
    expect_agrees(world, 10001, [&](std::uint32_t i, const RayView& rays) {
        const Ball& ball = balls[random.below(20)];
        const glm::dvec3 o = random.direction() * random.scale(1e-1, 1e2);
        put_ray(rays, i, o, ball.centre + random.direction() * ball.radius * random.uniform() - o);
    });
}

TEST_P(IntersectTest, RaysFromWithin) {
    const World world(assorted_balls(20, 3));
    Numbers random(4);
    expect_agrees(world, 10001, [&](std::uint32_t i, const RayView& rays) {
        const std::uint32_t k = random.below(20);
        put_ray(rays, i, on_ball(world, k, random.direction() * random.uniform()), random.direction());
    });
}

// Distant small spheres, up to 10^5 radii away: the case where b^2 - c loses hits.
TEST_P(IntersectTest, FarAwaySpheres) {
    std::vector<Ball> balls;
    Numbers random(5);
    for (int i = 0; i < 20; ++i) balls.push_back({random.direction() * random.scale(10, 1e4), 0.1});
    const World world(balls);
    expect_agrees(world, 10001, [&](std::uint32_t i, const RayView& rays) {
        const Ball& ball = balls[random.below(20)];
        // Within 0.9 of the outline: at 10^5 radii a float direction itself is good to a hundredth of the radius.
        const glm::dvec3 o = random.direction();
        put_ray(rays, i, o, ball.centre + random.direction() * (0.09 * random.uniform()) - o);
    });
}

// The eye one above a ground of radius 1000: the distance is 1 and the quadratic's numbers a million.
TEST_P(IntersectTest, GroundSeenFromUpClose) {
    const World world({{glm::dvec3(0, -1000, 0), 1000}, {glm::dvec3(0, 1, 3), 1}});
    Numbers random(6);
    expect_agrees(world, 10001, [&](std::uint32_t i, const RayView& rays) {
        put_ray(rays, i, {0, 1, 0}, {random.between(-1, 1), random.between(-1, 0.3), random.between(-1, 1)});
    });
}

TEST_P(IntersectTest, OutwardRaysNeverMeetTheirSphereAgain) {
    const std::vector<Ball> balls = assorted_balls(20, 7);
    const World world(balls);
    Numbers random(8);
    const auto outward = [&](std::uint32_t i, const RayView& rays) {
        const std::uint32_t k = random.below(20);
        const glm::dvec3 n = random.direction();
        glm::dvec3 d = random.direction();
        if (glm::dot(d, n) < 0) d = -d;
        if (i % 4 == 0) d = glm::normalize(d - n * glm::dot(d, n));  // along the surface
        put_ray(rays, i, on_ball(world, k, n), d, k);
    };
    expect_agrees(world, 10001, outward);
    for (std::uint32_t k = 0; k < 20; ++k) {
        const World alone({balls[k]});
        Rays rays(kernels::round_up(1001));
        for (std::uint32_t i = 0; i < 1001; ++i) {
            outward(i, *rays);
            rays->departed[i] = 0;
        }
        const Hits hits = run(alone, rays, 1001);
        for (std::uint32_t i = 0; i < 1001; ++i) ASSERT_EQ(hits->id[i], no_sphere);
    }
}

TEST_P(IntersectTest, InwardRaysMeetExactlyTheFarSide) {
    const std::vector<Ball> balls = assorted_balls(20, 9);
    const World world(balls);
    Numbers random(10);
    const auto inward = [&](std::uint32_t i, const RayView& rays, const World& in, std::uint32_t k) {
        const glm::dvec3 n = random.direction();
        glm::dvec3 d = random.direction();
        if (glm::dot(d, n) > 0) d = -d;
        put_ray(rays, i, on_ball(in, k, n), d, k | inside_bit);
    };
    expect_agrees(world, 10001,
                  [&](std::uint32_t i, const RayView& rays) { inward(i, rays, world, random.below(20)); });
    // Alone, an inward ray always arrives, grazing ones included: no ray is lost inside.
    for (const Ball& ball : balls) {
        const World alone({ball});
        Rays rays(kernels::round_up(1001));
        for (std::uint32_t i = 0; i < 1001; ++i) inward(i, *rays, alone, 0);
        const Hits hits = run(alone, rays, 1001);
        for (std::uint32_t i = 0; i < 1001; ++i) {
            ASSERT_EQ(hits->id[i], inside_bit);
            ASSERT_GE(hits->t[i], 0.0f);
        }
    }
}

// The scene has no length of its own: multiplied by a power of two, it gives the same bits but for the exponent.
TEST_P(IntersectTest, ScalesByPowersOfTwo) {
    std::vector<Ball> balls = assorted_balls(20, 12);
    for (const int exponent : {-20, 20}) {
        const double k = std::ldexp(1.0, exponent);
        std::vector<Ball> scaled = balls;
        for (Ball& ball : scaled) ball.centre *= k, ball.radius *= k;
        Numbers random(13);
        Rays rays(kernels::round_up(125)), larger(kernels::round_up(125));
        for (std::uint32_t i = 0; i < 125; ++i) {
            const glm::dvec3 o = random.point(3), d = random.direction();
            put_ray(*rays, i, o, d);
            put_ray(*larger, i, k * o, d);
        }
        const Hits a = run(World(balls), rays, 125), b = run(World(scaled), larger, 125);
        for (std::uint32_t i = 0; i < 125; ++i) {
            ASSERT_EQ(b->id[i], a->id[i]);
            ASSERT_EQ(static_cast<double>(b->t[i]), k * static_cast<double>(a->t[i]));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, IntersectTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
