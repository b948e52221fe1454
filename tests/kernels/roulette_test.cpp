// Stage `roulette`: who survives, with which throughput, in which order, and that expectation does not change.
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "owned.hpp"
#include "random_reference.hpp"
#include "statistics/distributions.hpp"
#include "statistics/moments.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::Runs;
using kernels::scattering_count;

constexpr std::uint32_t seed = 5, bounce = 3;

class RouletteTest : public KernelTest {
protected:
    /// Runs of the given lengths, each on a whole vector; returns rays with every field its own number.
    struct Queue {
        Rays rays;
        Runs runs;
        std::uint32_t end = 0;
    };
    static Queue queue_of(const std::vector<std::uint32_t>& lengths, std::uint64_t random_seed = 1,
                          const std::vector<std::string_view>& absent = {}) {
        std::uint32_t capacity = kernels::widest;
        for (const std::uint32_t length : lengths) capacity += kernels::padded_run(length);
        Queue q{Rays(capacity, absent), {}, 0};
        Numbers random(random_seed);
        std::uint32_t begin = 0;
        for (std::size_t k = 0; k < lengths.size(); ++k) {
            q.runs.run[k] = {begin, lengths[k]};
            for (std::uint32_t i = begin; i < begin + lengths[k]; ++i) {
                put_ray(*q.rays, i, random.point(9), random.direction(), random.below(99), random.colour() * 1.4);
                if (q.rays->pdf != nullptr) q.rays->pdf[i] = narrow(random.uniform());
                if (q.rays->roulette_scale != nullptr) q.rays->roulette_scale[i] = narrow(random.scale(0.4, 2.5));
                q.rays->slot[i] = i / 2;
                q.rays->pixel[i] = random.below(1000);
                if (random.uniform() < 0.2) put3(q.rays->tr, q.rays->tg, q.rays->tb, i, glm::dvec3(0));
            }
            q.end = begin + lengths[k];
            begin += kernels::padded_run(lengths[k]);
        }
        return q;
    }

    void expect_agrees(const Queue& q, bool play) const {
        Slots slots(kernels::round_up(q.end) + 16);
        const Slots slots_before = slots;
        Rays rays = q.rays;
        const std::uint32_t size = stages.roulette(*slots, seed, bounce, play, q.runs, *rays);
        EXPECT_TRUE(slots.same_as(slots_before, -Slots::guard, slots.capacity() + Slots::guard));
        EXPECT_TRUE(rays.untouched_but(q.rays, 0, kernels::round_up(q.end))) << "behind the last run";
        std::uint32_t at = 0;
        for (const kernels::Range& run : q.runs.run) {
            for (std::uint32_t i = run.begin; i < run.begin + run.count; ++i) {
                const glm::dvec3 throughput = throughput_of(*q.rays, i);
                const double carried = std::max({throughput.x, throughput.y, throughput.z});
                const double scale =
                    q.rays->roulette_scale != nullptr ? static_cast<double>(q.rays->roulette_scale[i]) : 1.0;
                const double survival = play ? std::min(1.0, carried / scale) : 1.0;
                const double u = random_reference(seed, 2, q.rays->pixel[i], q.rays->sample[i], bounce)[0];
                ASSERT_GT(std::abs(u - survival), 1e-7) << "too close to call: choose another seed";
                if (carried == 0 || u >= survival) continue;
                ASSERT_LT(at, size);
                ASSERT_LT(glm::length(throughput_of(*rays, at) - throughput / survival), 1e-6);
                kernels::RayQueue<float>::each_field([&](const char* name, auto field) {
                    if (name[0] == 't' || (*rays).*field == nullptr) return;
                    ASSERT_EQ(((*rays).*field)[at], ((*q.rays).*field)[i]) << name << " of ray " << i;
                });
                ++at;
            }
        }
        EXPECT_EQ(at, size);
        if (!exact()) return;
        Rays same = q.rays;
        EXPECT_EQ(scalar.roulette(*slots, seed, bounce, play, q.runs, *same), size);
        EXPECT_TRUE(rays.same_as(same, 0, size));
    }
};

TEST_P(RouletteTest, SurvivorsMoveToTheFrontInOrder) {
    for (const bool play : {true, false}) {
        for (const std::uint32_t count : awkward_counts) {
            expect_agrees(queue_of({count}), play);
            expect_agrees(queue_of({0, 0, count}), play);
            expect_agrees(queue_of({count, 3, 0, 17, count}), play);
        }
        expect_agrees(queue_of({1, 2, 3, 4, 5}, 9), play);
        expect_agrees(queue_of({1000, 500, 17, 31, 999}, 3), play);
        expect_agrees(queue_of({125, 17}, 4, {"pdf", "roulette_scale"}), play);
    }
}

