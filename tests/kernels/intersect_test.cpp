// Stage `intersect` against textbook roots in extended precision.
#include "geometry.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "owned.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;

/// The stated accuracy: a distance errs by at most this many units of rounding (2^-24) times the `reach` of
/// geometry.hpp. Measured: between 1 and 2.
constexpr double accuracy = 4 * 0x1p-24;

class IntersectTest : public KernelTest {
protected:
    /// Runs the stage on the first `count` rays and checks what it may and may not write.
    Hits run(const World& world, const Rays& rays, std::uint32_t count) const {
        Hits hits(kernels::round_up(count) + kernels::widest);
        const Hits before = hits;
        stages.intersect(world.spheres, *rays, count, *hits);
        EXPECT_TRUE(hits.untouched_but(before, 0, kernels::round_up(count)));
        if (exact()) {
            Hits same = before;
            scalar.intersect(world.spheres, *rays, count, *same);
            EXPECT_TRUE(hits.same_as(same, 0, count));
        }
        return hits;
    }

    struct Result {
        double t;
        std::uint32_t id;
    };
    Result one(const World& world, const glm::dvec3& o, const glm::dvec3& d, std::uint32_t left = no_sphere) const {
        Rays rays(kernels::widest);
        put_ray(*rays, 0, o, d, left);
        const Hits hits = run(world, rays, 1);
        return {hits->t[0], hits->id[0]};
    }

    /// Rays against `world`, each as `make(i, rays)` puts it; all that is not decided by rounding must agree.
    template <class Make>
    void expect_agrees(const World& world, std::uint32_t count, Make&& make) const {
        Rays rays(kernels::round_up(count) + kernels::widest);
        for (std::uint32_t i = 0; i < count; ++i) make(i, *rays);
        const Hits hits = run(world, rays, count);
        std::uint32_t open = 0, met = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Meeting wanted = meet(world, origin_of(*rays, i), direction_of(*rays, i), rays->left[i]);
            if (wanted.open) {
                ++open;
                continue;
            }
            met += wanted.id != no_sphere;
            ASSERT_EQ(hits->id[i], wanted.id) << "ray " << i << ", t " << hits->t[i] << ", not " << wanted.t;
            if (wanted.id == no_sphere) {
                ASSERT_EQ(hits->t[i], std::numeric_limits<float>::infinity());
            } else {
                ASSERT_NEAR(hits->t[i], wanted.t, accuracy * wanted.reach) << "ray " << i;
            }
        }
        EXPECT_LE(open, count / 10) << "too many rays too close to call";
        EXPECT_GE(met, count / 10) << "too few rays meet anything";
    }
};

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
            rays->left[i] = 0;
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

TEST_P(IntersectTest, TangentsMiss) {
    const World world({{glm::dvec3(0, 0, 0), 1}});
    EXPECT_EQ(one(world, {-5, 1, 0}, {1, 0, 0}).id, no_sphere);
    EXPECT_EQ(one(world, {0, -1, 8}, {0, 0, -1}).id, no_sphere);
    EXPECT_EQ(one(world, {-5, 1 + 0x1p-20, 0}, {1, 0, 0}).id, no_sphere);
    EXPECT_EQ(one(world, {-5, 1 - 0x1p-20, 0}, {1, 0, 0}).id, 0u);
    EXPECT_EQ(one(world, {5, 0, 0}, {1, 0, 0}).id, no_sphere) << "behind the ray";
}

// The origin to the last bit on a sphere it did not leave (c == 0): nothing is hit at t = 0.
TEST_P(IntersectTest, OriginOnASurfaceMeetsItOnlyFurtherOn) {
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

TEST_P(IntersectTest, TouchingSpheres) {
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

TEST_P(IntersectTest, NestedSpheres) {
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
TEST_P(IntersectTest, NearlyCoincidentSpheresStayInOrder) {
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

TEST_P(IntersectTest, NoSpheresNoHits) {
    const World world(std::vector<Ball>{});
    Rays rays(32);
    for (std::uint32_t i = 0; i < 17; ++i) put_ray(*rays, i, {0, 0, 0}, {0, 0, 1});
    const Hits hits = run(world, rays, 17);
    for (std::uint32_t i = 0; i < 17; ++i) {
        EXPECT_EQ(hits->id[i], no_sphere);
        EXPECT_EQ(hits->t[i], std::numeric_limits<float>::infinity());
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
