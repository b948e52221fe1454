// The stages for coherent rays: the loop's bytes, from fewer spheres.
#include "geometry.hpp"
#include "kernel_test.hpp"
#include "kernels/packets.hpp"
#include "kernels/tree_packets.hpp"
#include "numbers.hpp"
#include "owned.hpp"
#include "planted.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::no_sphere;

/// Sizes over eight orders of magnitude about a place; the camera is within one here and there.
std::vector<Ball> balls_around(const glm::dvec3& place, std::uint32_t count, std::uint64_t seed, double largest = 1e4) {
    Numbers random(seed);
    std::vector<Ball> balls(count);
    for (Ball& ball : balls) {
        ball.radius = random.scale(1e-4, largest);
        ball.centre = place + random.direction() * (random.between(0.5, 3) * ball.radius + random.scale(1e-2, 1e3));
    }
    return balls;
}

/// The second is so far away that neighbouring floats are 1/128 apart.
constexpr glm::dvec3 places[] = {{0, 0, 0}, {1e5, -1e5, 7e4}};

/// A packet of rays from about one place in about one direction: half of them past the very outline of some sphere,
/// which float rounding may find on either side.
struct Beam {
    double spread;  ///< of the origins
    double angle;   ///< of the directions
};
constexpr Beam single{0,
                      0};  // one ray over and over, so that only the margin for rounding is left between cone and ray
constexpr Beam beams[] = {single,     {0, 1e-6}, {0, 1e-3},  {0, 0.1}, {1e-3, 1e-2},
                          {0.1, 0.3}, {1, 1},    {100, 0.1}, {1, 3.2}};

struct Ray {
    glm::dvec3 o, d;
};
Ray ray_of(const Beam& beam, const Ball& target, const glm::dvec3& eye, Numbers& random) {
    const glm::dvec3 o = eye + random.point(1) * beam.spread;
    const glm::dvec3 to = target.centre - o;
    const double distance = glm::length(to);
    const glm::dvec3 aside = glm::normalize(glm::cross(to, random.direction()));
    const double graze = 1 + random.between(-4, 4) * 0x1p-24 * std::max(1.0, distance / target.radius);
    const bool outside = distance > target.radius;
    const double sine = outside ? std::min(target.radius * graze / distance, 1.0) : 0;
    const glm::dvec3 outline = to / distance * std::sqrt(1 - sine * sine) + aside * sine;
    if (random.uniform() < 0.5) return {o, outline};
    return {o, glm::normalize(outline + random.direction() * beam.angle)};
}

/// Rays as the stages take them together: every packet is a beam from a place of its own past a ball of its own.
class Packets {
public:
    Packets(const std::vector<Ball>& balls, const glm::dvec3& place, const Beam& beam, Numbers& random)
        : balls_(balls), place_(place), beam_(beam), random_(random) {}
    const Ray& next() {
        const bool first = count_++ % kernels::packet_size == 0;
        if (first) eye_ = place_ + random_.point(20), target_ = &balls_[random_.below(size())];
        if (first || beam_.angle > 0) ray_ = ray_of(beam_, *target_, eye_, random_);
        return ray_;
    }
    /// What the last one runs past.
    const Ball& target() const { return *target_; }
    std::uint32_t size() const { return static_cast<std::uint32_t>(balls_.size()); }

private:
    const std::vector<Ball>& balls_;
    glm::dvec3 place_, eye_{};
    Beam beam_;
    Numbers& random_;
    std::uint32_t count_ = 0;
    const Ball* target_ = nullptr;
    Ray ray_{};
};

class CoherentTest : public KernelTest {};