TEST_P(RouletteTest, WithoutPlayTheLivingAreUnchanged) {
    Queue q = queue_of({125});
    for (std::uint32_t i = 0; i < 125; ++i) q.rays->tr[i] = 0.01f;
    const Rays before = q.rays;
    Slots slots(128);
    EXPECT_EQ(stages.roulette(*slots, seed, bounce, false, q.runs, *q.rays), 125u);
    EXPECT_TRUE(q.rays.same_as(before, 0, 125));
}

TEST_P(RouletteTest, AllDeadAndAllCertain) {
    Queue dead = queue_of({125, 0, 40});
    for (std::uint32_t i = 0; i < dead.end; ++i) put3(dead.rays->tr, dead.rays->tg, dead.rays->tb, i, glm::dvec3(0));
    Queue certain = queue_of({125, 0, 40}, 2, {"roulette_scale"});
    for (std::uint32_t i = 0; i < certain.end; ++i) certain.rays->tg[i] = 1;
    const Slots slots(208);
    for (const bool play : {true, false}) {
        Rays rays = dead.rays, living = certain.rays;
        EXPECT_EQ(stages.roulette(*slots, seed, bounce, play, dead.runs, *rays), 0u);
        EXPECT_EQ(stages.roulette(*slots, seed, bounce, play, certain.runs, *living), 165u);
    }
}

// Whitted's rays are keyed by the node of their tree instead of the bounce.
TEST_P(RouletteTest, NodesTakeThePlaceOfTheBounce) {
    const Queue paths = queue_of({200});
    Queue q{Rays(static_cast<std::size_t>(paths.rays.capacity()), Rays::InTrees{}), paths.runs, paths.end};
    const Slots slots(208);
    for (std::uint32_t i = 0; i < 200; ++i) {
        kernels::RayQueue<float>::each_field([&](const char*, auto field) {
            if ((*paths.rays).*field != nullptr) ((*q.rays).*field)[i] = ((*paths.rays).*field)[i];
        });
        q.rays->vertex[i] = 1000 + i;
        put3(q.rays->tr, q.rays->tg, q.rays->tb, i, glm::dvec3(0.5));
        q.rays->roulette_scale[i] = 1;
    }
    const Rays before = q.rays;
    const std::uint32_t size = stages.roulette(*slots, seed, bounce, true, q.runs, *q.rays);
    std::uint32_t at = 0;
    for (std::uint32_t i = 0; i < 200; ++i)
        if (random_reference(seed, 2, before->pixel[i], before->sample[i], 1000 + i)[0] < 0.5) {
            ASSERT_EQ(q.rays->ox[at], before->ox[i]);
            ++at;
        }
    EXPECT_EQ(at, size);
}

// A throughput that is no number must reach the film, which counts and drops it: never be killed in silence.
TEST_P(RouletteTest, NoNumberIsLostWhicheverChannelItIsIn) {
    const Slots slots(16);
    for (const bool play : {false, true}) {
        for (int channel = 0; channel < 3; ++channel) {
            for (const double others : {0.0, 0.01}) {
                Queue q = queue_of({1}, 1, {"roulette_scale"});
                glm::dvec3 throughput(others);
                throughput[channel] = std::numeric_limits<double>::quiet_NaN();
                put3(q.rays->tr, q.rays->tg, q.rays->tb, 0, throughput);
                EXPECT_EQ(stages.roulette(*slots, seed, bounce, play, q.runs, *q.rays), 1u)
                    << "channel " << channel << ", others " << others << (play ? ", playing" : "");
            }
        }
    }
}

TEST_P(RouletteTest, ExpectationIsUnchanged) {
    constexpr std::uint32_t count = 1u << 17;
    Queue q = queue_of({count}, 1, {"roulette_scale"});
    const Rays before = q.rays;
    const Slots slots(16);
    const std::uint32_t size = stages.roulette(*slots, seed, bounce, true, q.runs, *q.rays);
    // Each ray's contribution less what it carried before: mean zero.
    statistics::RunningMoments difference;
    std::uint32_t at = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool survived = at < size && q.rays->ox[at] == before->ox[i] && q.rays->oy[at] == before->oy[i];
        difference.add((survived ? static_cast<double>(q.rays->tg[at]) : 0.0) - static_cast<double>(before->tg[i]));
        at += survived ? 1 : 0;
    }
    ASSERT_EQ(at, size);
    EXPECT_LT(std::abs(difference.mean()) / std::sqrt(difference.variance_of_mean()),
              statistics::family_threshold(1e-4, 100));
}

INSTANTIATE_TEST_SUITE_P(Isas, RouletteTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
