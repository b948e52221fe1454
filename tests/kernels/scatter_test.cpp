// Stage `shade`, third step: what each way of scattering makes of a ray, against the formulas in double.
//
// Random directions are checked for what every single one must satisfy; how they are distributed is in
// scatter_sampling_test.cpp.
#include "geometry.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "optics_reference.hpp"
#include "owned.hpp"
#include "random_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;
using kernels::Scattering;

constexpr std::uint32_t seed = 11, bounce = 2, begin = 32;
constexpr float infinity = std::numeric_limits<float>::infinity();

struct Wave {
    Rays rays;
    Hits hits;
    Lobes lobes;
    std::uint32_t count;
};

class ScatterTest : public KernelTest {
protected:
    static World world_of(Scattering kind) {
        return World({{glm::dvec3(0, 0, 0), 1, 0}, {glm::dvec3(3, -1, 2), 0.3, 1}, {glm::dvec3(-2, 4, 1), 2, 2}},
                     {{kind, {0.9, 0.5, 0.1}, {0.2, 0.6, 0.8}, 1.5, 0.3},
                      {kind, {0.3, 0.2, 1.0}, {1.0, 0.9, 0.7}, 0.7, 0.05},
                      {kind, {1.0, 1.0, 1.0}, {0.5, 0.5, 0.5}, 2.4, 0.9}});
    }
    /// A run of `count` hits from outside and inside, every seventh a miss as in an unsorted queue, and another run's
    /// rays behind the padding.
    static Wave wave_of(const World& world, std::uint32_t count, const std::vector<std::string_view>& absent = {}) {
        const std::uint32_t capacity = begin + kernels::padded_run(count) + 32;
        Wave w{Rays(capacity, absent), Hits(capacity), Lobes(capacity), count};
        Numbers random(count);
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            const std::uint32_t k = random.below(3);
            const bool inside = i % 3 == 0;
            const glm::dvec3 c = world.centre(k);
            const glm::dvec3 o =
                c + random.direction() * world.radius(k) * (inside ? 0.95 * random.uniform() : random.scale(1.05, 10));
            put_ray(*w.rays, i, o, c + random.direction() * world.radius(k) * 0.98 * random.uniform() - o, no_sphere,
                    random.colour());
            const float roulette_scale = narrow(random.scale(0.5, 2));
            if (w.rays->roulette_scale != nullptr) w.rays->roulette_scale[i] = roulette_scale;
            w.rays->slot[i] = i - begin;
            const Roots at = roots(origin_of(*w.rays, i), direction_of(*w.rays, i), c, world.radius(k));
            w.hits->t[i] = i % 7 == 6 ? infinity : narrow(inside ? at.far : at.near);
            w.hits->id[i] = i % 7 == 6 ? no_sphere : inside ? k | inside_bit : k;
        }
        return w;
    }

    static kernels::ScatterContext<float> context_of(const World& world, const Slots& slots, bool competing) {
        return {world.spheres, world.materials, *slots, seed, bounce, competing};
    }

    /// Runs the stage, checks what it may touch and that all fused instruction sets agree.
    Wave scattered(Scattering kind, const World& world, const Wave& w, bool competing) const {
        const Slots slots(16);
        const auto context = context_of(world, slots, competing);
        const auto k = static_cast<std::size_t>(kind);
        Wave out = w;
        stages.scatter[k](context, {begin, w.count}, *out.rays, *out.hits, *out.lobes);
        const std::ptrdiff_t end = begin + kernels::round_up(w.count);
        EXPECT_TRUE(out.rays.untouched_but(w.rays, begin, end)) << "another run's rays";
        EXPECT_TRUE(out.lobes.untouched_but(w.lobes, begin, end)) << "another run's lobes";
        EXPECT_TRUE(out.hits.untouched_but(w.hits, 0, 0)) << "hits are only read";
        if (exact()) {
            Wave same = w;
            scalar.scatter[k](context, {begin, w.count}, *same.rays, *same.hits, *same.lobes);
            for (std::uint32_t i = begin; i < begin + w.count; ++i)
                if (w.hits->id[i] != no_sphere) {  // what a miss leaves behind has no
                                                   // throughput, and may be anything
                    EXPECT_TRUE(out.rays.same_as(same.rays, i, i + 1));
                    EXPECT_TRUE(out.lobes.same_as(same.lobes, i, i + 1));
                }
        }
        return out;
    }

    /// One ray before and after, with what the textbook says about the point between.
    struct Event {
        glm::dvec3 normal;  ///< on the side the ray arrived at
        double cosine;      ///< of the arriving ray
        glm::dvec3 arriving, leaving;
        glm::dvec3 factor;  ///< throughput after over before
        std::uint32_t sphere, side;
        std::uint32_t i;
        std::array<double, 4> random;
    };

    /// Checks what all ways of scattering share, then hands every hit to `check`.
    template <class Check>
    void for_every_hit(Scattering kind, bool competing, Check&& check,
                       const std::vector<std::string_view>& absent = {}) const {
        const World world = world_of(kind);
        std::vector<std::uint32_t> counts = awkward_counts;
        counts.push_back(3001);
        for (const std::uint32_t count : counts) {
            const Wave before = wave_of(world, count, absent);
            const Wave after = scattered(kind, world, before, competing);
            for (std::uint32_t i = begin; i < begin + count; ++i) {
                ASSERT_EQ(after.rays->slot[i], before.rays->slot[i]);
                ASSERT_EQ(after.rays->pixel[i], before.rays->pixel[i]);
                ASSERT_EQ(after.rays->sample[i], before.rays->sample[i]);
                if (before.hits->id[i] == no_sphere) {
                    ASSERT_EQ(throughput_of(*after.rays, i), glm::dvec3(0)) << "a miss leaves with nothing";
                    continue;
                }
                Event e;
                e.i = i;
                e.sphere = before.hits->id[i] & no_sphere;
                e.side = before.hits->id[i] & inside_bit;
                e.arriving = direction_of(*before.rays, i);
                e.leaving = direction_of(*after.rays, i);
                const glm::dvec3 p = origin_of(*after.rays, i), c = world.centre(e.sphere);
                const double r = world.radius(e.sphere);
                const glm::dvec3 met = origin_of(*before.rays, i) + static_cast<double>(before.hits->t[i]) * e.arriving;
                ASSERT_LT(glm::length(p - met), 3e-6 * (glm::length(p) + static_cast<double>(before.hits->t[i])));
                ASSERT_NEAR(glm::length(p - c), r, 1e-7 * (r + glm::length(p))) << "the new origin is on the sphere";
                e.normal = (p - c) / r * (e.side != 0 ? -1.0 : 1.0);
                e.cosine = -glm::dot(e.arriving, e.normal);
                e.factor = throughput_of(*after.rays, i) / throughput_of(*before.rays, i);
                e.random = random_reference(seed, 1, before.rays->pixel[i], before.rays->sample[i], bounce);
                ASSERT_NEAR(glm::length(e.leaving), 1, 4e-7);
                ASSERT_EQ(after.rays->departed[i] & no_sphere, e.sphere);
                const bool leaves_same_side = glm::dot(e.leaving, e.normal) > 0;
                if (std::abs(glm::dot(e.leaving, e.normal)) > 1e-5) {
                    ASSERT_EQ(after.rays->departed[i] & inside_bit, leaves_same_side ? e.side : e.side ^ inside_bit);
                }
                check(world, before, after, e);
            }
        }
    }

    static void expect_colour(const glm::dvec3& got, const glm::dvec3& wanted) {
        ASSERT_LT(glm::length(got - wanted), 2e-6 * (1 + glm::length(wanted)));
    }
    static glm::dvec3 rho_of(const World& world, std::uint32_t m) {
        return get3(world.materials.rho_r, world.materials.rho_g, world.materials.rho_b, m);
    }
    static glm::dvec3 tau_of(const World& world, std::uint32_t m) {
        return get3(world.materials.tau_r, world.materials.tau_g, world.materials.tau_b, m);
    }
};

