// Fresnel, Snell and the rough cone, each against numbers that do not come from this code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "reference/optics.hpp"
#include "reference/small_scenes.hpp"
#include "statistics/goodness_of_fit.hpp"

namespace orrery::reference {
namespace {

using glm::dvec3;
using std::numbers::pi;

TEST(Fresnel, MatchesKnownValues) {
    EXPECT_NEAR(fresnel(1, 1.5), 0.04, 1e-15);
    EXPECT_NEAR(fresnel(1, 1 / 1.5), 0.04, 1e-15);
    EXPECT_NEAR(fresnel(0.3, 1), 0, 1e-15);
    // At 45 degrees the p reflectance is the square of the s reflectance.
    const double root = std::sqrt(1.5 * 1.5 - 0.5), half = std::sqrt(0.5);
    const double s = std::pow((half - root) / (half + root), 2);
    EXPECT_NEAR(fresnel(half, 1.5), (s + s * s) / 2, 1e-14);
    // At Brewster's angle only s is reflected, ((n^2 - 1) / (n^2 + 1))^2 of it.
    EXPECT_NEAR(fresnel(std::cos(std::atan(1.5)), 1.5), std::pow(1.25 / 3.25, 2) / 2, 1e-14);
    EXPECT_NEAR(fresnel(1e-9, 1.5), 1, 1e-8);
}

TEST(Fresnel, ReflectsTotallyBeyondTheCriticalAngle) {
    const double critical = std::asin(1 / 1.5);
    EXPECT_EQ(fresnel(std::cos(critical + 1e-6), 1 / 1.5), 1);
    EXPECT_LT(fresnel(std::cos(critical - 1e-6), 1 / 1.5), 1);
}

TEST(Snell, BendsTowardsTheNormalInTheDenserMedium) {
    const dvec3 normal{0, 0, 1};
    const dvec3 incoming = glm::normalize(dvec3{3, 4, -5});  // 45 degrees
    const auto into = lobes_of(glass(1, 1.5), incoming, normal, false);
    const double sine = std::sqrt(0.5) / 1.5;
    const dvec3 expected{0.6 * sine, 0.8 * sine, -std::sqrt(1 - sine * sine)};
    EXPECT_LT(glm::length(into[1].axis - expected), 1e-14);
    EXPECT_LT(glm::length(into[0].axis - glm::normalize(dvec3{3, 4, 5})), 1e-14);

    // Back the same way: from inside, with the same eta, the ray leaves as it came. The radiance factors cancel.
    const auto out = lobes_of(glass(1, 1.5), -into[1].axis, -normal, true);
    EXPECT_LT(glm::length(out[1].axis + incoming), 1e-14);
    EXPECT_NEAR(into[1].weight.x / into[1].probability, 1 / 2.25, 1e-14);
    EXPECT_NEAR(out[1].weight.x / out[1].probability, 2.25, 1e-14);
    EXPECT_NEAR(out[0].probability, into[0].probability, 1e-14);
}

TEST(Snell, NothingIsTransmittedUnderTotalReflection) {
    const auto lobes = lobes_of(glass(1, 1.5), glm::normalize(dvec3{2, 0, -1}), {0, 0, 1}, true);
    EXPECT_EQ(lobes[0].probability, 1);
    EXPECT_EQ(lobes[1].probability, 0);
    EXPECT_EQ(lobes[1].weight, dvec3{0});
}

// Directions by rejection, counted in cells of (angle from R) x (azimuth about R), against the integral of the density.
void expect_density_is_that_of_the_sampler(double roughness, double cosine) {
    constexpr std::size_t rings = 16, sectors = 12;
    constexpr int draws = 200000, steps = 64;
    const double widest = std::asin(roughness);
    const dvec3 side{0, 0, 1};
    const Lobe lobe{1, dvec3{1}, {std::sqrt(1 - cosine * cosine), 0, cosine}, side};
    const dvec3 up = {-lobe.axis.z, 0, lobe.axis.x}, across{0, 1, 0};

    std::vector<std::uint64_t> counted(rings * sectors);
    Random random(3, 7);
    for (int i = 0; i < draws; ++i) {
        const dvec3 d = sample_lobe(lobe, roughness, random);
        ASSERT_GT(glm::dot(d, side), 0);
        const double x = glm::dot(d, up), y = glm::dot(d, across);
        const double ring = std::asin(std::min(1.0, std::hypot(x, y))) / widest;
        const double sector = std::atan2(y, x) / (2 * pi) + 0.5;
        ++counted[std::min(rings - 1, static_cast<std::size_t>(ring * rings)) * sectors +
                  std::min(sectors - 1, static_cast<std::size_t>(sector * sectors))];
    }

    // sin(theta) = beta sin(u) takes the singularity at the rim away: the midpoint rule then converges.
    std::vector<double> expected(rings * sectors);
    for (std::size_t ring = 0; ring < rings; ++ring) {
        const auto bound = [&](std::size_t i) {
            return std::asin(std::min(1.0, std::sin(widest * static_cast<double>(i) / rings) / roughness));
        };
        const double low = bound(ring), step = (bound(ring + 1) - low) / steps;
        for (std::size_t sector = 0; sector < sectors; ++sector) {
            for (int i = 0; i < steps * steps; ++i) {
                const double u = low + (i % steps + 0.5) * step;
                const double azimuth =
                    2 * pi * ((static_cast<double>(sector) + (i / steps + 0.5) / steps) / sectors - 0.5);
                const double sine = roughness * std::sin(u), cosine_theta = std::sqrt(1 - sine * sine);
                const dvec3 d = cosine_theta * lobe.axis + sine * (std::cos(azimuth) * up + std::sin(azimuth) * across);
                const double solid_angle =  // sin(theta) dtheta dazimuth
                    sine * roughness * std::cos(u) / cosine_theta * step * 2 * pi / sectors / steps;
                expected[ring * sectors + sector] += draws * lobe_density(lobe, roughness, d) * solid_angle;
            }
        }
    }
    // What the tangent plane cuts across, the midpoint rule gets right to 10^-3; the test must not see that.
    double total = 0;
    for (const double e : expected) total += e;
    EXPECT_NEAR(total / draws, 1, 1e-3);
    for (double& e : expected) e *= draws / total;
    const statistics::GoodnessOfFit fit = statistics::chi_square_test(counted, expected);
    EXPECT_GT(fit.p_value, 1e-3) << "roughness " << roughness << ", cosine " << cosine << ": chi-square "
                                 << fit.statistic << " at " << fit.degrees << " degrees";
}

TEST(RoughLobe, DensityIsThatOfTheRejectionSampler) {
    for (const double roughness : {0.1, 0.4, 0.95}) {
        for (const double cosine : {1.0, 0.7, 0.2, 0.02}) expect_density_is_that_of_the_sampler(roughness, cosine);
    }
}

TEST(RoughLobe, DensityEndsAtTheConeAndAtTheSurface) {
    const Lobe grazing{1, dvec3{1}, glm::normalize(dvec3{1, 0, 0.1}), {0, 0, 1}};
    EXPECT_EQ(lobe_density(grazing, 0.4, glm::normalize(dvec3{1, 0, -0.01})), 0);
    EXPECT_GT(lobe_density(grazing, 0.4, glm::normalize(dvec3{1, 0, 0.01})), 0);
    EXPECT_EQ(lobe_density(grazing, 0.4, glm::normalize(dvec3{1, 0, 1})), 0);
    EXPECT_EQ(lobe_density(grazing, 0.4, -grazing.axis), 0);
}

}  // namespace
}  // namespace orrery::reference