TEST_P(CoherentTest, MeetsWhatTheLoopMeets) {
    std::uint32_t met = 0, all = 0;
    const auto compare = [&](const World& world, const std::vector<Ball>& balls, const glm::dvec3& place,
                             const Beam& beam, std::uint32_t count) {
        Numbers random(count);
        Rays rays(kernels::round_up(count));
        Packets packets(balls, place, beam, random);
        for (std::uint32_t i = 0; i < count; ++i) {
            const Ray& ray = packets.next();
            // Rays that leave a sphere are as coherent: neighbours' first hits, a mirror's image.
            put_ray(*rays, i, ray.o, ray.d, i % 3 == 0 ? random.below(world.spheres.count) : no_sphere);
        }
        Hits hits(kernels::round_up(count)), wanted = hits;
        const Hits before = hits;
        stages.intersect(world.spheres, *rays, count, *wanted);
        stages.intersect_coherent(world.spheres, *rays, count, *hits);
        EXPECT_TRUE(hits.untouched_but(before, 0, kernels::round_up(count)));
        for (std::uint32_t i = 0; i < count; ++i) met += hits->id[i] != no_sphere;
        all += count;
        return hits.same_as(wanted, 0, count);
    };
    for (const glm::dvec3& place : places)
        for (const std::uint32_t size : {1u, 5u, 16u, 33u, 64u}) {
            const std::vector<Ball> balls = balls_around(place, size, size);
            const World world(balls);
            for (const Beam& beam : beams)
                for (const std::uint32_t count : {1u, 31u, 32u, 125u, 257u, 1700u})
                    ASSERT_TRUE(compare(world, balls, place, beam, count))
                        << size << " spheres at " << place.x << ", " << count << " rays, angle " << beam.angle
                        << ", spread " << beam.spread;
        }
    EXPECT_GT(met, all / 10);
    EXPECT_LT(met, all - all / 10);
}

// A ray that is no number meets nothing, and its neighbours what they would without it: it moves no bound, nor does it
// make the packet forget one ray that runs aside from all others.
TEST_P(CoherentTest, NeighboursOfNoNumberMeetWhatTheyMeet) {
    constexpr std::uint32_t count = 96;
    for (const std::uint32_t size : {40u, 300u}) {
        std::vector<Ball> balls{{{40, 0, 100}, 1}};
        while (balls.size() < size) balls.push_back({{0, 0, 3.0 * static_cast<double>(balls.size())}, 1});
        const Planted world(balls);
        const auto intersect =
            size <= kernels::SomeSpheres::capacity ? stages.intersect_coherent : stages.intersect_tree;
        for (std::uint32_t bad = 1; bad < count; ++bad) {
            Rays rays(count);
            for (std::uint32_t i = 0; i < count; ++i) put_ray(*rays, i, {0, 0, 0}, {i == 0 ? 0.4 : 0, 0, 1}, no_sphere);
            for (float* const column : {rays->ox, rays->oy, rays->oz, rays->dx, rays->dy, rays->dz})
                column[bad] = std::numeric_limits<float>::quiet_NaN();
            Hits hits(count), occluded(count);
            intersect(world->spheres, *rays, count, *hits);
            const std::vector<float> begin(count, 0), end(count, 1000);
            stages.is_occluded(world->spheres,
                               {rays->ox, rays->oy, rays->oz, rays->dx, rays->dy, rays->dz, begin.data(), end.data()},
                               count, occluded->id);
            for (std::uint32_t i = 0; i < count; ++i) {
                ASSERT_EQ(occluded->id[i], i == bad ? 0u : 1u);
                if (i == bad) {
                    ASSERT_EQ(hits->id[i], no_sphere);
                    continue;
                }
                ASSERT_NE(hits->id[i], no_sphere) << "ray " << i << " beside " << bad << ", " << size << " spheres";
                ASSERT_EQ(world.bare().cx[hits->id[i]], i == 0 ? 40 : 0);
            }
        }
    }
}

