// Direct light in closed form: against directions sampled in double, from random worlds in which spheres stand before
// the light, beside, behind, around, across and within it, and across the horizon.
#include <cmath>
#include <set>

#include "kernel_test.hpp"
#include "numbers.hpp"
#include "optics_reference.hpp"
#include "owned.hpp"
#include "world.hpp"

namespace orrery::kernel_tests {
namespace {

using glm::dvec3;
using kernels::inside_bit;
using kernels::no_sphere;

constexpr std::uint32_t light = 0;  ///< sphere and light alike

struct Place {
    dvec3 p, n;
    std::uint32_t departed;
};

/// What the kernel sees of a vertex.
Place place_of(const World& world, const Rays& rays, std::uint32_t i) {
    const std::uint32_t departed = rays->departed[i], id = departed & no_sphere;
    const dvec3 p = origin_of(*rays, i), outward = glm::normalize(p - world.centre(id));
    return {p, departed == id ? outward : -outward, departed};
}

/// Whether the light is seen along `d`, which meets it.
bool sees_light(const World& world, const Place& at, const dvec3& d) {
    const auto chord = [&](std::uint32_t k, double& b, double& c) {
        const dvec3 f = world.centre(k) - at.p;
        b = glm::dot(f, d), c = glm::dot(f, f) - world.radius(k) * world.radius(k);
        const dvec3 across = f - b * d;
        return world.radius(k) * world.radius(k) - glm::dot(across, across);
    };
    double b = 0, c = 0;
    const double t = std::max(chord(light, b, c), 0.0), end = b - std::sqrt(t);
    for (std::uint32_t k = 0; k < world.spheres.count; ++k) {
        if (k == light || at.departed == k) continue;
        const double square = chord(k, b, c);
        if (at.departed == (k | inside_bit)) {
            if (2 * b < end) return false;
        } else if (c <= 0) {
            if (b + std::sqrt(std::max(square, 0.0)) < end) return false;
        } else if (square > 0 && b > 0 && b - std::sqrt(square) < end) {
            return false;
        }
    }
    return true;
}

/// The light as a cap of directions.
struct Cap {
    dvec3 axis;
    double sine, one_minus_cosine;
    Cap(const World& world, const dvec3& p) : axis(world.centre(light) - p), sine(0), one_minus_cosine(0) {
        const double distance = glm::length(axis);
        axis /= distance;
        sine = world.radius(light) / distance;
        one_minus_cosine = sine * sine / (1 + std::sqrt(std::max(0.0, 1 - sine * sine)));
    }
};

/// Irradiance over pi of what is seen of a light of radiance 1, by one direction in each of side x side cells.
double sampled(const World& world, const Place& at, const Cap& cap, int side, Numbers& random) {
    const Frame frame(cap.axis, at.n);
    double sum = 0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const double x = cap.one_minus_cosine * (i + random.uniform()) / side;
            const double phi = 2 * pi * (j + random.uniform()) / side, across = std::sqrt(x * (2 - x));
            const dvec3 d = (1 - x) * frame.axis + across * (std::cos(phi) * frame.x + std::sin(phi) * frame.y);
            const double cosine = glm::dot(d, at.n);
            if (cosine > 0 && sees_light(world, at, d)) sum += cosine;
        }
    return sum * 2 * cap.one_minus_cosine / (side * side);
}

/// A light of any size, a floor, and spheres anywhere, some of them on purpose where it is hard.
World hard_world(Numbers& random) {
    std::vector<Ball> balls;
    const double radius = std::exp2(random.between(-6, 0.5));
    const dvec3 lamp = {0, 2 + random.uniform(), 0};
    balls.push_back({lamp, radius, 0, 0});
    const double floor = std::exp2(random.between(1, 16));
    balls.push_back({dvec3(0, -floor, 0), floor});
    const std::uint32_t count = random.below(6);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double r = std::exp2(random.between(-3, 1));
        switch (random.below(8)) {
            case 0:  // touches the light
                balls.push_back({lamp + (radius + r) * random.direction(), r});
                break;
            case 1:  // intersects it
                balls.push_back({lamp + (radius + r * random.between(-0.9, 0.9)) * random.direction(), r});
                break;
            case 2:  // around it
                balls.push_back({lamp + 0.5 * r * random.direction(), radius + r});
                break;
            case 3:  // within it
                balls.push_back({lamp + 0.3 * radius * random.direction(), 0.5 * radius});
                break;
            case 4: {  // a wall
                const double wall = std::exp2(random.between(4, 14));
                balls.push_back({lamp + (radius + wall + random.uniform()) * random.direction(), wall});
                break;
            }
            default:
                balls.push_back({random.uniform() * lamp + random.point(1), r * 0.3});
        }
    }
    return World(balls, {Surface{}}, {{1, 1, 1}});
}

