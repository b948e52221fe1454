// Directions that `scatter` draws against their densities: cosine lobe, glossy and translucent lobes with the side they
// are conditioned on, and how often a dielectric reflects.
#include <functional>

#include "fit.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "optics_reference.hpp"
#include "owned.hpp"
#include "world.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::no_sphere;
using kernels::Scattering;

/// Many rays that arrive at one point at one angle.
struct Arrival {
    glm::dvec3 normal = glm::normalize(glm::dvec3(1, -2, 2));
    double angle = 0;  ///< to the normal
    bool inside = false;
    glm::dvec3 direction() const { return -Frame(normal, {0, 1, 0}).at(angle, 0.4); }
};

class ScatterSampling : public KernelTest {
protected:
    /// Calls `visit(direction, reflected)` with what becomes of `count` such rays.
    void scatter_many(const Surface& surface, const Arrival& at, std::uint32_t count,
                      const std::function<void(const glm::dvec3&, bool reflected)>& visit) const {
        constexpr std::uint32_t batch = 4096;
        const World world({{glm::dvec3(0), 1}}, {surface});
        const Slots slots(16);
        const Rays arriving(batch, {"roulette_scale"});
        const Hits hits(batch);
        const Lobes lobes(batch);
        const double distance = at.inside ? std::cos(at.angle) : 1.0;
        const glm::dvec3 point = at.inside ? -at.normal : at.normal;  // `normal` is on the side the ray arrives at
        for (std::uint32_t i = 0; i < batch; ++i) {
            put_ray(*arriving, i, point - distance * at.direction(), at.direction());
            hits->t[i] = narrow(distance);
            hits->id[i] = at.inside ? kernels::inside_bit : 0;
        }
        for (std::uint32_t first = 0; first < count; first += batch) {
            const Rays rays = arriving;
            for (std::uint32_t i = 0; i < batch; ++i)
                rays->pixel[i] = (first + i) / 64, rays->sample[i] = (first + i) % 64;
            stages.scatter[static_cast<std::size_t>(surface.kind)]({world.spheres, world.materials, *slots, 3, 1, true},
                                                                   {0, batch}, *rays, *hits, *lobes);
            for (std::uint32_t i = 0; i < batch; ++i)
                visit(glm::normalize(direction_of(*rays, i)),
                      rays->departed[i] == (at.inside ? kernels::inside_bit : 0u));
        }
    }
};

std::string name_of(const Arrival& at, double beta) {
    return "beta " + std::to_string(beta) + " at " + std::to_string(at.angle * 180 / pi) + " degrees" +
           (at.inside ? " from inside" : "");
}

/// A lobe about R conditioned on the side of n, as a histogram: sin theta = beta sin psi makes the edge of the lobe,
/// where the density has no bound, an ordinary cell. The azimuth is 0 towards n.
class LobeHistogram {
public:
    LobeHistogram(const glm::dvec3& lobe, const glm::dvec3& n, double beta)
        : frame_(lobe, n), cosine_(std::max(0.0, glm::dot(lobe, n))), beta_(beta), cells_(24, 16) {}

    void add(const glm::dvec3& direction) {
        const double sine = sine_between(frame_.axis, direction) / beta_;
        // Rounding of float directions is 1e-7 of a radian, in units of beta.
        if (sine > 1 + 1e-6 / beta_ || glm::dot(direction, frame_.axis) < 0) return cells_.add(2, 2);
        cells_.add(frame_.azimuth(direction) / (2 * pi) + 0.5, std::asin(std::min(sine, 1.0)) / (pi / 2));
    }

    /// Share of each cell: the density integrated exactly over the azimuth, whose end at the horizon is known, and by
    /// the midpoint rule over psi, in which it is smooth.
    std::vector<double> shares() const {
        constexpr int steps = 200;
        const std::size_t columns = cells_.columns();
        const double sine_n = std::sqrt(1 - cosine_ * cosine_), rows = static_cast<double>(cells_.rows());
        const double width = 2 * pi / static_cast<double>(columns);
        std::vector<double> all(cells_.rows() * columns);
        for (std::size_t row = 0; row < cells_.rows(); ++row) {
            for (int i = 0; i < steps; ++i) {
                const double psi = (static_cast<double>(row) + (i + 0.5) / steps) / rows * pi / 2;
                const double theta = std::asin(beta_ * std::sin(psi));
                const double cut = std::cos(theta) * cosine_ / std::max(std::sin(theta) * sine_n, 1e-300);
                const double half = cut >= 1 ? pi : std::acos(-cut);
                // p(theta) sin theta dtheta, with dtheta = beta cos psi / cos theta dpsi
                const double density = (std::cos(2 * theta) + beta_ * beta_) / (2 * pi * beta_) * std::tan(theta);
                for (std::size_t column = 0; column < columns; ++column) {
                    const double low = width * static_cast<double>(column) - pi, high = low + width;
                    const double above = std::max(0.0, std::min(high, half) - std::max(low, -half));
                    all[row * columns + column] +=
                        above * density * pi / 2 / rows / steps / lobe_side_probability(cosine_, beta_);
                }
            }
        }
        return all;
    }
    void expect_fits(const std::string& what) const { cells_.expect_fits(shares(), what); }

private:
    Frame frame_;
    double cosine_, beta_;
    Histogram cells_;
};

