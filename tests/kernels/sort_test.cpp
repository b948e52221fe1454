// Stage `shade`, second step: a stable counting sort by way of scattering.
#include <algorithm>

#include "kernel_test.hpp"
#include "numbers.hpp"
#include "owned.hpp"
#include "wavefront/wave_storage.hpp"
#include "world.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;
using kernels::Runs;
using kernels::Scattering;
using kernels::scattering_count;

constexpr std::uint32_t all_kinds = (1u << scattering_count) - 1;
constexpr std::uint32_t absent = scattering_count;  // of a ray that met nothing, or is dead

class SortTest : public KernelTest {
protected:
    /// Sphere k scatters in way k % 5; three of each, so that the table is longer than a short vector.
    static World world_of_kinds() {
        std::vector<Ball> balls;
        std::vector<Surface> surfaces;
        for (std::uint32_t k = 0; k < 3 * scattering_count; ++k) {
            balls.push_back({glm::dvec3(k, 0, 0), 0.4, k, k % 2 == 0 ? 0 : -1});
            surfaces.push_back({static_cast<Scattering>(k % scattering_count)});
        }
        return World(balls, surfaces, {{1, 1, 1}});
    }

    struct Wave {
        Rays rays;
        Hits hits;
        std::vector<std::uint32_t> kind;
    };
    /// One ray per entry of `kinds`; misses and dead rays alternate where it says absent.
    static Wave wave_of(const std::vector<std::uint32_t>& kinds, bool all_fields = true) {
        const auto count = static_cast<std::uint32_t>(kinds.size());
        const std::uint32_t capacity = kernels::ray_capacity(count);
        Wave w{all_fields ? Rays(capacity) : Rays(capacity, {"pdf", "roulette_scale"}), Hits(capacity), kinds};
        Numbers random(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            put_ray(*w.rays, i, random.point(9), random.direction(), random.below(9), random.colour());
            if (i % 3 == 0) w.rays->tg[i] = w.rays->tb[i] = 0;  // one channel is enough to live
            if (all_fields)
                w.rays->pdf[i] = narrow(random.uniform()), w.rays->roulette_scale[i] = narrow(random.uniform());
            const bool dead = kinds[i] == absent && i % 2 == 0;
            const std::uint32_t kind = kinds[i] == absent ? random.below(scattering_count) : kinds[i];
            w.hits->id[i] = (kind + scattering_count * random.below(3)) | (i % 4 == 1 ? inside_bit : 0);
            w.hits->t[i] = narrow(random.uniform());
            if (dead) put3(w.rays->tr, w.rays->tg, w.rays->tb, i, glm::dvec3(0));
            if (kinds[i] == absent && !dead) w.hits->id[i] = no_sphere;
        }
        return w;
    }
    static std::vector<std::uint32_t> random_kinds(std::uint32_t count, std::uint64_t seed) {
        Numbers random(seed);
        std::vector<std::uint32_t> kinds(count);
        for (std::uint32_t& kind : kinds) kind = random.below(scattering_count + 1);
        return kinds;
    }

    /// What was left where it stood is a run of its only kind.
    static void expect_is_one_run(const Wave& w, std::uint32_t known, const Runs& runs) {
        const auto count = static_cast<std::uint32_t>(w.kind.size());
        for (std::uint32_t k = 0; k < scattering_count; ++k) {
            const auto wanted = static_cast<std::uint32_t>(std::ranges::count(w.kind, k));
            if (wanted == 0 || (known >> k & 1u) == 0) {
                EXPECT_EQ(runs.run[k].count, 0u) << "kind " << k;
            } else {
                EXPECT_EQ(runs.run[k].begin, 0u);
                EXPECT_EQ(runs.run[k].count, count);
                EXPECT_GE(wanted, count - count / 8);
            }
        }
    }