/// Vertices on all spheres and both sides, with throughputs 1; every seventh is dead.
void put_vertices(const World& world, const Rays& rays, std::uint32_t begin, std::uint32_t count, Numbers& random) {
    for (std::uint32_t i = begin; i < begin + count; ++i) {
        const std::uint32_t k = random.below(world.spheres.count);
        dvec3 outward = random.direction();
        // Of what is large the part near the light.
        if (world.radius(k) > 4) {
            const dvec3 near = world.centre(light) + random.point(3) - world.centre(k);
            outward = glm::normalize(near);
        }
        const bool inward = random.below(4) == 0;
        put_ray(*rays, i, world.centre(k) + world.radius(k) * outward, random.direction(), inward ? k | inside_bit : k,
                i % 7 == 6 ? dvec3(0) : dvec3(1));
        rays->slot[i] = i;
    }
}

struct Outcome {
    std::vector<double> got;  ///< by vertex
    std::set<std::uint32_t> aside;
};

class Exact : public KernelTest {
protected:
    static constexpr std::uint32_t begin = 32;

    kernels::ConnectContext<float> context(const World& world, const Slots& slots) const {
        return {world.spheres, world.materials, world.lights, *slots, 1, 0, kernels::LightStrategy::exact, true};
    }
    /// Runs the stage, checks what it touches and that fused instruction sets agree.
    Outcome run(const World& world, const Rays& rays, std::uint32_t count) const {
        const std::uint32_t capacity = kernels::padded_run(begin + count);
        Slots slots(capacity);
        for (std::uint32_t s = 0; s < 4 * capacity; ++s) slots->radiance[s] = 0;
        Slots same = slots;
        Rays aside(capacity, {"dx", "dy", "dz", "pdf", "roulette_scale"}), other = aside;
        const Rays before = rays, blank = aside;
        const std::uint32_t size = stages.exact(context(world, slots), 0, {begin, count}, *rays, *aside);
        EXPECT_TRUE(rays.same_as(before, -Rays::guard, rays.capacity() + Rays::guard)) << "only read";
        EXPECT_TRUE(aside.untouched_but(blank, 0, static_cast<std::ptrdiff_t>(size) + kernels::widest - 1));
        if (exact()) {
            EXPECT_EQ(scalar.exact(context(world, same), 0, {begin, count}, *rays, *other), size);
            EXPECT_TRUE(slots.same_as(same, 0, capacity));
            EXPECT_TRUE(aside.same_as(other, 0, size));
        }
        Outcome out;
        for (std::uint32_t i = 0; i < count; ++i) out.got.push_back(slots->radiance[4 * (begin + i)]);
        for (std::uint32_t at = 0; at < size; ++at) {
            const std::uint32_t i = aside->slot[at];
            EXPECT_TRUE(out.aside.insert(i).second) << "twice";
            EXPECT_EQ(origin_of(*aside, at), origin_of(*rays, i));
            EXPECT_EQ(throughput_of(*aside, at), throughput_of(*rays, i));
            EXPECT_EQ(aside->departed[at], rays->departed[i]);
            EXPECT_EQ(aside->pixel[at], rays->pixel[i]);
            EXPECT_EQ(aside->sample[at], rays->sample[i]);
            EXPECT_EQ(out.got[i - begin], 0) << "it has had its light";
        }
        return out;
    }
};

