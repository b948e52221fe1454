// Runs stage `intersect` and compares it with textbook roots in extended precision.
#pragma once

#include "geometry.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "owned.hpp"

namespace orrery::kernel_tests {

/// The stated accuracy: a distance errs by at most this many units of rounding (2^-24) times the `reach` of
/// geometry.hpp. Measured: between 1 and 2.
inline constexpr double accuracy = 4 * 0x1p-24;

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
    Result one(const World& world, const glm::dvec3& o, const glm::dvec3& d,
               std::uint32_t left = kernels::no_sphere) const {
        Rays rays(kernels::widest);
        put_ray(*rays, 0, o, d, left);
        const Hits hits = run(world, rays, 1);
        return {hits->t[0], hits->id[0]};
    }

    /// Rays against `world`, each as `make(i, rays)` puts it; all that is not decided by rounding must agree.
    template <class Make>
    void expect_agrees(const World& world, std::uint32_t count, Make&& make, double most_open = 0.1) const {
        Rays rays(kernels::round_up(count) + kernels::widest);
        for (std::uint32_t i = 0; i < count; ++i) make(i, *rays);
        const Hits hits = run(world, rays, count);
        std::uint32_t open = 0, met = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Meeting wanted = meet(world, origin_of(*rays, i), direction_of(*rays, i), rays->departed[i]);
            if (wanted.open) {
                ++open;
                continue;
            }
            met += wanted.id != kernels::no_sphere;
            ASSERT_EQ(hits->id[i], wanted.id) << "ray " << i << ", t " << hits->t[i] << ", not " << wanted.t;
            if (wanted.id == kernels::no_sphere) {
                ASSERT_EQ(hits->t[i], std::numeric_limits<float>::infinity());
            } else {
                ASSERT_NEAR(hits->t[i], wanted.t, accuracy * wanted.reach) << "ray " << i;
            }
        }
        EXPECT_LE(open, most_open * count) << "too many rays too close to call";
        EXPECT_GE(met, count / 10) << "too few rays meet anything";
    }
};

}  // namespace orrery::kernel_tests
