// Stage `shadow`: light arrives exactly where the textbook finds no sphere in between.
#include "geometry.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "owned.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;

class ShadowTest : public KernelTest {
protected:
    static void put(const Shadows& q, std::uint32_t i, const glm::dvec3& o, const glm::dvec3& d, double t_max,
                    std::uint32_t left, const glm::dvec3& light, std::uint32_t slot) {
        put3(q->ox, q->oy, q->oz, i, o);
        put3(q->dx, q->dy, q->dz, i, glm::normalize(d));
        put3(q->r, q->g, q->b, i, light);
        q->inverse_t_max[i] = narrow(1 / t_max);
        q->departed[i] = left;
        q->slot[i] = slot;
    }
    static Slots slots_of(std::uint32_t count) {
        Slots slots(kernels::round_up(count) + kernels::widest);
        for (std::uint32_t i = 0; i < 4 * count; ++i) slots->radiance[i] = static_cast<float>(i % 7) / 8;
        return slots;
    }

    static inline const std::vector<std::uint32_t> counts = [] {
        std::vector<std::uint32_t> all = awkward_counts;
        all.push_back(5001);
        return all;
    }();
    /// Segments in a world of 20 balls.
    static void put_some(const Shadows& queue, std::uint32_t count, const World& world, Numbers& random) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t k = random.below(20);
            const glm::dvec3 n = random.direction();
            glm::dvec3 d = random.direction();
            if (glm::dot(d, n) < 0) d = -d;
            // From free space, outward from a sphere, and into one.
            std::uint32_t left = no_sphere;
            glm::dvec3 o = random.point(6);
            if (i % 3 != 0) o = world.centre(k) + world.radius(k) * n, left = k;
            if (i % 3 == 2) d = -d, left = k | inside_bit;
            // Two segments per slot here and there; distances from nearby to infinite.
            const std::uint32_t slot = i % 10 == 9 ? i - 1 : i;
            const double t_max = i % 7 == 0 ? std::numeric_limits<double>::infinity() : random.scale(0.01, 20);
            put(queue, i, o, d, t_max, left, random.colour(), slot);
        }
    }

    /// Compares all segments that rounding does not decide; returns how many were lit.
    std::uint32_t expect_agrees(const World& world, const Shadows& queue, std::uint32_t count,
                                std::uint32_t skip) const {
        const Slots before = slots_of(count);
        Slots slots = before;
        Shadows same_queue = queue;
        stages.shadow(world.spheres, *same_queue, count, skip, *slots);
        EXPECT_TRUE(same_queue.same_as(queue, -Shadows::guard, queue.capacity() + Shadows::guard)) << "only read";
        EXPECT_TRUE(slots.untouched_but(before, 0, count));
        std::uint32_t lit = 0, open = 0;
        std::vector<glm::dvec3> wanted(count, glm::dvec3(0));
        std::vector<bool> unsure(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t slot = queue->slot[i];
            const Meeting met =
                meet(world, get3(queue->ox, queue->oy, queue->oz, i), get3(queue->dx, queue->dy, queue->dz, i),
                     queue->departed[i], 0, 1 / static_cast<double>(queue->inverse_t_max[i]),
                     queue->target != nullptr ? queue->target[i] : skip);
            if (met.open) unsure[slot] = true, ++open;
            if (met.id == no_sphere) wanted[slot] += get3(queue->r, queue->g, queue->b, i), ++lit;
        }
        EXPECT_LE(open, 1 + count / 20);
        for (std::uint32_t s = 0; s < count; ++s)
            for (int c = 0; c < 4 && !unsure[s]; ++c) {
                const std::uint32_t at = 4 * s + static_cast<std::uint32_t>(c);
                EXPECT_NEAR(slots->radiance[at], before->radiance[at] + (c < 3 ? wanted[s][c] : 0), 1e-6)
                    << "slot " << s;
            }
        if (exact()) {
            Slots same = before;
            scalar.shadow(world.spheres, *queue, count, skip, *same);
            EXPECT_TRUE(slots.same_as(same, 0, count));
        }
        return lit;
    }
};

std::vector<Ball> some_balls() {
    Numbers random(1);
    std::vector<Ball> balls(20);
    for (Ball& ball : balls) ball = {random.point(5), random.scale(0.02, 2)};
    return balls;
}