// The closed form against two independent estimates: its squared distance from their mean is that of either, on
// average, if and only if it is what they estimate.
TEST_P(Exact, AgreesWithSampledDirections) {
    Numbers random(7);
    constexpr std::uint32_t count = 40;
    double squares = 0, expected = 0, sum = 0;
    std::uint32_t known = 0, dark = 0, part = 0, aside = 0, within = 0, live = 0;
    for (int trial = 0; trial < 6000; ++trial) {
        const World world = hard_world(random);
        const Rays rays(kernels::padded_run(begin + count));
        put_vertices(world, rays, begin, count, random);
        const Outcome out = run(world, rays, count);
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            if (throughput_of(*rays, i) == dvec3(0)) {
                ASSERT_EQ(out.got[i - begin], 0);
                ASSERT_FALSE(out.aside.contains(i)) << "a dead ray";
                continue;
            }
            ++live;
            const Place at = place_of(world, rays, i);
            const std::uint32_t id = at.departed & no_sphere;
            const Cap cap(world, at.p);
            const bool inside = id == light ? at.departed != id : cap.sine >= 1;
            within += inside;
            if (std::abs(cap.sine - 1) > 1e-5 || id == light) {
                ASSERT_LE(inside, out.aside.contains(i)) << "from inside the light nothing is known";
            }
            aside += out.aside.contains(i);
            if (out.aside.contains(i) || cap.sine >= 1) continue;
            if (id == light) {
                ASSERT_EQ(out.got[i - begin], 0) << "a sphere does not shine on its own outside";
                continue;
            }
            const double whole = cap.sine * cap.sine, got = out.got[i - begin];
            const double a = sampled(world, at, cap, 12, random), b = sampled(world, at, cap, 12, random);
            const double apart = ((a + b) / 2 - got) / whole;
            ASSERT_LT(std::abs(apart), 0.12)
                << "trial " << trial << ", vertex " << i << ": " << got << ", not " << (a + b) / 2;
            ++known;
            dark += got == 0;
            const double open = whole * std::max(0.0, glm::dot(cap.axis, at.n));
            part += got > 0 && std::abs(got - open) > 1e-4 * whole;
            squares += apart * apart;
            sum += apart;
            expected += (a - b) * (a - b) / (4 * whole * whole);
        }
    }
    EXPECT_GT(known, 100000u);
    EXPECT_GT(part, 4000u);
    EXPECT_GT(dark, 20000u);
    EXPECT_GT(within, 4000u);
    EXPECT_LT(aside - within, live / 8) << "what is known is no exception";
    EXPECT_NEAR(squares / expected, 1, 0.12);
    EXPECT_LT(std::abs(sum), 4.5 * std::sqrt(expected)) << "no bias";
}

/// The boundary integral of a cap of half angle s about `a` of which what lies within a cap of half angle t about `b`
/// is taken away, in long double, from arcs.
double left_over(const dvec3& a, double sin_s, const dvec3& b, double sin_t, const dvec3& n) {
    using Wide = long double;
    const auto dot = [](const dvec3& x, const dvec3& y) { return Wide{x.x} * y.x + Wide{x.y} * y.y + Wide{x.z} * y.z; };
    const Wide s = std::asin(Wide{sin_s}), t = std::asin(Wide{sin_t});
    const dvec3 across = glm::cross(a, b);
    const Wide g = std::atan2(std::sqrt(dot(across, across)), dot(a, b));
    if (g >= s + t) return static_cast<double>(std::sin(s) * std::sin(s) * dot(a, n));
    if (g + s <= t) return 0;
    // Half the arc of a circle of half angle x that lies within another.
    const auto half_arc = [&](Wide x, Wide y) {
        const Wide u = std::sin((y - x + g) / 2) * std::sin((y + x - g) / 2) / (std::sin(x) * std::sin(g));
        return 2 * std::asin(std::sqrt(std::clamp(u, Wide{0}, Wide{1})));
    };
    const auto part = [&](Wide phi) { return (phi - std::sin(phi) * std::cos(phi)) / std::numbers::pi_v<Wide>; };
    return static_cast<double>(std::sin(s) * std::sin(s) * dot(a, n) * (1 - part(half_arc(s, t))) -
                               std::sin(t) * std::sin(t) * dot(b, n) * part(half_arc(t, s)));
}