    void expect_sorts(const Wave& w, std::uint32_t known = all_kinds, bool all_fields = true) const {
        const World world = world_of_kinds();
        const auto count = static_cast<std::uint32_t>(w.kind.size());
        const std::uint32_t capacity = kernels::ray_capacity(count);
        Rays sorted = all_fields ? Rays(capacity) : Rays(capacity, {"pdf", "roulette_scale"});
        Hits sorted_hits(capacity);
        const Rays before = sorted;
        const Hits hits_before = sorted_hits;
        const Runs runs =
            stages.sort_by_scattering(world.spheres, known, *w.rays, *w.hits, count, *sorted, *sorted_hits);
        if (!runs.moved) {
            EXPECT_TRUE(sorted.same_as(before, 0, capacity));
            return expect_is_one_run(w, known, runs);
        }
        EXPECT_TRUE(sorted.untouched_but(before, 0, capacity)) << "behind the queue's capacity";
        EXPECT_TRUE(sorted_hits.untouched_but(hits_before, 0, capacity)) << "behind the queue's capacity";
        std::uint32_t end = 0;
        for (std::uint32_t k = 0; k < scattering_count; ++k) {
            std::vector<std::uint32_t> wanted;
            for (std::uint32_t i = 0; i < count; ++i)
                if (w.kind[i] == k && (known >> k & 1u) != 0) wanted.push_back(i);
            ASSERT_EQ(runs.run[k].count, wanted.size()) << "kind " << k;
            ASSERT_EQ(runs.run[k].begin % kernels::widest, 0u);
            ASSERT_GE(runs.run[k].begin, end);
            end = runs.run[k].begin + runs.run[k].count;
            ASSERT_LE(end, capacity) << "the run leaves the queue";
            for (std::uint32_t j = 0; j < wanted.size(); ++j) {
                const std::uint32_t at = runs.run[k].begin + j;
                kernels::RayQueue<float>::each_field([&](const char* name, auto field) {
                    if ((*sorted).*field == nullptr) return;
                    ASSERT_EQ(((*sorted).*field)[at], ((*w.rays).*field)[wanted[j]]) << name << " of kind " << k;
                });
                ASSERT_EQ(sorted_hits->id[at], w.hits->id[wanted[j]]);
                ASSERT_EQ(sorted_hits->t[at], w.hits->t[wanted[j]]);
            }
        }
    }
};

// Misses are dragged along while they are few. A dead ray never is: it may have hit what the run's kernel cannot read.
TEST_P(SortTest, AQueueOfOneKindStaysWhereItIs) {
    const World world = world_of_kinds();
    const auto moves = [&](const std::vector<std::uint32_t>& kinds, bool dead) {
        const Wave w = wave_of(kinds);
        const auto count = static_cast<std::uint32_t>(kinds.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            if (kinds[i] != absent) continue;
            put3(w.rays->tr, w.rays->tg, w.rays->tb, i, glm::dvec3(dead ? 0 : 1));
            w.hits->id[i] = dead ? 0 : no_sphere;
        }
        Rays sorted(kernels::ray_capacity(count));
        Hits sorted_hits(kernels::ray_capacity(count));
        return stages.sort_by_scattering(world.spheres, all_kinds, *w.rays, *w.hits, count, *sorted, *sorted_hits)
            .moved;
    };
    std::vector<std::uint32_t> kinds(800, 2);
    EXPECT_FALSE(moves(kinds, false));
    for (int i = 0; i < 100; ++i) kinds[static_cast<std::size_t>(8 * i + 3)] = absent;
    EXPECT_FALSE(moves(kinds, false)) << "an eighth are misses";
    EXPECT_TRUE(moves(kinds, true)) << "they are dead";
    kinds[0] = absent;
    EXPECT_TRUE(moves(kinds, false)) << "more than an eighth";
    kinds.assign(800, 2);
    kinds[799] = absent;
    EXPECT_TRUE(moves(kinds, true)) << "a single dead ray";
    kinds[799] = 3;
    EXPECT_TRUE(moves(kinds, false)) << "a second kind";
    EXPECT_FALSE(moves(std::vector<std::uint32_t>(60, absent), false)) << "nothing met anything";
}