TEST_P(ScatterTest, Diffuse) {
    for (const bool competing : {true, false})
        for_every_hit(Scattering::diffuse, competing,
                      [&](const World& world, const Wave& before, const Wave& after, const Event& e) {
                          expect_colour(e.factor, rho_of(world, e.sphere));
                          const double cosine = glm::dot(e.leaving, e.normal);
                          ASSERT_GT(cosine, -3e-6);
                          ASSERT_NEAR(after.rays->pdf[e.i], competing ? cosine / pi : 0, 2e-6);
                          ASSERT_EQ(after.rays->roulette_scale[e.i], before.rays->roulette_scale[e.i]);
                      });
}

TEST_P(ScatterTest, Specular) {
    for_every_hit(Scattering::specular, true,
                  [&](const World& world, const Wave& before, const Wave& after, const Event& e) {
                      expect_colour(e.factor, rho_of(world, e.sphere));
                      ASSERT_LT(glm::length(e.leaving - mirror(e.arriving, e.normal)), 6e-6);
                      ASSERT_EQ(after.rays->pdf[e.i], infinity);
                      ASSERT_EQ(after.rays->roulette_scale[e.i], before.rays->roulette_scale[e.i]);
                  });
}

/// The lobe that the random number picks: direction, weight without eta scaling, scaling, and the cosine it leaves at.
struct Branch {
    glm::dvec3 direction, weight;
    double scale, cosine;
    bool reflected, open;
};
Branch branch_at(const glm::dvec3& arriving, const glm::dvec3& n, double eta, double u, const glm::dvec3& rho,
                 const glm::dvec3& tau) {
    const double cosine = -glm::dot(arriving, n), f = fresnel(cosine, eta), t = transmitted_cosine(cosine, eta);
    const bool open = std::abs(u - f) < 1e-5 / std::max(t, 1e-2);
    if (u < f) return {mirror(arriving, n), rho, 1, cosine, true, open};
    return {refract(arriving, n, eta), tau, 1 / (eta * eta), t, false, open};
}

