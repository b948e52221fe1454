// Stage `shade`, last step, where a vertex samples one of several lights: which one it is, and that it is sampled as
// if there were no other, over the probability of the choice.
#include <map>

#include "kernel_test.hpp"
#include "kernels/random.hpp"
#include "light_reference.hpp"
#include "lit_vertices.hpp"
#include "optics_reference.hpp"
#include "random_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::LightStrategy;
using kernels::no_sphere;
using kernels::Response;

constexpr std::uint32_t begin = LitVertices::begin, seed = 21, bounce = 4;

/// Five lights in eight cells: two points and three balls, the last ball around everything.
struct Choice {
    struct Cell {
        double share;
        std::uint32_t other;
    };
    static constexpr std::uint32_t cell_count = 8, light_count = 5;
    /// A share of none of a cell, of all of it, and of all but the last place.
    static constexpr Cell cells[cell_count] = {{0.5, 3},  {1, 1}, {0x1p-24, 4}, {1 - 0x1p-24, 0},
                                               {0.25, 2}, {0, 4}, {0, 0},       {0, 3}};

    Choice(const World& world, bool points_only) {
        std::array<double, light_count> probability{};
        for (std::uint32_t c = 0; c < cell_count; ++c) {
            const Cell cell = points_only ? Cell{c < 2 ? 0.375 : 0, (c + 1) % 2} : cells[c];
            share.push_back(narrow(cell.share)), other.push_back(cell.other);
            if (c < light_count) probability[c] += cell.share / cell_count;
            probability[cell.other] += (1 - cell.share) / cell_count;
        }
        for (const double p : probability) chances.push_back(narrow(p)), inverse_chances.push_back(narrow(1 / p));
        for (auto* column : {&share, &chances, &inverse_chances}) column->resize(column->size() + kernels::widest, NAN);
        other.resize(other.size() + kernels::widest, canary);
        table = world.lights;
        table.cells = cell_count, table.share = share.data(), table.other = other.data();
        table.probability = chances.data(), table.inverse_probability = inverse_chances.data();
    }
    Choice(const Choice&) = delete;
    Choice& operator=(const Choice&) = delete;

    std::vector<float> share, chances, inverse_chances;
    std::vector<std::uint32_t> other;
    kernels::LightTable<float> table;
};

class ConnectChosenTest : public KernelTest {
protected:
    /// Three balls to stand on, three that shine, one of them around all, and a ball within the first.
    const World world{{{glm::dvec3(0, 0, 0), 1, 0},
                       {glm::dvec3(3, -1, 2), 0.3, 1},
                       {glm::dvec3(-2, 4, 1), 2, 2},
                       {glm::dvec3(4, 4, -3), 1.5, 0, 0},
                       {glm::dvec3(4.2, 4, -3), 0.25, 1},
                       {glm::dvec3(-3, -2, -1), 0.5, 1, 1},
                       {glm::dvec3(0, 0, 0), 30, 0, 2}},
                      {{.beta = 0.3}, {.beta = 0.5}, {.beta = 0.9}},
                      {{5, 6, 7}, {50, 20, 10}, {0.1, 0.2, 0.3}},
                      {{{2, -3, 4}, {10, 20, 30}}, {{-1, 2, -5}, {3, 2, 1}}}};

    LitVertices wave_of(std::uint32_t count) const {
        const glm::dvec3 lights[] = {{2, -3, 4}, {-1, 2, -5}, world.centre(3), world.centre(5)};
        return lit_vertices(world, lights, count, 6);
    }
    kernels::ConnectContext<float> context(const Slots& slots, const kernels::LightTable<float>& lights,
                                           LightStrategy strategy, bool competing) const {
        return {world.spheres, world.materials, lights, *slots, seed, bounce, strategy, competing};
    }

    static std::uint32_t chosen_by(const Choice& choice, const LitVertices& w, std::uint32_t i) {
        const auto u = random_reference(seed, static_cast<std::uint32_t>(kernels::Dimension::light), w.rays->pixel[i],
                                        w.rays->sample[i], bounce);
        const auto cell = static_cast<std::uint32_t>(std::floor(u[2] * Choice::cell_count));
        return u[3] < static_cast<double>(choice.share[cell]) ? cell : choice.other[cell];
    }