TEST_P(ShadowTest, SegmentsThroughAWorldOfSpheres) {
    const World world(some_balls());
    for (const std::uint32_t skip : {no_sphere, 0u, 7u}) {
        for (const std::uint32_t count : counts) {
            Numbers random(count + skip);
            Shadows queue(kernels::round_up(count) + kernels::widest);
            put_some(queue, count, world, random);
            const std::uint32_t lit = expect_agrees(world, queue, count, skip);
            if (count == 5001) {
                EXPECT_GT(lit, 500u);
                EXPECT_LT(lit, 4500u);
            }
        }
    }
}

// With a column of targets what is said for all of them does not count.
TEST_P(ShadowTest, EverySegmentMayEndOnASphereOfItsOwn) {
    const World world(some_balls());
    for (const std::uint32_t count : counts) {
        Numbers random(count);
        Shadows queue(kernels::round_up(count) + kernels::widest, Shadows::WithTargets{});
        put_some(queue, count, world, random);
        std::uint32_t on_another = 0, on_its_own = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t own = queue->departed[i] & no_sphere;
            const auto first_met = [&](std::uint32_t target) {
                return meet(world, get3(queue->ox, queue->oy, queue->oz, i), get3(queue->dx, queue->dy, queue->dz, i),
                            queue->departed[i], 0, 1 / static_cast<double>(queue->inverse_t_max[i]), target)
                           .id &
                       no_sphere;
            };
            const std::uint32_t blocker = first_met(no_sphere);
            queue->target[i] = i % 4 == 0 ? no_sphere : i % 4 == 1 ? random.below(20) : blocker;
            // Those that nothing but their target would have blocked.
            if (blocker != no_sphere && first_met(queue->target[i]) == no_sphere)
                ++(queue->target[i] == own ? on_its_own : on_another);
        }
        expect_agrees(world, queue, count, 3);
        if (count == 5001) {
            EXPECT_GT(on_another, 50u);
            EXPECT_GT(on_its_own, 50u) << "from the inner side of the light itself";
        }
    }
}

// Towards a light on the far side of the sphere whose surface it is on: blocked by that sphere, if it goes inward.
TEST_P(ShadowTest, ASphereShadowsItself) {
    const World world({{glm::dvec3(0), 1}});
    Shadows queue(16);
    put(queue, 0, {1, 0, 0}, {-1, 0, 0}, 5, 0 | inside_bit, {1, 1, 1},
        0);  // the light behind
    put(queue, 1, {1, 0, 0}, {-1, 0, 0}, 1, 0 | inside_bit, {1, 1, 1},
        1);  // the light within
    put(queue, 2, {1, 0, 0}, {1, 0, 0}, 5, 0, {1, 1, 1}, 2);
    EXPECT_EQ(expect_agrees(world, queue, 3, no_sphere), 2u);
    EXPECT_EQ(expect_agrees(world, queue, 3, 0), 3u) << "the light's own sphere blocks nothing";
}

// From a light's surface to the light: where segment and sphere end in the same point, the sphere must not block.
TEST_P(ShadowTest, WhatTouchesTheEndDoesNotBlock) {
    const World world({{glm::dvec3(5, 0, 0), 1}});
    Shadows queue(16);
    put(queue, 0, {0, 0, 0}, {1, 0, 0}, 4, no_sphere, {1, 1, 1}, 0);
    put(queue, 1, {0, 0, 0}, {1, 0, 0}, 4.001, no_sphere, {1, 1, 1}, 1);
    Slots slots = slots_of(2);
    const Slots before = slots;
    stages.shadow(world.spheres, *queue, 2, no_sphere, *slots);
    EXPECT_EQ(slots->radiance[0], before->radiance[0] + 1);
    EXPECT_EQ(slots->radiance[4], before->radiance[4]);
}

TEST_P(ShadowTest, EmptyWorldAndEmptyQueue) {
    const World empty(std::vector<Ball>{});
    Shadows queue(32);
    for (std::uint32_t i = 0; i < 17; ++i) put(queue, i, {0, 0, 0}, {1, 0, 0}, 2, no_sphere, {1, 1, 1}, i);
    EXPECT_EQ(expect_agrees(empty, queue, 17, no_sphere), 17u);
    EXPECT_EQ(expect_agrees(empty, queue, 0, no_sphere), 0u);
}

INSTANTIATE_TEST_SUITE_P(Isas, ShadowTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
