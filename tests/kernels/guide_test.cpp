// Directions guided to spots: the density they are weighed by is that of a textbook's mixture, has an integral of 1,
// and is that with which they are drawn.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "fit.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "optics_reference.hpp"
#include "owned.hpp"
#include "plan/guide.hpp"
#include "statistics/distributions.hpp"
#include "world.hpp"

namespace orrery::kernel_tests {
namespace {

using glm::dvec3;

/// Balls and point lights about a vertex at the origin with normal +y, on top of primitive 0.
Scene setting(const std::vector<Ball>& balls, const std::vector<dvec3>& lamps) {
    Scene scene;
    scene.materials.push_back({});
    scene.materials[0].rho = dvec3{0.5};
    for (const Ball& ball : balls) {
        Primitive p;
        p.centre = ball.centre, p.radius = ball.radius;
        scene.primitives.push_back(p);
    }
    for (const dvec3& lamp : lamps) scene.point_lights.push_back({"", lamp, dvec3{1}});
    return scene;
}

struct Case {
    std::string name;
    std::vector<Ball> balls;
    std::vector<dvec3> lamps;
};

std::vector<Case> cases() {
    const Ball own{{0, -1, 0}, 1};
    std::vector<Case> list = {
        {"one ball", {own, {{3, 2, 1}, 1}}, {{2, 2.8, 0}}},
        {"from beside", {own, {{3, 1, 1}, 1}}, {{2, 2.2, 1}}},
        {"lamp between", {own, {{3, 1, 1}, 1}}, {{1.5, 0.6, 0.4}}},
        {"walls", {{{0, -500, 0}, 500}, {{503, 0, 0}, 500}, {{0, 0, 504}, 500}}, {{2.5, 2, 1}, {-1, 2, 3.2}}},
        {"lamp afar", {own, {{3, 1, 1}, 1}}, {{3 - 1e3, 1 + 2e3, 1 - 1e3}}},
        {"lamp very far", {own, {{3, 1, 1}, 1}}, {{3 - 1e7, 1 + 2e7, 1 - 1e7}}},
        {"far away", {own, {{24, 18, 1}, 1}}, {{22.8, 18.8, 0}}},
        {"beside the spot", {own, {{0.5, 0.1, 0}, 0.4}}, {{0, 0.45, 0.1}}},
    };
    Numbers random(5);
    for (int i = 0; i < 6; ++i) {
        Case some{"random " + std::to_string(i), {own}, {}};
        for (int k = 0; k < 3; ++k) {
            // The lamp on the side that the vertex sees.
            dvec3 at = random.point(4);
            at.y = std::abs(at.y) + 0.5;
            const double radius = random.between(0.4, 1.5);
            const dvec3 up = glm::normalize(random.direction() - 1.2 * glm::normalize(at));
            some.balls.push_back({at, radius});
            some.lamps.push_back(at + up * radius * random.between(1.05, 2.5));
        }
        list.push_back(some);
    }
    return list;
}

/// As kernels/guide.hpp has it in words.
class Mixture {
public:
    Mixture(const Scene& scene, const std::vector<PlannedSpot>& spots) {
        double brightest = 0;
        for (const PlannedSpot& s : spots) {
            Spot spot{scene.primitives[s.ball].centre, s.lamp, scene.primitives[s.ball].radius, 0};
            const dvec3 up = glm::normalize(spot.lamp - spot.centre), v = spot.centre + spot.radius * up;
            const double w = s.width, d = glm::length(v);
            const double light = s.power * std::max(0.0, v.y + w) * std::max(0.0, w - glm::dot(v, up)) /
                                 ((d + w) * (d + w) * (d * d + w * w));
            if (s.ball == 0 || glm::length(spot.centre) < spot.radius) continue;
            spot.weight = light * std::pow(d * d / (d * d + 4 * w * w), 2);
            brightest += light;
            spots_.push_back(spot);
        }
        std::erase_if(spots_, [&](const Spot& s) { return s.weight <= brightest / 1024; });
        for (const Spot& s : spots_) sum_ += s.weight;
        guided_ = brightest > 0 ? sum_ / brightest / 2 : 0;
    }
    double guided() const { return guided_; }
    /// Of the spots alone, over all directions.
    double of_spots(const dvec3& d) const {
        double all = 0;
        for (std::size_t k = 0; k < spots_.size(); ++k) all += spots_[k].weight / sum_ * of_spot(k, d);
        return all;
    }
    /// Over the directions to its ball. The sine off the axis, in that of the ball's outline, is a sine itself: so the
    /// outline, where the density has no bound, is like any other place.
    double integral_of_spot(std::size_t k) const {
        constexpr int rows = 400, columns = 800;
        const double distance = glm::length(spots_[k].centre);
        const bool outside = distance > spots_[k].radius;
        const double outline = outside ? spots_[k].radius / distance : 1;
        const Frame frame(spots_[k].centre / distance, {0, 1, 0});
        double sum = 0;
        for (int r = 0; r < rows; ++r) {
            const double psi = (r + 0.5) / rows * (outside ? pi / 2 : pi), sine = outline * std::sin(psi);
            const double theta = outside ? std::asin(sine) : psi;
            const double stretch = outside ? outline * std::cos(psi) / std::cos(theta) : 1;
            for (int c = 0; c < columns; ++c)
                sum += sine * stretch * of_spot(k, frame.at(theta, 2 * pi * (c + 0.5) / columns));
        }
        return sum * (outside ? pi / 2 : pi) * 2 * pi / rows / columns;
    }
    std::size_t size() const { return spots_.size(); }
    double density(const dvec3& d) const {
        return (1 - guided_) * std::max(0.0, d.y) / pi + (guided_ > 0 ? guided_ * of_spots(d) : 0);
    }