const double betas[] = {0.01, 0.1, 0.4, 0.9};
const double degrees[] = {0, 45, 80, 89};

TEST_P(ScatterSampling, DiffuseIsCosineDistributed) {
    for (const bool inside : {false, true}) {
        const Arrival at{.angle = 0.5, .inside = inside};
        const Frame frame(at.normal, {0, 0, 1});
        Histogram cells(24, 24);
        scatter_many({Scattering::diffuse}, at, 1u << 20, [&](const glm::dvec3& d, bool) {
            // The square of the sine is uniform.
            cells.add(frame.azimuth(d) / (2 * pi) + 0.5, 1 - glm::dot(d, at.normal) * glm::dot(d, at.normal));
        });
        cells.expect_uniform(inside ? "cosine lobe, inside" : "cosine lobe");
    }
}

TEST_P(ScatterSampling, GlossyLobes) {
    for (const double beta : betas) {
        for (const double angle : degrees) {
            const Arrival at{.angle = angle * pi / 180};
            LobeHistogram cells(mirror(at.direction(), at.normal), at.normal, static_cast<double>(narrow(beta)));
            std::uint32_t below = 0;
            scatter_many({.kind = Scattering::glossy, .beta = beta}, at, 1u << 19, [&](const glm::dvec3& d, bool) {
                cells.add(d);
                below += glm::dot(d, at.normal) < -2e-7;
            });
            EXPECT_EQ(below, 0u) << name_of(at, beta);
            cells.expect_fits("glossy, " + name_of(at, beta));
        }
    }
}

TEST_P(ScatterSampling, TranslucentLobes) {
    std::vector<Arrival> arrivals;
    for (const double angle : degrees) arrivals.push_back({.angle = angle * pi / 180});
    arrivals.push_back({.angle = 30 * pi / 180, .inside = true});
    arrivals.push_back({.angle = 60 * pi / 180, .inside = true});  // total reflection
    for (const double beta : betas) {
        for (const Arrival& at : arrivals) {
            const double eta = at.inside ? 1 / 1.5 : 1.5, wide_beta = static_cast<double>(narrow(beta));
            const double f = fresnel(std::cos(at.angle), eta);
            LobeHistogram reflected(mirror(at.direction(), at.normal), at.normal, wide_beta);
            LobeHistogram transmitted(f < 1 ? refract(at.direction(), at.normal, eta) : -at.normal, -at.normal,
                                      wide_beta);
            constexpr std::uint32_t count = 1u << 18;
            std::uint32_t reflections = 0, astray = 0;
            scatter_many({.kind = Scattering::translucent, .eta = 1.5, .beta = beta}, at, count,
                         [&](const glm::dvec3& d, bool is_reflected) {
                             (is_reflected ? reflected : transmitted).add(d);
                             reflections += is_reflected;
                             astray += glm::dot(d, at.normal) * (is_reflected ? 1 : -1) < -2e-7;
                         });
            EXPECT_EQ(astray, 0u) << "on the other side than `left` says, " << name_of(at, beta);
            reflected.expect_fits("reflected lobe, " + name_of(at, beta));
            if (f < 1) {
                transmitted.expect_fits("transmitted lobe, " + name_of(at, beta));
                EXPECT_LT(std::abs(reflections - f * count), 5.5 * std::sqrt(f * (1 - f) * count)) << name_of(at, beta);
            } else {
                EXPECT_EQ(reflections, count);
            }
        }
    }
}

// |z| <= 5.5 is missed by chance with a probability of 4e-8, as a p-value is below the significance with 1e-7.
TEST_P(ScatterSampling, DielectricsReflectAsOftenAsFresnelSays) {
    for (const bool inside : {false, true}) {
        for (const double angle : {0.0, 20.0, 40.0, 60.0, 80.0, 89.0}) {
            const Arrival at{.angle = angle * pi / 180, .inside = inside};
            const double f = fresnel(std::cos(at.angle), inside ? 1 / 1.5 : 1.5);
            constexpr std::uint32_t count = 1u << 17;
            std::uint32_t reflections = 0;
            scatter_many({.kind = Scattering::dielectric, .eta = 1.5}, at, count,
                         [&](const glm::dvec3&, bool reflected) { reflections += reflected; });
            EXPECT_LE(std::abs(reflections - f * count), 5.5 * std::sqrt(f * (1 - f) * count)) << name_of(at, 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, ScatterSampling, ::testing::ValuesIn(differing_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
