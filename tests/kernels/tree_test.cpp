// The tree against the textbook and against every sphere in turn: nothing lost, nothing invented, nothing that depends
// on the company a ray is in.
#include "intersect_fixture.hpp"
#include "kernels/segment.hpp"
#include "planted.hpp"
#include "tree_worlds.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;

Rays rays_in(const World& world, std::uint32_t count, std::uint64_t seed) {
    Rays rays(kernels::round_up(count) + kernels::widest);
    HardRays make(world, seed);
    for (std::uint32_t i = 0; i < count; ++i) make(i, *rays);
    return rays;
}

/// The least (t, id) among all spheres, by the kernels' own maths: what culling must not change in the last bit.
struct Nearest {
    float t = std::numeric_limits<float>::infinity();
    std::uint32_t id = no_sphere;
};
Nearest nearest_of_all(const World& world, const RayView& rays, std::uint32_t i) {
    using One = kernels::ScalarLanes<float>;
    const kernels::Vec3<float> o{rays.ox[i], rays.oy[i], rays.oz[i]}, d{rays.dx[i], rays.dy[i], rays.dz[i]};
    const std::uint32_t left = rays.departed[i] & no_sphere;
    Nearest best;
    for (std::uint32_t k = 0; k < world.spheres.count; ++k) {
        const auto sphere = kernels::broadcast_sphere<One>(world.spheres, k);
        Nearest found;
        if (k == left) {
            if (rays.departed[i] == left) continue;
            found = {kernels::inner_far_root(o, d, sphere), rays.departed[i]};
        } else {
            const auto line = kernels::chord(o, d, sphere);
            if (!(line.disc >= 0)) continue;
            const auto root = kernels::first_root<One>(line, std::sqrt(line.disc), kernels::FromOrigin{}, true);
            if (!root.exists) continue;
            found = {root.num / root.den, k | (root.inside ? inside_bit : 0)};
        }
        if (found.t < best.t) best = found;
    }
    return best;
}

class TreeTest : public IntersectTest {
protected:
    Hits cast(const kernels::Stages<float>& by, const World& world, const Rays& rays, std::uint32_t count) const {
        Hits hits(kernels::round_up(count) + kernels::widest);
        const Hits before = hits;
        by.intersect_tree(world.spheres, *rays, count, *hits);
        EXPECT_TRUE(hits.untouched_but(before, 0, kernels::round_up(count)));
        return hits;
    }
    void expect_right(const World& world, const std::string& name, std::uint32_t count, std::uint64_t seed) const {
        SCOPED_TRACE(name);
        const Rays rays = rays_in(world, count, seed);
        const Hits hits = cast(stages, world, rays, count);
        if (exact()) {
            EXPECT_TRUE(hits.same_as(cast(scalar, world, rays, count), 0, count));
        }
        std::uint32_t met = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (exact()) {
                const Nearest wanted = nearest_of_all(world, *rays, i);
                ASSERT_EQ(hits->id[i], wanted.id) << "ray " << i;
                ASSERT_EQ(hits->t[i], wanted.t) << "ray " << i;
            }
            met += hits->id[i] != no_sphere;
            const Meeting wanted = meet(world, origin_of(*rays, i), direction_of(*rays, i), rays->departed[i]);
            if (wanted.open) continue;
            ASSERT_EQ(hits->id[i], wanted.id) << "ray " << i << ", t " << hits->t[i] << ", not " << wanted.t;
            if (wanted.id != no_sphere) {
                ASSERT_NEAR(hits->t[i], wanted.t, accuracy * wanted.reach) << "ray " << i;
            }
        }
        if (count > 100) {
            EXPECT_GT(met, count / 20);
        }
    }
};

TEST_P(TreeTest, FindsWhatEverySphereInTurnFinds) {
    for (const std::uint32_t size : {1u, 2u, 15u, 16u, 17u, 33u, 257u, 1000u, 5000u}) {
        const Planted planted(scattered_balls(size, size));
        expect_right(*planted, std::to_string(size) + " spheres", size > 1000 ? 700 : 2000, size);
    }
}