// One sphere before the light, or the horizon: what floats are wrong by, against the light's whole, is what moving the
// spheres by a rounding does. Lights and spheres from 1e-6 of the distance on.
TEST_P(Exact, KeepsItsDigitsAtAnyScale) {
    Numbers random(11);
    constexpr std::uint32_t count = 1;
    std::uint32_t judged = 0;
    double worst = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const double distance = std::exp2(random.between(-3, 8)), size = std::exp2(random.between(-20, -0.6));
        const bool occluded = trial % 4 != 0;
        const dvec3 up(0, 1, 0);
        dvec3 to = random.direction();
        if (occluded) to.y = std::abs(to.y) + size;
        if (!occluded) to.y = size * random.between(-1, 1);
        to = glm::normalize(to);
        std::vector<Ball> balls{{distance * to, distance * size, 0, 0}, {dvec3(0, -1, 0), 1}};
        if (occluded) {
            const double nearer = distance * random.between(0.1, 0.7);
            const double radius = nearer * std::min(0.9, size * std::exp2(random.between(-2, 6)));
            const double off = nearer * size * random.between(0, 2) + radius * random.between(0.8, 1.1);
            const dvec3 aside = glm::normalize(glm::cross(to, random.direction()));
            balls.push_back({nearer * to + off * aside, radius});
            if (glm::length(balls[2].centre) < 1.01 * radius) continue;
            // Apart, and from a plane between them the vertex is on the occluder's side.
            const dvec3 between = balls[0].centre - balls[2].centre;
            const double gap = glm::length(between) - radius - balls[0].radius;
            if (gap < 1e-3 * (radius + balls[0].radius)) continue;
            if (glm::dot(balls[2].centre, between) / glm::length(between) + radius < 0) continue;
        }
        const World world(balls, {Surface{}}, {{1, 1, 1}});
        const Rays rays(kernels::padded_run(begin + count));
        for (std::uint32_t i = begin; i < begin + count; ++i) {
            put_ray(*rays, i, {0, 0, 0}, up, 1);
            rays->slot[i] = i;
        }
        const Outcome out = run(world, rays, count);
        if (out.aside.contains(begin)) continue;
        const double lamp_distance = glm::length(world.centre(0)), sine = world.radius(0) / lamp_distance;
        const dvec3 axis = world.centre(0) / lamp_distance;
        if (glm::dot(axis, up) < sine && occluded) continue;
        double wanted = 0, rounding = 0x1p-24 / sine;
        if (occluded) {
            const double nearer = glm::length(world.centre(2));
            wanted = left_over(axis, sine, world.centre(2) / nearer, world.radius(2) / nearer, up);
            // How near to the occluder's surface the vertex is, floats know less well.
            const double height = nearer - world.radius(2);
            rounding *= 1 + nearer / height;
        } else {
            wanted = left_over(axis, sine, -up, 1, up);
        }
        const double error = std::abs(out.got[0] - wanted) / (sine * sine);
        worst = std::max(worst, error / (rounding + 0x1p-22));
        ++judged;
    }
    EXPECT_GT(judged, 12000u);
    EXPECT_LT(worst, 8);
}

// A light that touches the vertex's own surface, is half under it, or holds the vertex.
TEST_P(Exact, NearTheLight) {
    for (const double gap : {0.0, 1e-6, 1e-3, -0.3, 0.5}) {
        const World world({{dvec3(0, 0.5 + gap, 0), 0.5, 0, 0}, {dvec3(0, -1000, 0), 1000}}, {Surface{}}, {{1, 1, 1}});
        Numbers random(3);
        const Rays rays(kernels::padded_run(begin + 64));
        for (std::uint32_t i = begin; i < begin + 64; ++i) {
            const double reach = std::exp2(random.between(-12, 2)), turn = 2 * pi * random.uniform();
            const dvec3 to = {reach * std::cos(turn), 0, reach * std::sin(turn)};
            put_ray(*rays, i, dvec3(0, -1000, 0) + 1000.0 * glm::normalize(to + dvec3(0, 1000, 0)), to, 1);
            rays->slot[i] = i;
        }
        const Outcome out = run(world, rays, 64);
        for (std::uint32_t i = begin; i < begin + 64; ++i) {
            const Place at = place_of(world, rays, i);
            const Cap cap(world, at.p);
            if (out.aside.contains(i)) {
                EXPECT_GT(cap.sine, 1 - 1e-4) << "known but for what is within";
                continue;
            }
            const double wanted = glm::dot(cap.axis, at.n) >= cap.sine ? cap.sine * cap.sine * glm::dot(cap.axis, at.n)
                                  : glm::dot(cap.axis, at.n) <= -cap.sine
                                      ? 0
                                      : left_over(cap.axis, cap.sine, -at.n, 1, at.n);
            EXPECT_NEAR(out.got[i - begin], wanted, 2e-4) << gap << ", sine " << cap.sine;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Isas, Exact, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
