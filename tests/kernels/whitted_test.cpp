// Whitted's own steps: expire, branch, resume, and the order in which they walk a tree.
#include "geometry.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "optics_reference.hpp"
#include "owned.hpp"
#include "wavefront/wave_storage.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;
using kernels::Scattering;

/// A stack of its own for every slot; numbers and words behind guards.
struct Stack {
    Rays rays;
    Owned<kernels::HitQueue<float>> heights;
    kernels::BranchStack<float> view;

    Stack(std::uint32_t slots, std::uint32_t levels)
        : rays(std::size_t{slots} * levels, Rays::InTrees{}, {"pdf", "roulette_scale", "pixel", "sample"}),
          heights(slots) {
        view.slots = slots;
        view.height = heights->id;
        view.rays = *rays;
        for (std::uint32_t s = 0; s < slots; ++s) view.height[s] = 0;
    }
    Stack(const Stack& other) : rays(other.rays), heights(other.heights), view(other.view) {
        view.height = heights->id;
        view.rays = *rays;
    }
    Stack& operator=(const Stack&) = delete;

    ::testing::AssertionResult same_as(const Stack& other) const {
        auto same = rays.same_as(other.rays, -Rays::guard, rays.capacity() + Rays::guard);
        return same ? heights.same_as(other.heights, -Hits::guard, heights.capacity() + Hits::guard) : same;
    }
};

class WhittedTest : public KernelTest {};

TEST_P(WhittedTest, RaysExpireAtTheDepth) {
    for (const std::uint32_t depth : {0u, 1u, 5u, 20u}) {
        for (const std::uint32_t count : awkward_counts) {
            Rays rays(kernels::round_up(count) + 16, Rays::InTrees{});
            for (std::uint32_t i = 0; i < count; ++i) {
                put_ray(*rays, i, {0, 0, 0}, {0, 0, 1}, no_sphere, {0.5, 0, 0.25});
                // Level i % 22 of the tree, its first node or its last.
                const std::uint32_t level = i % 22;
                rays->vertex[i] = i % 2 == 0 ? 1u << level : (2u << level) - 1;
            }
            Rays out = rays;
            stages.expire(depth, count, *out);
            EXPECT_TRUE(out.untouched_but(rays, 0, kernels::round_up(count)));
            for (std::uint32_t i = 0; i < count; ++i) {
                const bool alive = i % 22 < depth;
                ASSERT_EQ(throughput_of(*out, i), alive ? glm::dvec3(0.5, 0, 0.25) : glm::dvec3(0))
                    << "level " << i % 22;
                ASSERT_EQ(direction_of(*out, i), direction_of(*rays, i));
            }
        }
    }
}

TEST_P(WhittedTest, AMirrorTakesARayToItsFirstChild) {
    constexpr auto mirror = static_cast<std::size_t>(Scattering::specular);
    const World world({{glm::dvec3(0), 1}}, {Surface{Scattering::specular}});
    Rays rays(64, Rays::InTrees{}, {"pdf", "roulette_scale"});
    const Hits hits(64);
    const Slots slots(16);
    const Lobes no_lobes(0, {"lobe_x", "lobe_y", "lobe_z"});
    for (std::uint32_t i = 0; i < 64; ++i) {
        put_ray(*rays, i, {3, 0, 0}, {-1, 0, 0});
        rays->vertex[i] = i + 1, hits->id[i] = 0, hits->t[i] = 2;
    }
    stages.scatter[mirror]({world.spheres, world.materials, *slots, 0, 0, false}, {16, 17}, *rays, *hits, *no_lobes);
    for (std::uint32_t i = 16; i < 33; ++i) EXPECT_EQ(rays->vertex[i], 2 * (i + 1)) << i;
}

World glass_world() {
    const auto glass = Scattering::dielectric;
    return World({{glm::dvec3(0, 0, 0), 1, 0}, {glm::dvec3(3, -1, 2), 0.3, 1}, {glm::dvec3(-2, 4, 1), 2, 2}},
                 {{glass, {0.9, 0.5, 0.1}, {0.2, 0.6, 0.8}, 1.5},
                  {glass, {0, 0, 0}, {1.0, 0.9, 0.7}, 0.7},
                  {glass, {1.0, 1.0, 1.0}, {0, 0, 0}, 2.4}});
}