// Worlds large enough for a tree: in a packet of alike rays as each alone, where nothing can be bounded together.
TEST_P(CoherentTest, MeetsInATreeWhatEachRayMeetsAlone) {
    std::uint32_t met = 0, all = 0, ids_apart = 0;
    for (const glm::dvec3& place : places)
        for (const std::uint32_t size : {64u, 200u, 3000u}) {
            std::vector<Ball> balls = balls_around(place, size, size, size == 200 ? 1e4 : 3);
            // Two and two the same: of equally far ones the first in the table.
            for (std::uint32_t k = 0; k < size / 8; ++k) balls[2 * k + 1] = balls[2 * k];
            const Planted world(balls);
            for (const Beam& beam : beams) {
                constexpr std::uint32_t count = 300;
                Numbers random(size);
                Rays rays(kernels::round_up(count));
                Packets packets(balls, place, beam, random);
                for (std::uint32_t i = 0; i < count; ++i) {
                    const Ray& ray = packets.next();
                    const std::uint32_t left = random.below(size) | (i % 2 == 0 ? kernels::inside_bit : 0);
                    put_ray(*rays, i, ray.o, ray.d, i % 3 == 0 ? left : no_sphere);
                }
                Hits hits(kernels::round_up(count));
                stages.intersect_tree(world->spheres, *rays, count, *hits);
                for (std::uint32_t i = 0; i < count; i += 5) {
                    Hits alone(kernels::widest);
                    stages.intersect_tree(world->spheres, from(rays, i), 1, *alone);
                    ASSERT_EQ(hits->id[i], alone->id[0]) << "ray " << i << ", angle " << beam.angle;
                    ASSERT_EQ(hits->t[i], alone->t[0]) << "ray " << i << ", angle " << beam.angle;
                    met += hits->id[i] != no_sphere;
                    ids_apart += hits->id[i] != hits->id[0];
                    ++all;
                }
                // The same rays as shadow rays, towards what is 30 away.
                Shadows queue(kernels::round_up(count));
                for (std::uint32_t i = 0; i < count; ++i) {
                    put3(queue->ox, queue->oy, queue->oz, i, origin_of(*rays, i));
                    put3(queue->dx, queue->dy, queue->dz, i, direction_of(*rays, i));
                    put3(queue->r, queue->g, queue->b, i, glm::dvec3(1));
                    queue->inverse_t_max[i] = 1.0f / 30;
                    queue->departed[i] = rays->departed[i], queue->slot[i] = i;
                }
                Slots slots(kernels::round_up(count));
                for (std::uint32_t i = 0; i < 4 * count; ++i) slots->radiance[i] = 0;
                stages.shadow_tree(world->spheres, *queue, count, 3, *slots);
                for (std::uint32_t i = 0; i < count; i += 5) {
                    Shadows part(kernels::widest);
                    put3(part->ox, part->oy, part->oz, 0, origin_of(*rays, i));
                    put3(part->dx, part->dy, part->dz, 0, direction_of(*rays, i));
                    put3(part->r, part->g, part->b, 0, glm::dvec3(1));
                    part->inverse_t_max[0] = queue->inverse_t_max[i];
                    part->departed[0] = queue->departed[i], part->slot[0] = 0;
                    Slots one(kernels::widest);
                    for (int c = 0; c < 4; ++c) one->radiance[c] = 0;
                    stages.shadow_tree(world->spheres, *part, 1, 3, *one);
                    ASSERT_EQ(slots->radiance[4 * i], one->radiance[0]) << "shadow ray " << i;
                }
            }
        }
    EXPECT_GT(met, all / 10);
    EXPECT_LT(met, all);
    EXPECT_GT(ids_apart, all / 10);
}