TEST_P(TreeTest, FindsItInHardWorlds) {
    std::uint64_t seed = 1;
    for (const TreeWorld& hard : hard_worlds()) expect_right(*Planted(hard.balls), hard.name, 1500, ++seed);
}

TEST_P(TreeTest, QueuesOfAnyLength) {
    const Planted planted(scattered_balls(100, 5));
    for (const std::uint32_t count : {0u, 1u, 3u, 15u, 17u, 125u, 255u, 256u, 257u, 600u})
        expect_right(*planted, std::to_string(count) + " rays", count, count);
}

// A ray alone and in company, in whatever place: the promise that waves and threads change no byte rests on it.
TEST_P(TreeTest, CompanyChangesNothing) {
    const Planted planted(hard_worlds()[3].balls);
    constexpr std::uint32_t count = 500;
    const Rays rays = rays_in(*planted, count, 9);
    const Hits together = cast(stages, *planted, rays, count);
    for (std::uint32_t i = 0; i < count; i += 7) {
        Hits alone(kernels::widest);
        stages.intersect_tree(planted->spheres, from(rays, i), 1, *alone);
        EXPECT_EQ(alone->id[0], together->id[i]);
        EXPECT_EQ(alone->t[0], together->t[i]);
    }
}

// Equally far is what identical spheres are: the first in the table is it, as in the loop.
TEST_P(TreeTest, OfEquallyNearTheFirst) {
    const Planted planted(hard_worlds()[2].balls);
    Rays rays(kernels::widest);
    put_ray(*rays, 0, {1, 2, -5}, {0, 0, 1});
    const Hits hits = cast(stages, *planted, rays, 1);
    EXPECT_EQ(hits->id[0], 0u);
    EXPECT_EQ(hits->t[0], 7.0f);
}

/// Segments of the rays: some begin and end anywhere, some at infinity.
struct Ends {
    std::vector<float> t_min, t_max;
};
Ends ends_of(std::uint32_t count, std::uint64_t seed) {
    Numbers random(seed);
    Ends ends;
    for (std::uint32_t i = 0; i < kernels::round_up(count) + kernels::widest; ++i) {
        ends.t_min.push_back(i % 3 == 0 ? 0 : narrow(random.scale(0.01, 10)));
        ends.t_max.push_back(i % 4 == 0 ? std::numeric_limits<float>::infinity()
                                        : ends.t_min.back() + narrow(random.scale(0.01, 20)));
    }
    return ends;
}

TEST_P(TreeTest, SegmentsInColumnsAndOneByOne) {
    constexpr std::uint32_t count = 1001;
    std::uint32_t open = 0, met = 0;
    for (const TreeWorld& hard : hard_worlds()) {
        SCOPED_TRACE(hard.name);
        const Planted planted(hard.balls);
        const Rays rays = rays_in(*planted, count, 21);
        const Ends ends = ends_of(count, 22);
        const kernels::SegmentColumns<float> segments{rays->ox, rays->oy, rays->oz,          rays->dx,
                                                      rays->dy, rays->dz, ends.t_min.data(), ends.t_max.data()};
        Hits hits(kernels::round_up(count) + kernels::widest), occluded = hits;
        const Hits before = hits;
        stages.intersects(planted->spheres, segments, count, *hits);
        stages.is_occluded(planted->spheres, segments, count, occluded->id);
        EXPECT_TRUE(hits.untouched_but(before, 0, kernels::round_up(count)));
        EXPECT_TRUE(occluded.untouched_but(before, 0, kernels::round_up(count)));
        for (std::uint32_t i = 0; i < count; ++i) {
            const kernels::Segment<float> one{rays->ox[i], rays->oy[i], rays->oz[i],   rays->dx[i],
                                              rays->dy[i], rays->dz[i], ends.t_min[i], ends.t_max[i]};
            const Meeting wanted = meet(*planted, origin_of(*rays, i), direction_of(*rays, i), no_sphere,
                                        static_cast<double>(ends.t_min[i]), static_cast<double>(ends.t_max[i]));
            if (wanted.open) {
                ++open;
                continue;
            }
            met += wanted.id != no_sphere;
            ASSERT_EQ(hits->id[i], wanted.id) << "segment " << i;
            ASSERT_EQ(occluded->id[i], wanted.id != no_sphere ? 1u : 0u) << "segment " << i;
            if (wanted.id == no_sphere) {
                ASSERT_EQ(hits->t[i], ends.t_max[i]);
            }
            const auto scalar_form = kernels::intersects(planted->spheres, one);
            ASSERT_EQ(scalar_form.sphere | (scalar_form.inside ? inside_bit : 0), wanted.id) << "segment " << i;
            ASSERT_EQ(kernels::is_occluded(planted->spheres, one), wanted.id != no_sphere) << "segment " << i;
        }
    }
    EXPECT_LT(open, 4 * count);
    EXPECT_GT(met, 2 * count);
}