// Against Fresnel and Snell in double: what continues, what is put off, with which weights and under which node.
TEST_P(WhittedTest, BranchesAreFresnels) {
    constexpr std::uint32_t begin = 16, levels = 4;
    const World world = glass_world();
    std::vector<std::uint32_t> counts = awkward_counts;
    counts.push_back(2001);
    for (const std::uint32_t count : counts) {
        const std::uint32_t capacity = begin + kernels::padded_run(count) + 16;
        Rays rays(capacity, Rays::InTrees{}, {"pdf", "roulette_scale"});
        Hits hits(capacity);
        const Slots slots(16);
        Stack stack(std::max(count, 1u), levels);
        Numbers random(count);
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            const std::uint32_t k = random.below(3);
            const bool inside = i % 3 == 0;
            const glm::dvec3 c = world.centre(k);
            const glm::dvec3 o =
                c + random.direction() * world.radius(k) * (inside ? 0.95 * random.uniform() : random.scale(1.05, 10));
            // Some so weak that a branch of theirs falls under the cut; some dead.
            const double strength = i % 11 == 10 ? 0 : i % 4 == 1 ? random.scale(1e-6, 1e-2) : 1;
            put_ray(*rays, i, o, c + random.direction() * world.radius(k) * 0.98 * random.uniform() - o, no_sphere,
                    strength * random.colour());
            const std::uint32_t slot = begin + count - 1 - i;
            rays->slot[i] = slot;
            rays->vertex[i] = 1 + slot % 50;
            stack.view.height[slot] = slot % levels;  // what is pending already stays below
            const Roots at = roots(origin_of(*rays, i), direction_of(*rays, i), c, world.radius(k));
            hits->t[i] = narrow(inside ? at.far : at.near);
            hits->id[i] = i % 7 == 6 ? no_sphere : inside ? k | inside_bit : k;
        }
        Rays out = rays;
        Hits same_hits = hits;
        Stack out_stack = stack;
        const auto run = [&](const auto& table, const Rays& r, const Stack& st) {
            table.branch({world.spheres, world.materials, *slots, 0, 0, false}, {begin, count}, *r, *hits, st.view);
        };
        run(stages, out, out_stack);
        EXPECT_TRUE(out.untouched_but(rays, begin, begin + kernels::round_up(count)));
        EXPECT_TRUE(hits.same_as(same_hits, -Hits::guard, hits.capacity() + Hits::guard));
        if (exact()) {
            Rays same = rays;
            Stack same_stack = stack;
            run(scalar, same, same_stack);
            EXPECT_TRUE(out_stack.same_as(same_stack));
            for (std::uint32_t i = begin; i < begin + count; ++i)
                if (hits->id[i] != no_sphere) {
                    EXPECT_TRUE(out.same_as(same, i, i + 1));
                }
        }
        std::uint32_t unsure = 0;
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            const std::uint32_t slot = rays->slot[i], height = stack.view.height[slot];
            if (hits->id[i] == no_sphere) {
                ASSERT_EQ(throughput_of(*out, i), glm::dvec3(0));
                ASSERT_EQ(out_stack.view.height[slot], height);
                continue;
            }
            const std::uint32_t k = hits->id[i] & no_sphere, side = hits->id[i] & inside_bit;
            const glm::dvec3 p = origin_of(*out, i), d = direction_of(*rays, i);
            const glm::dvec3 n = (p - world.centre(k)) / world.radius(k) * (side != 0 ? -1.0 : 1.0);
            const double index = world.materials.eta[k], eta = side == 0 ? index : 1 / index;
            const double cosine = -glm::dot(d, n), f = fresnel(cosine, eta), t = transmitted_cosine(cosine, eta);
            const auto& m = world.materials;
            glm::dvec3 mirrored = throughput_of(*rays, i) * get3(m.rho_r, m.rho_g, m.rho_b, k) * f;
            glm::dvec3 through = throughput_of(*rays, i) * get3(m.tau_r, m.tau_g, m.tau_b, k) * (1 - f) / (eta * eta);
            const auto largest = [](const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); };
            const auto close = [&](double w) { return std::abs(w - 1e-5) < 1e-7; };
            if (t < 0.02 || close(largest(mirrored)) || close(largest(through))) {
                if (t > 0 || close(largest(mirrored))) {
                    ++unsure;
                    continue;
                }
            }
            if (largest(mirrored) < 1e-5) mirrored = glm::dvec3(0);
            if (largest(through) < 1e-5) through = glm::dvec3(0);
            const bool continues = largest(through) > 0, both = continues && largest(mirrored) > 0;
            const double slack = 2e-5 / std::max(t, 0.02);
            const auto near = [&](const glm::dvec3& got, const glm::dvec3& wanted) {
                return glm::length(got - wanted) <= slack * (1e-6 + glm::length(wanted));
            };
            ASSERT_TRUE(near(throughput_of(*out, i), continues ? through : mirrored)) << "ray " << i;
            if (throughput_of(*out, i) != glm::dvec3(0)) {
                ASSERT_LT(glm::length(direction_of(*out, i) - (continues ? refract(d, n, eta) : mirror(d, n))), slack);
                ASSERT_EQ(out->departed[i], k | (continues ? side ^ inside_bit : side));
                ASSERT_EQ(out->vertex[i], 2 * rays->vertex[i] + (continues ? 1 : 0));
            }
            ASSERT_EQ(out_stack.view.height[slot], height + (both ? 1 : 0));
            if (!both) continue;
            const std::size_t entry = std::size_t{height} * stack.view.slots + slot;
            const auto& put_off = out_stack.view.rays;
            ASSERT_EQ(origin_of(put_off, entry), p);
            ASSERT_LT(glm::length(direction_of(put_off, entry) - mirror(d, n)), slack);
            ASSERT_TRUE(near(throughput_of(put_off, entry), mirrored));
            ASSERT_EQ(put_off.departed[entry], k | side);
            ASSERT_EQ(put_off.slot[entry], slot);
            ASSERT_EQ(put_off.vertex[entry], 2 * rays->vertex[i]);
        }
        EXPECT_LE(unsure, 1 + count / 20);
    }
}