TEST_P(CoherentTest, IsShadowedByWhatTheLoopFinds) {
    const std::vector<Ball> balls = balls_around(places[0], 50, 3);
    const World world(balls);
    std::uint32_t lit = 0, all = 0;
    for (const Beam& beam : beams)
        for (const std::uint32_t skip : {no_sphere, 7u})
            for (const std::uint32_t count : {1u, 33u, 256u, 3700u}) {
                Numbers random(count + skip);
                Shadows queue(kernels::round_up(count));
                Packets packets(balls, places[0], beam, random);
                for (std::uint32_t i = 0; i < count; ++i) {
                    const Ray& ray = packets.next();
                    // Ends before, about at and behind the target.
                    const double reach = glm::length(packets.target().centre - ray.o) * random.between(0.5, 1.5);
                    put3(queue->ox, queue->oy, queue->oz, i, ray.o);
                    put3(queue->dx, queue->dy, queue->dz, i, ray.d);
                    put3(queue->r, queue->g, queue->b, i, glm::dvec3(1));
                    queue->inverse_t_max[i] = count == 33 ? 0 : narrow(1 / reach);
                    queue->departed[i] = i % 3 == 0 ? random.below(50) : no_sphere;
                    queue->slot[i] = i;
                }
                Slots slots(kernels::round_up(count));
                for (std::uint32_t i = 0; i < 4 * count; ++i) slots->radiance[i] = 0;
                Slots wanted = slots;
                stages.shadow(world.spheres, *queue, count, skip, *wanted);
                stages.shadow_coherent(world.spheres, *queue, count, skip, *slots);
                ASSERT_TRUE(slots.same_as(wanted, 0, count))
                    << count << " rays, angle " << beam.angle << ", spread " << beam.spread;
                for (std::uint32_t i = 0; i < count; ++i) lit += slots->radiance[4 * i] > 0;
                all += count;
            }
    EXPECT_GT(lit, all / 10);
    EXPECT_LT(lit, all - all / 10);
}

TEST(CandidatesTest, OfATreeAreListedInOrderOrAreTooMany) {
    std::vector<Ball> balls;
    for (int k = 0; k < 900; ++k) balls.push_back({{k % 30, k / 30, 10}, 0.4});
    const Planted world(balls);
    kernels::Packet<float> beam{{3, 3, 0}, {0, 0, 1}, 0.1f, 0.1f, std::numeric_limits<float>::infinity()};
    kernels::SphereList<float> list;
    ASSERT_TRUE(kernels::collect<kernels::ScalarLanes<float>>(world->spheres, beam, list));
    ASSERT_EQ(list.count, 9u) << "the middle one and its neighbours, each once";
    for (std::uint32_t i = 0; i < 9; ++i) {
        const glm::dvec3 apart = world->centre(list.id[i]) - glm::dvec3(3, 3, 10);
        EXPECT_LT(glm::length(apart), 1.5);
        EXPECT_TRUE(i == 0 || list.id[i - 1] < list.id[i]);
    }
    beam.deviation = 0.5f;
    list.count = 0;
    EXPECT_FALSE(kernels::collect<kernels::ScalarLanes<float>>(world->spheres, beam, list)) << "some eighty";
}

// What the whole is for: a lattice of 64 spheres, and rays about one of them.
TEST(CandidatesTest, AreFewForANarrowBeamAndAllForAWideOne) {
    std::vector<Ball> balls;
    for (int k = 0; k < 64; ++k) balls.push_back({{k % 8, k / 8, 10}, 0.4});
    const World world(balls);
    const kernels::Packet<float> narrow_beam{{3, 3, 0}, {0, 0, 1}, 0.1f, 0.01f, std::numeric_limits<float>::infinity()};
    using One = kernels::ScalarLanes<float>;
    EXPECT_EQ(kernels::candidates<One>(world.spheres, narrow_beam).bits, std::uint64_t{1} << 27);
    kernels::Packet<float> wider = narrow_beam;
    wider.deviation = 0.1f;  // reaches 1.1 at the lattice: the four neighbours as well, the diagonals at 1.41 too
    EXPECT_EQ(std::popcount(kernels::candidates<One>(world.spheres, wider).bits), 9);
    wider.t_max = 8;
    EXPECT_EQ(kernels::candidates<One>(world.spheres, wider).bits, 0u);
    wider.deviation = 2;
    EXPECT_EQ(kernels::candidates<One>(world.spheres, wider).bits, ~std::uint64_t{0});
}