TEST_P(TreeTest, ShadowsWhatTheLoopShadows) {
    constexpr std::uint32_t count = 2003, own_target = ~0u;
    for (const TreeWorld& hard : hard_worlds()) {
        SCOPED_TRACE(hard.name);
        const Planted planted(hard.balls);
        const Rays rays = rays_in(*planted, count, 31);
        Numbers random(32);
        Shadows queue(kernels::round_up(count) + kernels::widest);
        for (std::uint32_t i = 0; i < count; ++i) {
            put3(queue->ox, queue->oy, queue->oz, i, origin_of(*rays, i));
            put3(queue->dx, queue->dy, queue->dz, i, direction_of(*rays, i));
            put3(queue->r, queue->g, queue->b, i, random.colour());
            queue->inverse_t_max[i] = i % 7 == 0 ? 0 : narrow(1 / random.scale(0.1, 30));
            queue->departed[i] = rays->departed[i];
            queue->slot[i] = i / 2;
        }
        const auto size = static_cast<std::uint32_t>(hard.balls.size());
        Shadows with_targets(kernels::round_up(count) + kernels::widest, Shadows::WithTargets{});
        kernels::ShadowQueue<float>::each_field([&](const char*, auto field) {
            if ((*queue).*field != nullptr) std::copy_n((*queue).*field, count, (*with_targets).*field);
        });
        for (std::uint32_t i = 0; i < count; ++i)
            with_targets->target[i] = i % 3 == 0   ? queue->departed[i] & no_sphere
                                      : i % 3 == 1 ? no_sphere
                                                   : random.below(size);
        for (const std::uint32_t skip : {no_sphere, 0u, 40u, own_target}) {
            const auto& shadows = skip == own_target ? with_targets : queue;
            Slots slots(kernels::round_up(count) + kernels::widest);
            for (std::uint32_t i = 0; i < 4 * count; ++i) slots->radiance[i] = 0;
            const Slots before = slots;
            Slots by_loop = slots, by_scalar = slots;
            stages.shadow_tree(planted->spheres, *shadows, count, skip, *slots);
            EXPECT_TRUE(slots.untouched_but(before, 0, count));
            // The loop has the same maths and no tree: it must agree in the last bit.
            stages.shadow(planted.bare(), *shadows, count, skip, *by_loop);
            if (exact()) {
                EXPECT_TRUE(slots.same_as(by_loop, 0, count));
                scalar.shadow_tree(planted->spheres, *shadows, count, skip, *by_scalar);
                EXPECT_TRUE(slots.same_as(by_scalar, 0, count));
            }
        }
    }
}

TEST_P(TreeTest, AnEmptyTableHasNoTree) {
    const Planted planted(std::vector<Ball>{});
    EXPECT_EQ(planted->spheres.tree.count, 0u);
}

INSTANTIATE_TEST_SUITE_P(Isas, TreeTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