// The cut is for the weak: what is no number goes on, by either branch, to where the film counts it.
TEST_P(WhittedTest, NoNumberIsLostWhicheverChannelItIsIn) {
    const World world({{glm::dvec3(0), 1}}, {Surface{Scattering::dielectric, glm::dvec3(1), glm::dvec3(1), 1.5}});
    for (int channel = 0; channel < 3; ++channel)
        for (const double others : {0.0, 1e-9, 1.0}) {
            glm::dvec3 throughput(others);
            throughput[channel] = std::numeric_limits<double>::quiet_NaN();
            const Rays rays(48, Rays::InTrees{}, {"pdf", "roulette_scale"});
            const Hits hits(48);
            const Slots slots(16);
            const Stack stack(16, 2);
            put_ray(*rays, 0, {3, 0, 0}, {-1, 0, 0}, no_sphere, throughput);
            rays->slot[0] = 0;
            rays->vertex[0] = 1;
            hits->id[0] = 0;
            hits->t[0] = 2;
            stages.branch({world.spheres, world.materials, *slots, 0, 0, false}, {0, 1}, *rays, *hits, stack.view);
            EXPECT_TRUE(std::isnan(throughput_of(*rays, 0)[channel])) << "channel " << channel << ", " << others;
            ASSERT_EQ(stack.view.height[0], 1u) << "channel " << channel << ", " << others;
            EXPECT_TRUE(std::isnan(throughput_of(stack.view.rays, 0)[channel]));
        }
}

