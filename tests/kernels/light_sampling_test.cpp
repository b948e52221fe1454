// Directions that `connect` draws towards a light: their distribution, the density claimed for them, and that the
// two halves of multiple importance sampling share the light between them.
#include <functional>

#include "fit.hpp"
#include "geometry.hpp"
#include "kernel_test.hpp"
#include "light_reference.hpp"
#include "numbers.hpp"
#include "optics_reference.hpp"
#include "owned.hpp"
#include "statistics/moments.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::LightStrategy;

/// A diffuse vertex on a ball and a light straight above it, so that all of the light is over the horizon; unless the
/// light is around it.
struct Setting {
    double distance;  ///< from the vertex to the light's centre
    double radius;    ///< of the light
    glm::dvec3 n = glm::normalize(glm::dvec3(2, -1, 2));
    glm::dvec3 p = n * 1.0;
    glm::dvec3 centre() const { return p + distance * n; }
    bool within() const { return distance <= radius; }
};

struct Sample {
    glm::dvec3 vertex, direction;
    double distance;     ///< to the sampled point
    double inverse_pdf;  ///< as used in the estimate
};

class LightSampling : public KernelTest {
protected:
    static constexpr std::uint32_t batch = 4096;

    static World world_of(const Setting& s) {
        return World({{glm::dvec3(0), 1, 0}, {s.centre(), s.radius, 0, 0}}, {Surface{}}, {{1, 1, 1}});
    }
    /// Samples the light `count` times from the vertex, or from the light's own inside; returns how many samples were
    /// of use.
    std::uint32_t sample_many(const Setting& s, LightStrategy strategy, std::uint32_t count,
                              const std::function<void(const Sample&)>& visit, bool own = false) const {
        const World world = world_of(s);
        const Slots slots(16);
        const Lobes no_lobes(0, {"lobe_x", "lobe_y", "lobe_z"});
        Rays rays(batch);
        Shadows queue(batch + kernels::widest);
        std::uint32_t useful = 0;
        for (std::uint32_t first = 0; first < count; first += batch) {
            for (std::uint32_t i = 0; i < batch; ++i) {
                put_ray(*rays, i, own ? world.centre(1) - world.radius(1) * s.n : s.p, s.n, own ? 1 | inside_bit : 0);
                rays->pixel[i] = (first + i) / 64, rays->sample[i] = (first + i) % 64;
            }
            const std::uint32_t size =
                stages.connect[0]({world.spheres, world.materials, world.lights, *slots, 5, 2, strategy, false}, 0,
                                  {0, batch}, *rays, *no_lobes, *queue);
            for (std::uint32_t i = 0; i < size; ++i) {
                Sample sample;
                sample.vertex = origin_of(*rays, 0);
                sample.direction = glm::normalize(get3(queue->dx, queue->dy, queue->dz, i));
                sample.distance = 1 / static_cast<double>(queue->inverse_t_max[i]);
                sample.inverse_pdf = static_cast<double>(queue->r[i]) * pi / glm::dot(sample.direction, s.n);
                visit(sample);
            }
            useful += size;
        }
        return useful;
    }
};

const Setting settings[] = {{30, 1}, {3, 1}, {1.05, 1}, {1.0005, 1}, {10, 1e-3}, {100, 20}};

std::string name_of(const Setting& s) {
    return "radius " + std::to_string(s.radius) + " at " + std::to_string(s.distance);
}

// 1 - cos of the angle to the centre is uniform up to the outline's.
TEST_P(LightSampling, ConeIsUniformOverTheSolidAngle) {
    for (const Setting& s : settings) {
        const World world = world_of(s);
        Histogram cells(16, 16);
        const std::uint32_t useful = sample_many(s, LightStrategy::cone, 1u << 19, [&](const Sample& sample) {
            const glm::dvec3 axis = glm::normalize(world.centre(1) - sample.vertex);
            const double widest = solid_angle(sample.vertex, world.centre(1), world.radius(1)) / (2 * pi);
            const glm::dvec3 off = sample.direction - axis;
            // A direction in floats resolves a small light's disk to 2^-24 of a radian only.
            const double share = glm::dot(off, off) / 2 / widest, grain = 0x1p-22 * s.distance / s.radius;
            cells.add(Frame(axis, {0, 0, 1}).azimuth(sample.direction) / (2 * pi) + 0.5,
                      share > 1 && share < 1 + grain + 1e-4 ? 1 : share);
        });
        EXPECT_EQ(useful, 1u << 19) << "from outside every direction of the cone is of use";
        cells.expect_uniform("cone, " + name_of(s));
    }
}