TEST_P(ScatterTest, Dielectric) {
    std::uint32_t open = 0, reflected = 0, transmitted = 0;
    for_every_hit(
        Scattering::dielectric, true, [&](const World& world, const Wave& before, const Wave& after, const Event& e) {
            const double index = world.materials.eta[e.sphere];
            const Branch b = branch_at(e.arriving, e.normal, e.side == 0 ? index : 1 / index, e.random[2],
                                       rho_of(world, e.sphere), tau_of(world, e.sphere));
            if (b.open) return void(++open);
            ++(b.reflected ? reflected : transmitted);
            expect_colour(e.factor, b.weight * b.scale);
            ASSERT_LT(glm::length(e.leaving - b.direction), 1e-5 / std::max(b.cosine, 0.01));
            ASSERT_EQ(after.rays->pdf[e.i], infinity);
            const double scale = static_cast<double>(after.rays->roulette_scale[e.i]);
            ASSERT_NEAR(scale / static_cast<double>(before.rays->roulette_scale[e.i]), b.scale, 1e-6 * b.scale);
        });
    EXPECT_LT(open, 20u);
    EXPECT_GT(reflected, 100u);
    EXPECT_GT(transmitted, 500u);
}

/// What holds for every direction drawn from a glossy lobe.
void expect_in_lobe(const glm::dvec3& lobe, const glm::dvec3& n, double beta, const glm::dvec3& leaving, double pdf) {
    ASSERT_LT(sine_between(lobe, leaving), beta + 1e-5);
    ASSERT_GT(glm::dot(leaving, n), -1e-5);
    const double slack = 20 * glossy_slack(lobe, beta, leaving);
    if (slack > 0.1 || glm::dot(leaving, n) < 1e-5) return;
    const double wanted = glossy_density(lobe, n, beta, leaving);
    ASSERT_NEAR(pdf, wanted, slack * wanted);
}

