// Light samples drawn from a rough vertex's own directions: they lie on the light and in the lobe, their factors have
// the mean of the lobe's share within the light, and weighed by them they are spread as the lobe is.
#include <cmath>
#include <functional>

#include "geometry.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "optics_reference.hpp"
#include "owned.hpp"

namespace orrery::kernel_tests {
namespace {

using glm::dvec3;
using kernels::LightStrategy;

/// A rough vertex with normal +y on top of a ball, its lobe, and a light.
struct Setting {
    double beta;
    dvec3 lobe;    ///< unit length, on the side of +y
    dvec3 centre;  ///< of the light, from the vertex
    double radius;
};

struct Sample {
    dvec3 direction;
    double factor, distance;
};

class LobeCap : public KernelTest {
protected:
    static constexpr std::uint32_t batch = 4096;

    /// Draws `count` samples, passes those of use on, and returns how many they are.
    std::uint32_t sample_many(const Setting& s, std::uint32_t count, const std::function<void(const Sample&)>& visit,
                              bool competing = true) const {
        Surface rough;
        rough.kind = kernels::Scattering::glossy, rough.beta = s.beta;
        const World world({{dvec3(0, -1, 0), 1, 0}, {s.centre, s.radius, 0, 0}}, {rough}, {{1, 1, 1}});
        const Slots slots(16);
        const Lobes lobes(batch);
        Rays rays(batch);
        Shadows queue(batch + kernels::widest);
        std::uint32_t useful = 0;
        for (std::uint32_t first = 0; first < count; first += batch) {
            for (std::uint32_t i = 0; i < batch; ++i) {
                put_ray(*rays, i, dvec3(0), s.lobe, 0);
                put3(lobes->x, lobes->y, lobes->z, i, s.lobe);
                rays->pixel[i] = (first + i) / 64, rays->sample[i] = (first + i) % 64;
            }
            const std::uint32_t size = stages.connect[1](
                {world.spheres, world.materials, world.lights, *slots, 5, 2, LightStrategy::exact, competing}, 0,
                {0, batch}, *rays, *lobes, *queue);
            for (std::uint32_t i = 0; i < size; ++i)
                visit({get3(queue->dx, queue->dy, queue->dz, i), queue->r[i],
                       1 / static_cast<double>(queue->inverse_t_max[i])});
            useful += size;
        }
        return useful;
    }