TEST_P(LightSampling, ConeDensityIsOneOverTheSolidAngle) {
    for (const Setting& s : {Setting{30, 1},
                             {3, 1},
                             {1.05, 1},
                             {1.0005, 1},
                             {10, 1e-3},
                             {100, 20},
                             {1, 0.00465},
                             {1000, 1e-3},
                             {1e4, 1e-3}}) {
        const World world = world_of(s);
        double worst = 0;
        sample_many(s, LightStrategy::cone, batch, [&](const Sample& sample) {
            const double wanted = solid_angle(sample.vertex, world.centre(1), world.radius(1));
            worst = std::max(worst, std::abs(sample.inverse_pdf / wanted - 1));
        });
        // Close to the surface the angle hangs on how far above it the vertex is, which floats know less well.
        EXPECT_LT(worst, 2e-6 + 0x1p-20 * std::sqrt(s.radius / (s.distance - s.radius))) << name_of(s);
    }
}

/// Where on the light a sample lies, as a unit vector from its centre.
glm::dvec3 on_light(const World& world, const Sample& sample) {
    return glm::normalize(sample.vertex + sample.distance * sample.direction - world.centre(1));
}

// Points are uniform over the sphere; of use is the cap that faces the vertex, cos > r / d.
TEST_P(LightSampling, AreaIsUniformOverTheFacingCap) {
    for (const Setting& s : {Setting{30, 1}, {3, 1}, {1.05, 1}, {100, 20}}) {
        const World world = world_of(s);
        const double cap = 1 - s.radius / s.distance;
        Histogram cells(16, 16);
        constexpr std::uint32_t count = 1u << 20;
        const std::uint32_t useful = sample_many(s, LightStrategy::area, count, [&](const Sample& sample) {
            const glm::dvec3 n = on_light(world, sample);
            const double height = (1 - glm::dot(n, -s.n)) / cap;
            cells.add(Frame(s.n, {0, 0, 1}).azimuth(n) / (2 * pi) + 0.5, height > 1 && height < 1 + 1e-4 ? 1 : height);
        });
        cells.expect_uniform("area, " + name_of(s));
        EXPECT_LT(std::abs(useful - cap / 2 * count), 5.5 * std::sqrt(cap / 2 * (1 - cap / 2) * count)) << name_of(s);
    }
}

// From inside the light all of it is seen, and both strategies are the same one.
TEST_P(LightSampling, FromInsideTheLightIsUniformOverTheSphere) {
    for (const auto strategy : {LightStrategy::area, LightStrategy::cone}) {
        const Setting around{0.5, 4};  // a foreign light around the vertex: what is over the horizon of it
        const World world = world_of(around);
        Histogram above(16, 16), own(16, 16);
        sample_many(around, strategy, 1u << 20, [&](const Sample& sample) {
            const glm::dvec3 n = on_light(world, sample);
            const double lowest = -around.distance / around.radius;  // the horizon's height, seen from the centre
            above.add(Frame(around.n, {0, 0, 1}).azimuth(n) / (2 * pi) + 0.5,
                      (glm::dot(n, around.n) - lowest) / (1 - lowest));
        });
        above.expect_uniform("from inside a foreign light");
        const std::uint32_t useful = sample_many(
            around, strategy, 1u << 19,
            [&](const Sample& sample) {
                const glm::dvec3 n = on_light(world, sample);
                own.add(Frame(around.n, {0, 0, 1}).azimuth(n) / (2 * pi) + 0.5, (glm::dot(n, around.n) + 1) / 2);
            },
            true);
        own.expect_uniform("from the light's own inside");
        EXPECT_GE(useful, (1u << 19) - 2) << "every point of a sphere is seen from every other";
    }
}