    /// Where a float's direction may lie on the other side of a ball's outline.
    bool is_at_an_outline(const dvec3& d) const {
        return std::ranges::any_of(spots_, [&](const Spot& s) {
            const double b = glm::dot(s.centre, d), distance2 = glm::dot(s.centre, s.centre);
            const double disc = (b * b - distance2) / (s.radius * s.radius) + 1;
            return std::abs(disc) < 1e-4 * std::max(1.0, std::sqrt(distance2) / s.radius);
        });
    }

private:
    double of_spot(std::size_t k, const dvec3& d) const {
        const Spot& s = spots_[k];
        const double b = glm::dot(s.centre, d);
        const double disc = b * b - glm::dot(s.centre, s.centre) + s.radius * s.radius;
        if (disc <= 0) return 0;
        const double sine = s.radius / glm::length(s.centre - s.lamp);
        const double angle = 2 * pi * sine * sine / (1 + std::sqrt(1 - sine * sine));
        double all = 0;
        for (const double t : {b - std::sqrt(disc), b + std::sqrt(disc)}) {
            const dvec3 y = t * d, n = (y - s.centre) / s.radius, g = s.lamp - y;
            const double cos_g = glm::dot(n, glm::normalize(g));
            if (t > 0 && cos_g > 0) all += cos_g / glm::dot(g, g) / angle * t * t / std::abs(glm::dot(n, d));
        }
        return all;
    }