// A throughput that is no number must reach the film, which counts and drops it: it is as alive as any other.
TEST_P(SortTest, NoNumberIsLostWhicheverChannelItIsIn) {
    const World world = world_of_kinds();
    for (const std::uint32_t kinds : {1u, 2u, 5u})
        for (int channel = 0; channel < 3; ++channel)
            for (const double others : {0.0, 0.5}) {
                constexpr std::uint32_t count = 125;
                std::vector<std::uint32_t> kind(count);
                for (std::uint32_t i = 0; i < count; ++i) kind[i] = i % kinds;
                const Wave w = wave_of(kind);
                glm::dvec3 throughput(others);
                throughput[channel] = std::numeric_limits<double>::quiet_NaN();
                for (std::uint32_t i = 0; i < count; ++i) put3(w.rays->tr, w.rays->tg, w.rays->tb, i, throughput);
                Rays sorted(kernels::ray_capacity(count));
                Hits sorted_hits(kernels::ray_capacity(count));
                const Runs runs =
                    stages.sort_by_scattering(world.spheres, all_kinds, *w.rays, *w.hits, count, *sorted, *sorted_hits);
                EXPECT_EQ(runs.moved, kinds > 1);
                std::uint32_t alive = 0;
                for (const kernels::Range& run : runs.run) alive += run.count;
                EXPECT_EQ(alive, count) << "channel " << channel << ", others " << others << ", " << kinds << " kinds";
            }
}

TEST_P(SortTest, StableByKind) {
    for (const std::uint32_t count : awkward_counts)
        for (std::uint64_t seed = 0; seed < 20; ++seed) expect_sorts(wave_of(random_kinds(count, seed)));
    expect_sorts(wave_of(random_kinds(4001, 1)));
}

TEST_P(SortTest, AbsentFieldsStayAbsent) { expect_sorts(wave_of(random_kinds(125, 3), false), all_kinds, false); }

TEST_P(SortTest, OnlyKindsThePlanKnowsAreLookedFor) {
    for (std::uint32_t known = 0; known <= all_kinds; ++known) expect_sorts(wave_of(random_kinds(61, known)), known);
}

TEST_P(SortTest, OneKindOnlyAndNoneAtAll) {
    for (std::uint32_t kind = 0; kind <= absent; ++kind)
        for (const std::uint32_t count : awkward_counts) expect_sorts(wave_of(std::vector<std::uint32_t>(count, kind)));
}

// Runs are padded to whole vectors: the queue must hold every way of cutting it, those that waste most included.
TEST_P(SortTest, CapacityHoldsEverySplit) {
    for (std::uint32_t each = 1; each <= 2 * kernels::widest; ++each) {
        std::vector<std::uint32_t> kinds;
        for (std::uint32_t k = 0; k < scattering_count; ++k) kinds.insert(kinds.end(), each, k);
        expect_sorts(wave_of(kinds));
    }
}

// The real storage, one field behind the other: a record that leaves its field lands in the next one's.
TEST_P(SortTest, CapacityOfWaveStorageHoldsEverySplit) {
    const World world = world_of_kinds();
    Needs needs;
    needs.scattering = all_kinds;
    needs.sort = needs.scattering_pdf = needs.roulette_scale = true;
    for (std::uint32_t each = 1; each <= 2 * kernels::widest; ++each) {
        // All of the last kind but one come first, so that the last record is written alone and its vector reaches
        // furthest.
        std::vector<std::uint32_t> kinds(each - 1, scattering_count - 1);
        for (std::uint32_t k = 0; k + 1 < scattering_count; ++k) kinds.insert(kinds.end(), each, k);
        kinds.push_back(scattering_count - 1);
        const Wave w = wave_of(kinds);
        const auto count = static_cast<std::uint32_t>(kinds.size());
        const WaveStorage<float> storage(needs, 5, count);
        const Runs runs = stages.sort_by_scattering(world.spheres, all_kinds, *w.rays, *w.hits, count,
                                                    storage.sorted_rays, storage.sorted_hits);
        std::uint32_t seen[scattering_count] = {};
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t at = runs.run[kinds[i]].begin + seen[kinds[i]]++;
            kernels::RayQueue<float>::each_field([&](const char* name, auto field) {
                if (storage.sorted_rays.*field == nullptr) return;
                ASSERT_EQ((storage.sorted_rays.*field)[at], ((*w.rays).*field)[i])
                    << name << " of ray " << i << ", " << each << " rays of each kind";
            });
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, SortTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