// The mean of 1/pdf over all samples, those of no use counting zero, is the solid angle: for either strategy, and
// whatever the distribution.
TEST_P(LightSampling, MeanOfTheInverseDensityIsTheSolidAngle) {
    for (const Setting& s : settings) {
        const World world = world_of(s);
        const double wanted = solid_angle(s.p, world.centre(1), world.radius(1));
        constexpr std::uint32_t count = 1u << 18;
        statistics::RunningMoments mean;
        const std::uint32_t useful =
            sample_many(s, LightStrategy::area, count, [&](const Sample& sample) { mean.add(sample.inverse_pdf); });
        for (std::uint32_t i = useful; i < count; ++i) mean.add(0);
        EXPECT_LT(std::abs(mean.mean() - wanted), 5.5 * std::sqrt(mean.variance_of_mean()) + 1e-4 * wanted)
            << name_of(s);
    }
}

// Of the same direction, light sampling takes the share `competing` leaves it and emission the rest. In the last
// setting the vertex is a point of the light's own surface, to the last bit.
TEST_P(LightSampling, BothTechniquesShareTheLight) {
    for (const Setting& s : {Setting{3, 1}, {1.05, 1}, {30, 1}, {0.5, 4}, {2, 2, {0, 0, 1}, {0, 0, 1}}}) {
        for (const auto strategy : {LightStrategy::area, LightStrategy::cone}) {
            const World world = world_of(s);
            const Slots slots(batch);
            const Lobes no_lobes(0, {"lobe_x", "lobe_y", "lobe_z"});
            Rays rays(batch), found(batch);
            Hits hits(batch);
            Shadows whole(batch + 16), shared(batch + 16);
            for (std::uint32_t i = 0; i < batch; ++i) put_ray(*rays, i, s.p, s.n, 0);
            const auto connect = [&](bool competing, const Shadows& queue) {
                return stages.connect[0](
                    {world.spheres, world.materials, world.lights, *slots, 5, 2, strategy, competing}, 0, {0, batch},
                    *rays, *no_lobes, *queue);
            };
            const std::uint32_t size = connect(false, whole);
            ASSERT_GT(size, batch / 64) << name_of(s) << ": what scattering leaves nobody samples";
            ASSERT_EQ(connect(true, shared), size);
            for (std::uint32_t i = 0; i < size; ++i) {
                const glm::dvec3 d = get3(whole->dx, whole->dy, whole->dz, i);
                put_ray(*found, i, s.p, d, 0);
                found->pdf[i] = narrow(glm::dot(d, s.n) / pi);
                hits->t[i] = 1 / whole->inverse_t_max[i];
                hits->id[i] = 1 | (s.within() ? inside_bit : 0);
                slots->radiance[4 * i] = slots->radiance[4 * i + 1] = slots->radiance[4 * i + 2] = 0;
            }
            stages.emission(world.spheres, world.lights, world.background, strategy, *found, *hits, size, *slots, {});
            for (std::uint32_t i = 0; i < size; ++i) {
                const double light_share = static_cast<double>(shared->r[i]) / static_cast<double>(whole->r[i]);
                const Roots r = roots(origin_of(*found, i), direction_of(*found, i), world.centre(1), world.radius(1));
                if (!r.real || 0x1p-24 * r.reach > 1e-5 * world.radius(1)) continue;  // grazing the light's outline
                ASSERT_NEAR(light_share + static_cast<double>(slots->radiance[4 * i]), 1, 2e-4) << name_of(s);
            }
        }
    }
}

TEST_P(LightSampling, LightsAndBouncesDrawDifferentNumbers) {
    const Setting s{3, 1};
    const World world({{glm::dvec3(0), 1, 0}, {s.centre(), s.radius, 0, 0}, {s.centre(), s.radius, 0, 1}}, {Surface{}},
                      {{1, 1, 1}, {1, 1, 1}});
    const Slots slots(16);
    const Lobes no_lobes(0, {"lobe_x", "lobe_y", "lobe_z"});
    Rays rays(16);
    put_ray(*rays, 0, s.p, s.n, 0);
    std::vector<float> seen;
    for (const std::uint32_t seed : {0u, 1u})
        for (const std::uint32_t bounce : {0u, 1u})
            for (const std::uint32_t light : {0u, 1u}) {
                Shadows queue(16);
                ASSERT_EQ(stages.connect[0]({world.spheres, world.materials, world.lights, *slots, seed, bounce,
                                             LightStrategy::cone, false},
                                            light, {0, 1}, *rays, *no_lobes, *queue),
                          1u);
                seen.push_back(queue->dx[0]);
            }
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end());
}

INSTANTIATE_TEST_SUITE_P(Isas, LightSampling, ::testing::ValuesIn(differing_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