    /// What every vertex gets of one light of the table alone, by slot, without competition. A light draws the numbers
    /// of its own place among those with an area, a chosen one the first: so it is made the first.
    std::map<std::uint32_t, std::uint32_t> alone(const Choice& choice, std::uint32_t light, std::size_t response,
                                                 LightStrategy strategy, const LitVertices& w, const Slots& slots,
                                                 const Shadows& queue) const {
        kernels::LightTable<float> lights = choice.table;
        if (light >= lights.points) lights.points = light;
        const std::uint32_t size = stages.connect[response](context(slots, lights, strategy, false), light,
                                                            {begin, w.count}, *w.rays, *w.lobes, *queue);
        std::map<std::uint32_t, std::uint32_t> entry;
        for (std::uint32_t at = 0; at < size; ++at) entry[queue->slot[at]] = at;
        return entry;
    }

    void expect_agrees(const Choice& choice, Response response, LightStrategy strategy, bool competing,
                       std::uint32_t count, bool with_targets = true) const {
        const auto r = static_cast<std::size_t>(response);
        const Slots slots(16);
        const LitVertices w = wave_of(count), same = w;
        const std::uint32_t capacity = kernels::round_up(count) + kernels::widest;
        const Shadows before = with_targets ? Shadows(capacity, Shadows::WithTargets{}) : Shadows(capacity);
        Shadows queue = before;
        const auto connect = [&](const kernels::Stages<float>& table, const Shadows& to) {
            return table.connect[r](context(slots, choice.table, strategy, competing), kernels::chosen_light,
                                    {begin, count}, *w.rays, *w.lobes, *to);
        };
        const std::uint32_t size = connect(stages, queue);
        EXPECT_TRUE(queue.untouched_but(before, 0, static_cast<std::ptrdiff_t>(size) + kernels::widest - 1));
        EXPECT_TRUE(w.rays.same_as(same.rays, -Rays::guard, w.rays.capacity() + Rays::guard)) << "only read";
        if (exact()) {
            Shadows other = before;
            EXPECT_EQ(connect(scalar, other), size);
            EXPECT_TRUE(queue.same_as(other, 0, size));
        }

        std::vector<Shadows> single;
        std::vector<std::map<std::uint32_t, std::uint32_t>> entry;
        for (std::uint32_t light = 0; light < Choice::light_count; ++light) {
            single.emplace_back(capacity);
            entry.push_back(alone(choice, light, r, strategy, w, slots, single.back()));
        }
        std::uint32_t at = 0;
        std::array<std::uint32_t, Choice::light_count> rays{};
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            const std::uint32_t light = chosen_by(choice, w, i), slot = w.rays->slot[i];
            const auto found = entry[light].find(slot);
            if (found == entry[light].end()) {
                ASSERT_TRUE(at == size || queue->slot[at] != slot) << "vertex " << i << ", light " << light;
                continue;
            }
            ASSERT_LT(at, size);
            ASSERT_EQ(queue->slot[at], slot) << "vertex " << i << ", light " << light;
            const Shadows& one = single[light];
            const std::uint32_t from = found->second;
            if (with_targets) {
                ASSERT_EQ(queue->target[at], choice.table.sphere[light]);
            }
            ASSERT_EQ(queue->departed[at], one->departed[from]);
            ASSERT_EQ(get3(queue->ox, queue->oy, queue->oz, at), get3(one->ox, one->oy, one->oz, from));
            ASSERT_EQ(get3(queue->dx, queue->dy, queue->dz, at), get3(one->dx, one->dy, one->dz, from));
            ASSERT_EQ(queue->inverse_t_max[at], one->inverse_t_max[from]);
            const glm::dvec3 whole =
                get3(one->r, one->g, one->b, from) * static_cast<double>(choice.table.inverse_probability[light]);
            const glm::dvec3 emitted = get3(choice.table.r, choice.table.g, choice.table.b, light);
            const glm::dvec3 bright = throughput_of(*w.rays, i) * emitted;
            double share = 1;
            if (competing && choice.table.sphere[light] != no_sphere) {
                // Light sampling's density times the probability, over the sum of that and scattering's.
                share = 1 / (1 + whole.x / bright.x);
            }
            ASSERT_LT(glm::length(get3(queue->r, queue->g, queue->b, at) - whole * share),
                      2e-6 * glm::length(whole * share))
                << "vertex " << i << ", light " << light;
            ++rays[light];
            ++at;
        }
        EXPECT_EQ(at, size);
        if (count == 3001 && with_targets) {
            for (const std::uint32_t n : rays) EXPECT_GT(n, 10u);
        }
    }
};