// A look at three rays decides whether all are bounded.
TEST(CandidatesTest, AreAllWhereRaysRunApart) {
    using One = kernels::ScalarLanes<float>;
    const World world({{{0, 0, 10}, 1}, {{0, 0, -10}, 1}});
    const auto of = [&](const glm::dvec3& last, const glm::dvec3& last_origin, double inverse_t_max,
                        std::uint32_t count = kernels::widest) {
        Rays rays(kernels::widest);
        std::vector<float> inverse(32, narrow(inverse_t_max));
        for (std::uint32_t k = 0; k < 32; ++k) put_ray(*rays, k, {0, 0, 0}, {0, 0, 1});
        put_ray(*rays, 31, last_origin, last);
        auto span = kernels::span_of(*rays, 0, count);
        span.inverse_t_max = inverse.data();
        return kernels::candidates<One>(world.spheres, span).bits;
    };
    EXPECT_EQ(of({0, 0, 1}, {0, 0, 0}, 0), 1u);
    EXPECT_EQ(of({0, 0, 1}, {0, 0, 0}, 0, 31), 3u) << "too few";
    EXPECT_EQ(of({0, 0.5, 1}, {0, 0, 0}, 0), 1u);
    EXPECT_EQ(of({0, 1, 1}, {0, 0, 0}, 0), 3u);
    EXPECT_EQ(of({0, 0, 1}, {1, 0, 0}, 0.1), 1u);
    EXPECT_EQ(of({0, 0, 1}, {3, 0, 0}, 0.1), 3u) << "far apart for their length";
}

// To the last bit, however the middle of the packet is rounded.
TEST(CandidatesTest, TheBoundHoldsEveryRay) {
    using One = kernels::ScalarLanes<float>;
    Numbers random(11);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 place = random.direction() * random.scale(1e-3, 1e7), ahead = random.direction();
        const double spread = glm::length(place) * random.scale(1e-8, 1), angle = random.scale(1e-8, 1);
        Rays rays(kernels::widest);
        for (std::uint32_t k = 0; k < 32; ++k)
            put_ray(*rays, k, place + random.point(spread), ahead + random.point(angle));
        const auto packet = kernels::bound<One>(kernels::span_of(*rays, 0, kernels::widest));
        const glm::dvec3 origin{packet.origin.x, packet.origin.y, packet.origin.z};
        const glm::dvec3 axis{packet.axis.x, packet.axis.y, packet.axis.z};
        for (std::uint32_t k = 0; k < 32; ++k) {
            ASSERT_LE(glm::length(origin_of(*rays, k) - origin), packet.spread);
            ASSERT_LE(glm::length(direction_of(*rays, k) - axis), packet.deviation);
        }
        ASSERT_LE(packet.spread, 4 * spread + 1e-6 * glm::length(place)) << "no wider than it need be";
    }
}

// Spheres that the cone just touches, and that rounding would lose; a hundredth further out they are no candidates.
TEST(CandidatesTest, ErrOnTheSideOfYes) {
    using One = kernels::ScalarLanes<float>;
    Numbers random(12);
    std::uint32_t beyond = 0;
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 axis = random.direction();
        const double deviation = random.scale(1e-6, 0.5), spread = random.scale(1e-6, 1), t = random.scale(1e-2, 1e4);
        const kernels::Packet<float> packet{{0, 0, 0},
                                            {narrow(axis.x), narrow(axis.y), narrow(axis.z)},
                                            narrow(spread),
                                            narrow(deviation),
                                            std::numeric_limits<float>::infinity()};
        const glm::dvec3 side = glm::normalize(glm::cross(axis, random.direction()));
        // The cone's outline rises by `deviation` per unit length, so what touches it from outside lies on the normal.
        const double radius = random.scale(1e-3, 1e3),
                     rise = std::atan(deviation / std::sqrt(1 - deviation * deviation));
        const auto touching = [&](double times) {
            const glm::dvec3 normal = side * std::cos(rise) - axis * std::sin(rise);
            const glm::dvec3 outline = axis * t + side * (t * std::tan(rise) + spread / std::cos(rise));
            return Ball{outline + normal * (radius * times), radius};
        };
        const World inner({touching(1 - 1e-7)}), outer({touching(1.01)});
        ASSERT_EQ(kernels::candidates<One>(inner.spheres, packet).bits, 1u) << deviation << " " << spread << " " << t;
        beyond += kernels::candidates<One>(outer.spheres, packet).bits == 0;
    }
    EXPECT_GT(beyond, 5000u);
}

INSTANTIATE_TEST_SUITE_P(Isas, CoherentTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
