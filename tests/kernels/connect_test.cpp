// Stage `shade`, last step: every shadow ray against the estimator of output/REPORT.md, task 3, in double.
#include "kernel_test.hpp"
#include "light_reference.hpp"
#include "lit_vertices.hpp"
#include "optics_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::LightStrategy;
using kernels::no_sphere;
using kernels::Response;

constexpr std::uint32_t begin = LitVertices::begin, light_sphere = 3;

class ConnectTest : public KernelTest {
protected:
    /// Three balls to stand on, a light, and a ball within the light.
    const World world{{{glm::dvec3(0, 0, 0), 1, 0},
                       {glm::dvec3(3, -1, 2), 0.3, 1},
                       {glm::dvec3(-2, 4, 1), 2, 2},
                       {glm::dvec3(4, 4, -3), 1.5, 0, 0},
                       {glm::dvec3(4.2, 4, -3), 0.25, 1}},
                      {{.beta = 0.3}, {.beta = 0.05}, {.beta = 0.9}},
                      {{5, 6, 7}},
                      {{{2, -3, 4}, {10, 20, 30}}}};
    static constexpr std::uint32_t point_light = 0, area_light = 1;
    LitVertices wave_of(std::uint32_t count) const {
        const glm::dvec3 lights[] = {world.centre(light_sphere)};
        return lit_vertices(world, lights, count);
    }
    kernels::ConnectContext<float> context(const Slots& slots, LightStrategy strategy = LightStrategy::area,
                                           bool competing = false) const {
        return {world.spheres, world.materials, world.lights, *slots, 21, 4, strategy, competing};
    }

    /// A vertex the way the textbook sees it.
    struct Vertex {
        glm::dvec3 p, n, lobe, throughput;
        std::uint32_t sphere;
        bool inward;
        double beta;
        double density(Response response, const glm::dvec3& d) const {
            return response == Response::diffuse ? std::max(0.0, glm::dot(d, n)) / pi
                                                 : glossy_density(lobe, n, beta, d);
        }
        /// How far rounding may move that density, relatively; infinite where it may also be zero.
        double slack(Response response, const glm::dvec3& d) const {
            const double cosine = glm::dot(d, n);
            if (std::abs(cosine) < 1e-5) return std::numeric_limits<double>::infinity();
            if (response == Response::diffuse) return 2e-5 + 4e-6 / std::abs(cosine);
            const double sine = sine_between(lobe, d), side = std::max(glm::dot(lobe, n), 0.0) / beta;
            if (std::abs(sine - beta) < 1e-4 * beta) return std::numeric_limits<double>::infinity();
            return 2e-5 / (1 + side) + 20 * glossy_slack(lobe, beta, d);
        }
    };
    Vertex vertex(const LitVertices& w, std::uint32_t i) const {
        Vertex v;
        v.sphere = w.rays->departed[i] & no_sphere;
        v.inward = (w.rays->departed[i] & inside_bit) != 0;
        v.p = origin_of(*w.rays, i);
        v.n = (v.p - world.centre(v.sphere)) / world.radius(v.sphere) * (v.inward ? -1.0 : 1.0);
        v.lobe = get3(w.lobes->x, w.lobes->y, w.lobes->z, i);
        v.throughput = throughput_of(*w.rays, i);
        v.beta = world.materials.roughness[world.spheres.surface[v.sphere] & kernels::surface_material_mask];
        return v;
    }

    /// Runs a connecting stage, checks what it touches, and that fused instruction sets agree.
    template <class Stage>
    Shadows connected(const LitVertices& w, std::uint32_t& size, Stage&& stage) const {
        Shadows queue(kernels::round_up(w.count) + kernels::widest);
        const Shadows before = queue;
        const LitVertices same = w;
        size = stage(stages, w, queue);
        EXPECT_LE(size, w.count);
        EXPECT_TRUE(queue.untouched_but(before, 0, static_cast<std::ptrdiff_t>(size) + kernels::widest - 1));
        EXPECT_TRUE(w.rays.same_as(same.rays, -Rays::guard, w.rays.capacity() + Rays::guard)) << "only read";
        if (exact()) {
            Shadows other = before;
            EXPECT_EQ(stage(scalar, w, other), size);
            EXPECT_TRUE(queue.same_as(other, 0, size));
        }
        return queue;
    }

    /// Common to every entry: whose it is.
    static void expect_belongs(const Shadows& queue, std::uint32_t at, const LitVertices& w, std::uint32_t i) {
        ASSERT_EQ(queue->departed[at], w.rays->departed[i]);
        ASSERT_EQ(get3(queue->ox, queue->oy, queue->oz, at), origin_of(*w.rays, i));
        ASSERT_NEAR(glm::length(get3(queue->dx, queue->dy, queue->dz, at)), 1, 4e-7);
    }

