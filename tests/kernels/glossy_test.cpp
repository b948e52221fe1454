// The glossy lobe's sampler and value as functions: they agree with the specification's formula, with each other, and
// with a total of one. What the stages draw is in scatter_sampling_test.cpp.
#include "kernels/lobes.hpp"

#include <gtest/gtest.h>

#include "numbers.hpp"
#include "optics_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using V = kernels::ScalarLanes<float>;

kernels::Vec3<float> narrow3(const glm::dvec3& v) { return {narrow(v.x), narrow(v.y), narrow(v.z)}; }
glm::dvec3 widen(const kernels::Vec3<float>& v) { return {v.x, v.y, v.z}; }

/// A lobe at an angle to the normal, as a mirror direction is.
struct Lobe {
    double beta, angle;
    glm::dvec3 n = glm::normalize(glm::dvec3(1, 2, -2));
    glm::dvec3 r = Frame(n, {0, 0, 1}).at(angle, 0.7);
    double cosine = std::cos(angle);
};

std::vector<Lobe> lobes() {
    std::vector<Lobe> all;
    for (const double beta : {0.01, 0.1, 0.4, 0.9})
        for (const double degrees : {0, 45, 80, 89})
            all.push_back({.beta = static_cast<double>(narrow(beta)), .angle = degrees * pi / 180});
    return all;
}

double value(const Lobe& lobe, const glm::dvec3& direction) {
    return kernels::glossy_pdf<V>(narrow3(lobe.r), narrow(lobe.cosine), narrow(lobe.beta), narrow3(direction),
                                  narrow(glm::dot(direction, lobe.n)));
}

TEST(Glossy, SideProbability) {
    for (const Lobe& lobe : lobes())
        EXPECT_NEAR(kernels::glossy_side_probability(narrow(lobe.cosine), narrow(lobe.beta)),
                    lobe_side_probability(lobe.cosine, lobe.beta), 1e-6);
    EXPECT_EQ(kernels::glossy_side_probability(0.0f, 0.5f), 0.5f);
    EXPECT_EQ(kernels::glossy_side_probability(1.0f, 0.5f), 1.0f);
}

// Over the whole sphere. With sin theta = beta sin psi the singular edge becomes an end of a smooth integral: p sin
// theta dtheta = p beta cos psi tan theta dpsi. The horizon cuts the azimuth, at an angle known exactly, so both
// integrals are smooth.
TEST(Glossy, ValueIntegratesToOne) {
    constexpr int rings = 400, steps = 64;
    for (const Lobe& lobe : lobes()) {
        const Frame frame(lobe.r, lobe.n);
        double total = 0;
        for (int ring = 0; ring < rings; ++ring) {
            const double psi = (ring + 0.5) / rings * pi / 2;
            const double theta = std::asin(lobe.beta * std::sin(psi));
            // cos theta cos(angle) + sin theta sin(angle) cos phi > 0
            const double cut = std::cos(theta) * lobe.cosine / (std::sin(theta) * std::sin(lobe.angle));
            const double half = cut >= 1 ? pi : std::acos(-cut);
            double sum = 0;
            for (int i = 0; i < steps; ++i) sum += value(lobe, frame.at(theta, half * (2 * (i + 0.5) / steps - 1)));
            total += sum / steps * 2 * half * lobe.beta * std::cos(psi) * std::tan(theta) * (pi / 2 / rings);
        }
        EXPECT_NEAR(total, 1, 2e-3) << "beta " << lobe.beta << ", " << lobe.angle * 180 / pi << " degrees";
    }
}

TEST(Glossy, ValueIsTheFormula) {
    Numbers random(1);
    for (const Lobe& lobe : lobes()) {
        const Frame frame(lobe.r, lobe.n);
        for (int i = 0; i < 5000; ++i) {
            const double sine = lobe.beta * 1.2 * random.uniform();
            const glm::dvec3 d = widen(narrow3(frame.at(std::asin(std::min(sine, 1.0)), random.between(-pi, pi))));
            const glm::dvec3 r = widen(narrow3(lobe.r));
            if (std::abs(sine_between(r, d) / lobe.beta - 1) < 1e-4 || std::abs(glm::dot(d, lobe.n)) < 1e-6) continue;
            const double wanted = glossy_density(r, lobe.n, lobe.beta, d);
            ASSERT_NEAR(value(lobe, d), wanted, wanted * glossy_slack(r, lobe.beta, d) * 2)
                << "beta " << lobe.beta << ", " << lobe.angle * 180 / pi << " degrees";
        }
    }
}

TEST(Glossy, ValueIsZeroOutsideTheLobeAndBelowTheHorizon) {
    const Lobe lobe{.beta = 0.4, .angle = 80 * pi / 180};
    const Frame frame(lobe.r, lobe.n);
    EXPECT_EQ(value(lobe, frame.at(std::asin(0.401), 0)), 0);
    EXPECT_EQ(value(lobe, -lobe.r), 0) << "sin theta is 0 there as well";
    EXPECT_EQ(value(lobe, frame.at(0.3, pi)), 0) << "under the surface";
    EXPECT_GT(value(lobe, frame.at(0.3, 0)), 0);
}

// What the sampler says its density was is the value at the direction it returned.
TEST(Glossy, SampledDensityIsTheValueThere) {
    Numbers random(2);
    for (const Lobe& lobe : lobes()) {
        for (int i = 0; i < 20000; ++i) {
            const auto s = kernels::sample_glossy<V>(narrow3(lobe.r), narrow3(lobe.n), narrow(lobe.cosine),
                                                     narrow(lobe.beta), narrow(random.below(1u << 24) * 0x1p-24),
                                                     narrow(random.below(1u << 24) * 0x1p-24));
            const glm::dvec3 d = widen(s.direction), r = widen(narrow3(lobe.r));
            ASSERT_NEAR(glm::length(d), 1, 4e-7);
            ASSERT_GT(glm::dot(d, lobe.n), -2e-7) << "below the horizon";
            ASSERT_LT(sine_between(r, d), lobe.beta + 4e-7) << "outside the lobe";
            ASSERT_GT(s.pdf, 0.0f);
            const double slack = glossy_slack(r, lobe.beta, d);
            if (slack > 0.05 || glm::dot(d, lobe.n) < 1e-6) continue;
            // R + beta S may be as short as 1 - beta, and what rounding leaves of its direction as coarse.
            const double short_sum = 4e-7 / ((1 - lobe.beta) * (1 - lobe.beta));
            const double wanted = glossy_density(r, lobe.n, lobe.beta, d);
            ASSERT_NEAR(s.pdf, wanted, (2 * slack + short_sum) * wanted)
                << "beta " << lobe.beta << ", " << lobe.angle * 180 / pi;
        }
    }
}

// Ends of the unit square: the horizon, the pole, the whole turn.
TEST(Glossy, ExtremeNumbersGiveDirections) {
    for (const Lobe& lobe : lobes())
        for (const float u : {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f})
            for (const float v : {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f}) {
                const auto s = kernels::sample_glossy<V>(narrow3(lobe.r), narrow3(lobe.n), narrow(lobe.cosine),
                                                         narrow(lobe.beta), u, v);
                EXPECT_NEAR(glm::length(widen(s.direction)), 1, 4e-7);
                EXPECT_GT(s.pdf, 0.0f);
            }
}

}  // namespace
}  // namespace orrery::kernel_tests