TEST_P(WhittedTest, ResumeTakesTheTopBranchOfEverySlotWithoutARay) {
    for (const std::uint32_t slot_count : {1u, 15u, 17u, 125u}) {
        constexpr std::uint32_t levels = 3;
        const std::uint32_t capacity = kernels::round_up(slot_count) + 16;
        Rays rays(capacity, Rays::InTrees{}, {"pdf", "roulette_scale"});
        Slots slots(slot_count);
        Stack stack(slot_count, levels);
        std::vector<std::uint32_t> live(slot_count, 0);
        std::uint32_t count = 0;
        for (std::uint32_t s = 0; s < slot_count; ++s) {
            slots->pixel[s] = 7 * s, slots->sample[s] = s % 3;
            stack.view.height[s] = s % (levels + 1);
            for (std::uint32_t level = 0; level < levels; ++level) {
                const std::uint32_t entry = level * slot_count + s;
                put3(stack.rays->ox, stack.rays->oy, stack.rays->oz, entry, glm::dvec3(level, s, 1));
                put3(stack.rays->dx, stack.rays->dy, stack.rays->dz, entry, glm::dvec3(0, 0, 1));
                put3(stack.rays->tr, stack.rays->tg, stack.rays->tb, entry, glm::dvec3(0.5, level, s));
                stack.rays->departed[entry] = level + 10;
                stack.rays->slot[entry] = s;
                stack.rays->vertex[entry] = 100 * level + s;
            }
            if (s % 3 == 0) {  // this slot's ray is still alive
                put_ray(*rays, count, {9, 9, 9}, {0, 0, 1});
                rays->slot[count++] = s;
            }
        }
        const Rays before = rays;
        const std::uint32_t size = stages.resume(*slots, stack.view, count, *rays, live.data());
        EXPECT_TRUE(rays.untouched_but(before, count, size));
        std::uint32_t at = count;
        for (std::uint32_t s = 0; s < slot_count; ++s) {
            EXPECT_EQ(live[s], 0u);
            const std::uint32_t height = s % (levels + 1);
            if (s % 3 == 0 || height == 0) {
                EXPECT_EQ(stack.view.height[s], height);
                continue;
            }
            ASSERT_LT(at, size);
            EXPECT_EQ(stack.view.height[s], height - 1);
            EXPECT_EQ(rays->vertex[at], 100 * (height - 1) + s);
            EXPECT_EQ(origin_of(*rays, at), glm::dvec3(height - 1, s, 1));
            EXPECT_EQ(throughput_of(*rays, at), glm::dvec3(0.5, height - 1, s));
            EXPECT_EQ(rays->departed[at], height - 1 + 10);
            EXPECT_EQ(rays->slot[at], s);
            EXPECT_EQ(rays->pixel[at], 7 * s);
            EXPECT_EQ(rays->sample[at], s % 3);
            ++at;
        }
        EXPECT_EQ(at, size);
    }
}

// All steps together in the real storage: a ray into a ball of glass. Inside, every meeting branches into the ray that
// leaves (odd) and the one that stays (even, put off); the walk goes deep first and comes back for the first mirror
// image last.
TEST_P(WhittedTest, ATreeIsWalkedDepthFirst) {
    constexpr std::uint32_t depth = 6, slot_count = 17;
    const World world({{glm::dvec3(0), 1}}, {{Scattering::dielectric, glm::dvec3(1), glm::dvec3(1), 2.4}});
    Needs needs;
    needs.integrator = Integrator::whitted;
    needs.scattering = 1u << static_cast<unsigned>(Scattering::dielectric);
    needs.branches = true;
    WaveStorage<float> storage(needs, depth, slot_count);
    Numbers random(1);
    std::uint32_t count = slot_count;
    for (std::uint32_t s = 0; s < slot_count; ++s) {
        const glm::dvec3 o = random.direction() * 4.0;
        put_ray(storage.rays, s, o, random.direction() * 0.9 - o);
        storage.rays.vertex[s] = 1, storage.slots.pixel[s] = s, storage.slots.sample[s] = 0;
    }
    std::vector<std::vector<std::uint32_t>> visited(slot_count);
    const kernels::ScatterContext<float> context{world.spheres, world.materials, storage.slots, 0, 0, false};
    for (int step = 0; count > 0; ++step) {
        ASSERT_LT(step, 100) << "the walk does not end";
        for (std::uint32_t i = 0; i < count; ++i) visited[storage.rays.slot[i]].push_back(storage.rays.vertex[i]);
        stages.intersect(world.spheres, storage.rays, count, storage.hits);
        stages.expire(depth, count, storage.rays);
        stages.branch(context, {0, count}, storage.rays, storage.hits, storage.branches);
        for (std::uint32_t s = 0; s < slot_count; ++s) ASSERT_LE(storage.branches.height[s], depth);
        kernels::Runs runs;
        runs.run[static_cast<std::size_t>(Scattering::dielectric)] = {0, count};
        count = stages.roulette(storage.slots, 0, 0, false, runs, storage.rays);
        count = stages.resume(storage.slots, storage.branches, count, storage.rays, storage.live);
    }
    const std::vector<std::uint32_t> wanted{1, 3, 7, 6, 13, 12, 25, 24, 49, 48, 97, 96, 2};
    for (const auto& nodes : visited) EXPECT_EQ(nodes, wanted);
}

INSTANTIATE_TEST_SUITE_P(Isas, WhittedTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