    void expect_point_light_agrees(Response response, std::uint32_t count) const {
        const Slots slots(16);
        const LitVertices w = wave_of(count);
        std::uint32_t size = 0;
        const Shadows queue = connected(w, size, [&](const auto& table, const LitVertices& in, const Shadows& to) {
            return table.connect[static_cast<std::size_t>(response)](context(slots), point_light, {begin, in.count},
                                                                     *in.rays, *in.lobes, *to);
        });
        std::uint32_t at = 0;
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            const Vertex v = vertex(w, i);
            const glm::dvec3 to = glm::dvec3(2, -3, 4) - v.p, d = glm::normalize(to);
            const double slack = v.slack(response, d), density = v.density(response, d);
            const bool alive = v.throughput != glm::dvec3(0);
            const bool present = at < size && queue->slot[at] == w.rays->slot[i];
            if (slack < 1 || !alive) {
                ASSERT_EQ(present, alive && density > 0) << "vertex " << i;
            }
            if (!present) continue;
            expect_belongs(queue, at, w, i);
            ASSERT_LT(glm::length(get3(queue->dx, queue->dy, queue->dz, at) - d), 1e-6);
            ASSERT_NEAR(queue->inverse_t_max[at], 1 / glm::length(to), 1e-6 / glm::length(to));
            const glm::dvec3 wanted = v.throughput * glm::dvec3(10, 20, 30) * density / glm::dot(to, to);
            if (slack < 1) {
                ASSERT_LT(glm::length(get3(queue->r, queue->g, queue->b, at) - wanted), slack * glm::length(wanted));
            }
            ++at;
        }
        EXPECT_EQ(at, size);
        if (count == 3001) {
            EXPECT_GT(size, response == Response::diffuse ? 800u : 30u);
        }
    }

    void expect_area_light_agrees(Response response, LightStrategy strategy, bool competing,
                                  std::uint32_t count) const {
        const Slots slots(16);
        const LitVertices w = wave_of(count);
        std::uint32_t size = 0;
        const Shadows queue = connected(w, size, [&](const auto& table, const LitVertices& in, const Shadows& to) {
            return table.connect[static_cast<std::size_t>(response)](context(slots, strategy, competing), area_light,
                                                                     {begin, in.count}, *in.rays, *in.lobes, *to);
        });
        const glm::dvec3 centre = world.centre(light_sphere), emitted(5, 6, 7);
        const double radius = world.radius(light_sphere);
        std::uint32_t at = 0, own = 0;
        for (std::uint32_t i = begin; i < begin + count && at < size; ++i) {
            if (queue->slot[at] != w.rays->slot[i]) continue;
            const Vertex v = vertex(w, i);
            ASSERT_NE(v.throughput, glm::dvec3(0)) << "a dead ray";
            ASSERT_TRUE(v.sphere != light_sphere || v.inward) << "a sphere does not shine on its own outside";
            own += v.sphere == light_sphere;
            expect_belongs(queue, at, w, i);
            const glm::dvec3 d = get3(queue->dx, queue->dy, queue->dz, at);
            const double t = 1 / static_cast<double>(queue->inverse_t_max[at]);
            const bool inside = v.sphere == light_sphere || glm::length(v.p - centre) < radius;
            const Roots r = roots(v.p, d, centre, radius);
            // The segment ends on the side of the light that is seen. Where the light's outline is grazed, or sampled
            // from a point of its own surface, rounding moves that by much.
            const double ill = 16 * 0x1p-24 * (r.reach + radius * radius / std::max(r.far - r.near, 1e-9));
            if (r.real && ill < 0.01 * t) {
                ASSERT_NEAR(t, inside ? r.far : r.near, 1e-6 * t + ill);
                const double density = v.density(response, d);
                double ratio = density / light_density(inside ? LightStrategy::area : strategy, v.p, d, centre, radius);
                if (inside) {
                    const glm::dvec3 n = (v.p + r.far * d - centre) / radius;
                    ratio = density * 4 * pi * radius * radius * glm::dot(n, d) / (r.far * r.far);
                }
                if (competing) ratio /= 1 + ratio;
                const double half_chord = (r.far - r.near) / 2;
                const double slack =
                    v.slack(response, d) + 16 * 0x1p-24 * (1 + t * radius / (half_chord * half_chord)) + 2 * ill / t;
                const glm::dvec3 wanted = v.throughput * emitted * ratio;
                if (slack < 1) {
                    ASSERT_LT(glm::length(get3(queue->r, queue->g, queue->b, at) - wanted), slack * glm::length(wanted))
                        << "vertex " << i << " of sphere " << v.sphere;
                }
            }
            ++at;
        }
        EXPECT_EQ(at, size) << "entries out of order";
        if (count == 3001) {
            EXPECT_GT(size, 30u);
            EXPECT_GT(own, 10u) << "from within the light";
        }
    }
};