TEST_P(ScatterTest, Glossy) {
    for (const bool competing : {true, false})
        for_every_hit(Scattering::glossy, competing,
                      [&](const World& world, const Wave& before, const Wave& after, const Event& e) {
                          expect_colour(e.factor, rho_of(world, e.sphere));
                          const glm::dvec3 lobe = get3(after.lobes->x, after.lobes->y, after.lobes->z, e.i);
                          ASSERT_LT(glm::length(lobe - mirror(e.arriving, e.normal)), 6e-6);
                          const double pdf = static_cast<double>(after.rays->pdf[e.i]);
                          if (!competing) {
                              ASSERT_EQ(after.rays->pdf[e.i], infinity);
                          }
                          const double beta = world.materials.roughness[e.sphere];
                          expect_in_lobe(lobe, e.normal, beta, e.leaving,
                                         competing ? pdf : glossy_density(lobe, e.normal, beta, e.leaving));
                          ASSERT_EQ(after.rays->roulette_scale[e.i], before.rays->roulette_scale[e.i]);
                      });
}

TEST_P(ScatterTest, Translucent) {
    std::uint32_t open = 0, reflected = 0, transmitted = 0;
    for_every_hit(
        Scattering::translucent, true, [&](const World& world, const Wave& before, const Wave& after, const Event& e) {
            const double index = world.materials.eta[e.sphere];
            const Branch b = branch_at(e.arriving, e.normal, e.side == 0 ? index : 1 / index, e.random[2],
                                       rho_of(world, e.sphere), tau_of(world, e.sphere));
            if (b.open) return void(++open);
            ++(b.reflected ? reflected : transmitted);
            expect_colour(e.factor, b.weight * b.scale);
            const glm::dvec3 lobe = get3(after.lobes->x, after.lobes->y, after.lobes->z, e.i);
            ASSERT_LT(glm::length(lobe - b.direction), 1e-5 / std::max(b.cosine, 0.01));
            if (b.cosine > 0.01)  // beyond that the side's probability hangs on the
                                  // lobe's last digits
                expect_in_lobe(lobe, b.reflected ? e.normal : -e.normal, world.materials.roughness[e.sphere], e.leaving,
                               static_cast<double>(after.rays->pdf[e.i]));
            const double scale = static_cast<double>(after.rays->roulette_scale[e.i]);
            ASSERT_NEAR(scale / static_cast<double>(before.rays->roulette_scale[e.i]), b.scale, 1e-6 * b.scale);
        });
    EXPECT_LT(open, 20u);
    EXPECT_GT(reflected, 100u);
    EXPECT_GT(transmitted, 500u);
}

TEST_P(ScatterTest, FieldsThePlanLeavesOutMayBeMissing) {
    for (std::uint32_t kind = 0; kind < kernels::scattering_count; ++kind) {
        const World world = world_of(static_cast<Scattering>(kind));
        const Slots slots(16);
        const Wave full = wave_of(world, 125), lean = wave_of(world, 125, {"pdf", "roulette_scale"});
        const Lobes no_lobes(0, {"lobe_x", "lobe_y", "lobe_z"});
        stages.scatter[kind](context_of(world, slots, true), {begin, 125}, *full.rays, *full.hits, *full.lobes);
        stages.scatter[kind](context_of(world, slots, true), {begin, 125}, *lean.rays, *lean.hits, *no_lobes);
        for (std::uint32_t i = begin; i < begin + 125; ++i) {
            if (full.hits->id[i] == no_sphere) continue;
            ASSERT_EQ(direction_of(*lean.rays, i), direction_of(*full.rays, i));
            ASSERT_EQ(throughput_of(*lean.rays, i), throughput_of(*full.rays, i));
        }
    }
}

TEST_P(ScatterTest, ARunOfMissesLeavesNothing) {
    for (std::uint32_t kind = 0; kind < kernels::scattering_count; ++kind) {
        const World world = world_of(static_cast<Scattering>(kind));
        Wave w = wave_of(world, 125);
        for (std::uint32_t i = begin; i < begin + 125; ++i) w.hits->id[i] = no_sphere, w.hits->t[i] = infinity;
        const Wave after = scattered(static_cast<Scattering>(kind), world, w, true);
        for (std::uint32_t i = begin; i < begin + 125; ++i) ASSERT_EQ(throughput_of(*after.rays, i), glm::dvec3(0));
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, ScatterTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