TEST_P(ConnectChosenTest, SamplesTheChosenLightAsIfThereWereNoOther) {
    const Choice choice(world, false);
    for (const std::uint32_t count : {0u, 1u, 3u, 15u, 16u, 17u, 125u, 3001u})
        for (const auto response : {Response::diffuse, Response::glossy})
            for (const auto strategy : {LightStrategy::area, LightStrategy::cone})
                for (const bool competing : {false, true}) expect_agrees(choice, response, strategy, competing, count);
}

// No vector has an area light then, and no ray a target.
TEST_P(ConnectChosenTest, AmongPointLightsAlone) {
    const Choice choice(world, true);
    for (const std::uint32_t count : {1u, 125u, 3001u})
        for (const auto response : {Response::diffuse, Response::glossy})
            expect_agrees(choice, response, LightStrategy::cone, false, count, false);
}

// Of the same direction, the sample of a chosen light takes a share and emission the rest: what makes all transports
// agree.
TEST_P(ConnectChosenTest, LeavesTheRestToScattering) {
    const Choice choice(world, false);
    constexpr std::uint32_t count = 3001;
    const LitVertices w = wave_of(count);
    for (const auto strategy : {LightStrategy::area, LightStrategy::cone}) {
        const std::uint32_t capacity = kernels::round_up(count) + kernels::widest;
        const Slots slots(capacity);
        const Shadows whole(capacity, Shadows::WithTargets{}), shared(capacity, Shadows::WithTargets{});
        const auto connect = [&](bool competing, const Shadows& to) {
            return stages.connect[0](context(slots, choice.table, strategy, competing), kernels::chosen_light,
                                     {begin, count}, *w.rays, *w.lobes, *to);
        };
        const std::uint32_t size = connect(false, whole);
        ASSERT_EQ(connect(true, shared), size);
        Rays found(capacity);
        Hits hits(capacity);
        for (std::uint32_t i = 0; i < size; ++i) {
            put_ray(*found, i, get3(whole->ox, whole->oy, whole->oz, i), get3(whole->dx, whole->dy, whole->dz, i),
                    whole->departed[i]);
            const std::uint32_t id = whole->departed[i] & no_sphere;
            const glm::dvec3 outward = (origin_of(*found, i) - world.centre(id)) / world.radius(id);
            const double cosine = glm::dot(direction_of(*found, i), outward) * (whole->departed[i] == id ? 1 : -1);
            found->pdf[i] = narrow(cosine / pi);
            hits->t[i] = 1 / whole->inverse_t_max[i];
            hits->id[i] = no_sphere;  // point lights, which nothing runs into
            if (whole->target[i] != no_sphere) {
                const std::uint32_t target = whole->target[i];
                const bool inside =
                    target == id || glm::length(origin_of(*found, i) - world.centre(target)) < world.radius(target);
                hits->id[i] = inside ? target | inside_bit : target;
            }
            for (std::uint32_t c = 0; c < 4; ++c) slots->radiance[4 * i + c] = 0;
        }
        stages.emission(world.spheres, choice.table, world.background, strategy, *found, *hits, size, *slots, {});
        std::uint32_t tested = 0;
        for (std::uint32_t i = 0; i < size; ++i) {
            const double share = static_cast<double>(shared->r[i]) / static_cast<double>(whole->r[i]);
            if (whole->target[i] == no_sphere) {
                ASSERT_EQ(share, 1) << "nothing competes with point lights";
                continue;
            }
            const std::uint32_t light = world.spheres.light[whole->target[i]];
            const double emitted = static_cast<double>(world.lights.r[light]);
            const Roots at = roots(origin_of(*found, i), direction_of(*found, i), world.centre(whole->target[i]),
                                   world.radius(whole->target[i]));
            const double half_chord = (at.far - at.near) / 2 / world.radius(whole->target[i]);
            if (!at.real || half_chord < 0.05 || (hits->id[i] & no_sphere) == (whole->departed[i] & no_sphere))
                continue;
            ASSERT_NEAR(share + static_cast<double>(slots->radiance[4 * i]) / emitted, 1, 2e-4) << "ray " << i;
            ++tested;
        }
        EXPECT_GT(tested, 200u);
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, ConnectChosenTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