const std::vector<std::uint32_t> counts{0, 1, 3, 15, 16, 17, 125, 3001};

TEST_P(ConnectTest, PointLightOnDiffuse) {
    for (const std::uint32_t count : counts) expect_point_light_agrees(Response::diffuse, count);
}
TEST_P(ConnectTest, PointLightOnGlossy) {
    for (const std::uint32_t count : counts) expect_point_light_agrees(Response::glossy, count);
}
TEST_P(ConnectTest, AreaLightOnDiffuse) {
    for (const std::uint32_t count : counts)
        for (const auto strategy : {LightStrategy::area, LightStrategy::cone})
            for (const bool competing : {false, true})
                expect_area_light_agrees(Response::diffuse, strategy, competing, count);
}
TEST_P(ConnectTest, AreaLightOnGlossy) {
    for (const std::uint32_t count : counts)
        for (const auto strategy : {LightStrategy::area, LightStrategy::cone})
            for (const bool competing : {false, true})
                expect_area_light_agrees(Response::glossy, strategy, competing, count);
}

TEST_P(ConnectTest, DeadVerticesConnectToNothing) {
    const Slots slots(16);
    const LitVertices w = wave_of(125);
    for (std::uint32_t i = begin; i < begin + 125; ++i) put3(w.rays->tr, w.rays->tg, w.rays->tb, i, glm::dvec3(0));
    Shadows queue(160);
    const Shadows before = queue;
    for (const std::size_t r : {0u, 1u}) {
        const auto rays = [&](LightStrategy strategy, std::uint32_t light) {
            return stages.connect[r](context(slots, strategy), light, {begin, 125}, *w.rays, *w.lobes, *queue);
        };
        EXPECT_EQ(rays(LightStrategy::area, point_light), 0u);
        for (const auto strategy : {LightStrategy::area, LightStrategy::cone})
            EXPECT_EQ(rays(strategy, area_light), 0u);
    }
    EXPECT_TRUE(queue.untouched_but(before, 0, kernels::widest - 1));
}

// A throughput that is no number goes to the light like any other, and with it through the film's count.
TEST_P(ConnectTest, NoNumberIsLostWhicheverChannelItIsIn) {
    const Slots slots(16);
    for (const bool competing : {false, true})
        for (int channel = 0; channel < 3; ++channel) {
            const LitVertices w = wave_of(125);
            glm::dvec3 throughput(0);
            throughput[channel] = std::numeric_limits<double>::quiet_NaN();
            const auto shadow_rays = [&](std::size_t response, LightStrategy strategy, std::uint32_t light) {
                Shadows queue(160);
                const std::uint32_t size = stages.connect[response](context(slots, strategy, competing), light,
                                                                    {begin, 125}, *w.rays, *w.lobes, *queue);
                std::uint32_t none = 0;
                for (std::uint32_t i = 0; i < size; ++i) {
                    const glm::dvec3 radiance = get3(queue->r, queue->g, queue->b, i);
                    none += std::isnan(radiance[channel]) ? 1u : 0u;
                }
                return std::pair(size, none);
            };
            for (const std::size_t r : {0u, 1u}) {
                const auto set = [&](const glm::dvec3& to) {
                    for (std::uint32_t i = begin; i < begin + 125; ++i) put3(w.rays->tr, w.rays->tg, w.rays->tb, i, to);
                };
                const auto compare = [&](LightStrategy strategy, std::uint32_t light) {
                    set(glm::dvec3(1));
                    const auto all = shadow_rays(r, strategy, light).first;
                    ASSERT_GT(all, 0u);
                    set(throughput);
                    EXPECT_EQ(shadow_rays(r, strategy, light), std::pair(all, all)) << "channel " << channel;
                };
                compare(LightStrategy::area, point_light);
                for (const auto strategy : {LightStrategy::area, LightStrategy::cone}) compare(strategy, area_light);
            }
        }
}

// A light at the vertex itself has no direction and no distance: nothing may come of it, least of all a NaN.
TEST_P(ConnectTest, PointLightOnTheSurfaceItselfIsLeftOut) {
    const Slots slots(16);
    LitVertices w{Rays(48), Lobes(48), 1};
    put_ray(*w.rays, begin, {1, 0, 0}, {1, 0, 0}, 0);
    const World touched({{}}, {Surface{}}, {}, {{{1, 0, 0}, glm::dvec3(1)}});
    auto with_light = context(slots);
    with_light.lights = touched.lights;
    Shadows queue(32);
    EXPECT_EQ(stages.connect[0](with_light, 0, {begin, 1}, *w.rays, *w.lobes, *queue), 0u);
}

INSTANTIATE_TEST_SUITE_P(Isas, ConnectTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