    struct Spot {
        dvec3 centre, lamp;
        double radius, weight;
    };
    std::vector<Spot> spots_;
    double sum_ = 0, guided_ = 0;
};

class Guide : public KernelTest {};

TEST_P(Guide, DrawsDirectionsAsTheyAreWeighed) {
    constexpr std::uint32_t batch = 4096, batches = 64;
    constexpr std::size_t side = 16;
    for (const Case& c : cases()) {
        const Scene scene = setting(c.balls, c.lamps);
        const auto spots = plan_spots(scene, true, false);
        std::vector<std::uint32_t> place(scene.primitives.size());
        for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
        const SpotColumns<float> columns(scene, {}, spots, place);
        const Mixture mixture(scene, spots);
        const World world(c.balls);
        const Slots slots(16);
        double sums[side * side] = {}, squares[side * side] = {};
        std::uint32_t judged = 0;
        for (std::uint32_t b = 0; b < batches; ++b) {
            const Rays rays(batch);
            for (std::uint32_t i = 0; i < batch; ++i) {
                put_ray(*rays, i, dvec3(0), {0, 1, 0}, 0);
                rays->pixel[i] = b * batch + i;
            }
            stages.guide({world.spheres, *slots, columns.table(), 3, 1, true}, {0, batch}, *rays);
            for (std::uint32_t i = 0; i < batch; ++i) {
                const double factor = static_cast<double>(rays->tr[i]);
                const dvec3 d = glm::normalize(direction_of(*rays, i));
                if (d.y > 1e-3) {
                    EXPECT_NEAR(rays->pdf[i], d.y / pi, 1e-5);
                }
                if (factor > 0) {
                    EXPECT_EQ(rays->roulette_scale[i], rays->tr[i]);
                }
                if (d.y > 1e-3 && !mixture.is_at_an_outline(d)) {
                    ++judged;
                    ASSERT_NEAR(factor * pi * mixture.density(d) / d.y, 1, 0.003) << c.name;
                }
                if (factor <= 0) continue;
                // The square of the sine and the azimuth are uniform in the cosine lobe.
                const auto cell = [](double x) {
                    return std::min(static_cast<std::size_t>(std::max(x, 0.0) * side), side - 1);
                };
                const std::size_t at = cell(1 - d.y * d.y) * side + cell(std::atan2(d.z, d.x) / (2 * pi) + 0.5);
                sums[at] += factor, squares[at] += factor * factor;
            }
        }
        EXPECT_GT(judged, batch * batches / 2) << c.name;
        double chi2 = 0, sum = 0, square = 0;
        constexpr double share = static_cast<double>(batch) * batches / (side * side);
        for (std::size_t k = 0; k < side * side; ++k) chi2 += (sums[k] - share) * (sums[k] - share) / squares[k];
        EXPECT_GT(statistics::chi_square_upper_tail(chi2, side * side), significance) << c.name << ": " << chi2;
        for (std::size_t k = 0; k < side * side; ++k) sum += sums[k], square += squares[k];
        constexpr double all = static_cast<double>(batch) * batches;
        EXPECT_LT(std::abs(sum - all), 5 * std::sqrt(square - sum * sum / all)) << c.name;
        EXPECT_GT(mixture.guided(), 0.001) << c.name;
    }
}

// Many directions are drawn to the outline of a far ball, where a chord has no digits left: what they carry must not be
// weighed by one that is lost, since there is next to no light in so thin a ring.
TEST_P(Guide, OutlinesCarryNoMoreThanTheirShare) {
    constexpr std::uint32_t count = 1 << 18;
    constexpr double thin = 1e-4;
    const std::vector<Ball> balls = {{{0, -1, 0}, 1}, {{24, 18, 1}, 1}};
    const Scene scene = setting(balls, {{22.8, 18.8, 0}, {23, 17, 0}});
    const SpotColumns<float> columns(scene, {}, plan_spots(scene, true, false), {0, 1});
    const World world(balls);
    const Slots slots(16);
    const Rays rays(count);
    for (std::uint32_t i = 0; i < count; ++i) put_ray(*rays, i, dvec3(0), {0, 1, 0}, 0);
    for (std::uint32_t i = 0; i < count; ++i) rays->pixel[i] = i;
    stages.guide({world.spheres, *slots, columns.table(), 3, 1, true}, {0, count}, *rays);
    const double distance2 = glm::dot(balls[1].centre, balls[1].centre);
    double carried = 0;
    std::uint32_t near = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const dvec3 d = glm::normalize(direction_of(*rays, i));
        const double b = glm::dot(d, balls[1].centre);
        if (std::abs(b * b - distance2 + 1) > thin) continue;
        carried += static_cast<double>(rays->tr[i]), ++near;
    }
    EXPECT_GT(near, 100u);
    // The cosine lobe's share of the ring, and as much again for chance.
    EXPECT_LT(carried / count, 2 * 2 * thin / distance2);
}

TEST(GuideDensity, IntegratesToOne) {
    for (const Case& c : cases()) {
        const Scene scene = setting(c.balls, c.lamps);
        const Mixture mixture(scene, plan_spots(scene, true, false));
        for (std::size_t k = 0; k < mixture.size(); ++k)
            EXPECT_NEAR(mixture.integral_of_spot(k), 1, 0.005) << c.name << ", spot " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, Guide, testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