    static Setting random_setting(Numbers& random) {
        Setting s;
        s.beta = random.between(0.02, 0.97);
        s.lobe = random.direction();
        s.lobe.y = std::abs(s.lobe.y) + 0.02;
        s.lobe = glm::normalize(s.lobe);
        // Near the lobe as a rule, or they would hardly meet.
        const double distance = std::exp2(random.between(-2, 5));
        s.centre = distance * glm::normalize(s.lobe + random.between(0, 2 * s.beta) * random.direction());
        s.radius = distance * std::exp2(random.between(-9, -0.02));
        return s;
    }
};

/// unit(R + beta S), S uniform, on the side of +y.
dvec3 of_lobe(const Setting& s, Numbers& random) {
    for (;;) {
        const dvec3 d = glm::normalize(s.lobe + s.beta * random.direction());
        if (d.y > 0) return d;
    }
}

TEST_P(LobeCap, MeanFactorIsTheLobesShareWithinTheLight) {
    Numbers random(5);
    double squares = 0;
    std::uint32_t judged = 0;
    for (int trial = 0; trial < 120; ++trial) {
        const Setting s = random_setting(random);
        constexpr std::uint32_t count = 1u << 14;
        double sum = 0, square = 0;
        sample_many(s, count, [&](const Sample& sample) {
            const Roots r = roots(dvec3(0), sample.direction, s.centre, s.radius);
            const double distance = glm::length(s.centre);
            if (!r.real) {
                // Off the outline by what a direction's rounding is.
                const dvec3 across = s.centre - glm::dot(s.centre, sample.direction) * sample.direction;
                ASSERT_LT(glm::length(across) - s.radius, 1e-6 * distance);
            } else if (r.far - r.near > 1e-3 * s.radius) {
                ASSERT_NEAR(sample.distance, r.near, 1e-5 * distance + 1e-6 * distance * distance / (r.far - r.near));
            }
            ASSERT_GT(sample.direction.y, 0);
            ASSERT_LT(sine_between(s.lobe, sample.direction), s.beta + 1e-6);
            ASSERT_GT(sample.factor, 0);
            ASSERT_LT(sample.factor, 2.00001);
            sum += sample.factor, square += sample.factor * sample.factor;
        });
        std::uint32_t met = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const dvec3 d = of_lobe(s, random);
            const double along = glm::dot(s.centre, d);
            const dvec3 across = s.centre - along * d;
            met += along > 0 && glm::dot(across, across) < s.radius * s.radius;
        }
        const double mean = sum / count, share = static_cast<double>(met) / count;
        const double variance =
            (square / count - mean * mean) / count + std::max(share * (1 - share), 1.0 / count) / count;
        const double z = (mean - share) / std::sqrt(variance);
        ASSERT_LT(std::abs(z), 4.5) << "beta " << s.beta << ", light " << s.radius / glm::length(s.centre) << ": "
                                    << mean << ", not " << share;
        squares += z * z;
        judged += share > 0.001;
    }
    EXPECT_GT(judged, 70u);
    EXPECT_NEAR(squares / 120, 1, 0.5) << "and no more";
}

// By the angle from the lobe and the azimuth about it, weighed by their factors.
TEST_P(LobeCap, DirectionsAreTheLobesOwn) {
    const dvec3 lobe = glm::normalize(dvec3(0.6, 1, 0.3));
    const Setting settings[] = {{0.3, lobe, 5.0 * glm::normalize(lobe + dvec3(0.15, 0, 0)), 0.7},
                                {0.3, lobe, 5.0 * glm::normalize(lobe + dvec3(0.3, 0, 0)), 0.7},
                                {0.8, lobe, 2.0 * lobe, 1.2},
                                {0.9, lobe, 2.0 * glm::normalize(dvec3(0.9, 0.1, 0.3)), 0.9}};
    for (const Setting& s : settings) {
        const Frame frame(s.lobe, s.centre);
        constexpr std::uint32_t count = 1u << 17;
        constexpr int rings = 8, sectors = 8;
        std::vector<double> sum(rings * sectors), square(sum), other(sum);
        const auto cell = [&](const dvec3& d) {
            const double sine = sine_between(s.lobe, d) / s.beta;
            const int ring = std::min(rings - 1, static_cast<int>(sine * sine * rings));
            const int sector = std::min(sectors - 1, static_cast<int>((frame.azimuth(d) / (2 * pi) + 0.5) * sectors));
            return static_cast<std::size_t>(ring * sectors + sector);
        };
        sample_many(s, count, [&](const Sample& sample) {
            sum[cell(sample.direction)] += sample.factor;
            square[cell(sample.direction)] += sample.factor * sample.factor;
        });
        Numbers random(9);
        for (std::uint32_t i = 0; i < count; ++i) {
            const dvec3 d = of_lobe(s, random);
            const double along = glm::dot(s.centre, d);
            const dvec3 across = s.centre - along * d;
            if (along > 0 && glm::dot(across, across) < s.radius * s.radius) other[cell(d)] += 1;
        }
        double chi2 = 0;
        int cells = 0;
        for (std::size_t c = 0; c < sum.size(); ++c) {
            if (other[c] < 20 && sum[c] < 20) continue;
            chi2 += (sum[c] - other[c]) * (sum[c] - other[c]) / (square[c] + other[c]);
            ++cells;
        }
        EXPECT_GT(cells, 8);
        EXPECT_LT(chi2, cells + 5 * std::sqrt(2.0 * cells)) << "beta " << s.beta;
    }
}

// Where the light is wholly outside the lobe, or the vertex within the light, none of this applies.
TEST_P(LobeCap, OutsideTheLobeNothingAndInsideTheLightByArea) {
    const auto none = [](const Sample&) {};
    EXPECT_EQ(sample_many({0.3, {0, 1, 0}, {5, 0.5, 0}, 0.5}, 4096, none), 0u);
    double sum = 0, shared = 0;
    const Setting around{0.5, {0, 1, 0}, {0.3, 0.2, 0}, 3};
    const std::uint32_t count = 1u << 18;
    sample_many(around, count, [&](const Sample& sample) {
        const Roots r = roots(dvec3(0), sample.direction, around.centre, around.radius);
        ASSERT_NEAR(sample.distance, r.far, 1e-5);
        shared += sample.factor;
    });
    sample_many(
        around, count, [&](const Sample& sample) { sum += sample.factor; }, false);
    EXPECT_NEAR(sum / count, 1, 0.05) << "all of the lobe is within the light";
    EXPECT_LT(shared / count, 0.9) << "a share is left to scattering";
    EXPECT_GT(shared / count, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Isas, LobeCap, ::testing::ValuesIn(differing_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
