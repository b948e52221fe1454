// Ray casting of segments: the scalar form and the columns, their open ends, and each other.
#include "kernels/segment.hpp"

#include <pthread.h>

#include <array>
#include <cstdlib>
#include <functional>

#include "geometry.hpp"
#include "kernel_test.hpp"
#include "numbers.hpp"
#include "owned.hpp"
#include "planted.hpp"

namespace orrery::kernel_tests {
namespace {

using kernels::inside_bit;
using kernels::no_sphere;
using Segment = kernels::Segment<float>;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double accuracy = 4 * 0x1p-24;  // as in intersect_fixture.hpp

/// Segments as the columns want them; what lies behind the last is poison.
class Columns {
public:
    explicit Columns(const std::vector<Segment>& segments) {
        for (auto& column : columns_)
            column.assign(kernels::round_up(static_cast<std::uint32_t>(segments.size())) + kernels::widest,
                          std::numeric_limits<float>::quiet_NaN());
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const Segment& s = segments[i];
            const float values[] = {s.ox, s.oy, s.oz, s.dx, s.dy, s.dz, s.t_min, s.t_max};
            for (std::size_t c = 0; c < 8; ++c) columns_[c][i] = values[c];
        }
    }
    kernels::SegmentColumns<float> view() const {
        return {columns_[0].data(), columns_[1].data(), columns_[2].data(), columns_[3].data(),
                columns_[4].data(), columns_[5].data(), columns_[6].data(), columns_[7].data()};
    }

private:
    std::array<std::vector<float>, 8> columns_;
};

Segment segment(const glm::dvec3& o, const glm::dvec3& d, float t_min = 0, float t_max = infinity) {
    return {narrow(o.x), narrow(o.y), narrow(o.z), narrow(d.x), narrow(d.y), narrow(d.z), t_min, t_max};
}

std::vector<Ball> some_balls() {
    Numbers random(1);
    std::vector<Ball> balls(12);
    for (Ball& ball : balls) ball = {random.point(4), random.scale(0.05, 3)};
    return balls;
}

std::vector<Segment> some_segments(std::uint32_t count) {
    Numbers random(2);
    std::vector<Segment> segments;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float t_min = i % 3 == 0 ? 0 : narrow(random.between(0, 4));
        const float t_max = i % 4 == 0 ? infinity : t_min + narrow(random.between(0, 6));
        segments.push_back(segment(random.point(5), random.direction(), t_min, t_max));
    }
    return segments;
}

Meeting meet(const World& world, const Segment& s) {
    return meet(world, {s.ox, s.oy, s.oz}, {s.dx, s.dy, s.dz}, no_sphere, s.t_min, s.t_max);
}

TEST(SegmentScalar, ClosestHitAndOcclusionAgreeWithTheTextbook) {
    const World world(some_balls());
    std::uint32_t open = 0, met = 0;
    for (const Segment& s : some_segments(20001)) {
        const Meeting wanted = meet(world, s);
        if (wanted.open) {
            ++open;
            continue;
        }
        const auto hit = kernels::intersects(world.spheres, s);
        ASSERT_EQ(hit.sphere, wanted.id & no_sphere);
        ASSERT_EQ(kernels::is_occluded(world.spheres, s), wanted.id != no_sphere);
        if (wanted.id == no_sphere) {
            ASSERT_EQ(hit.t, s.t_max);
        } else {
            ++met;
            ASSERT_EQ(hit.inside, (wanted.id & inside_bit) != 0);
            ASSERT_NEAR(hit.t, wanted.t, accuracy * wanted.reach);
        }
    }
    EXPECT_LT(open, 100u);
    EXPECT_GT(met, 1000u);
}

// In double the same maths is good to double's rounding.
TEST(SegmentScalar, InDoubleItIsAsGoodAsDouble) {
    Numbers random(3);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 c = random.point(4), o = random.point(9);
        const glm::dvec3 d = glm::normalize(c + 0.9 * random.direction() - o);
        const double r = 1;
        const std::uint64_t surface = 0;
        const kernels::SphereTable<double> table{1, &c.x, &c.y, &c.z, &r, &r, &r, &surface, &surface};
        const auto hit = kernels::intersects(table, kernels::Segment<double>{o.x, o.y, o.z, d.x, d.y, d.z});
        const Roots wanted = roots(o, d, c, r);
        ASSERT_TRUE(wanted.real);
        const double t = wanted.near > 0 ? wanted.near : wanted.far;
        ASSERT_EQ(hit.sphere, 0u);
        ASSERT_NEAR(hit.t, t, 8 * 0x1p-53 * wanted.reach);
        ASSERT_EQ(hit.inside, wanted.near < 0);
    }
}

struct End {
    float t_min, t_max;
    std::uint32_t hit;  ///< id with inside_bit, no_sphere
    float t;
};

/// Hits of the line at exactly 4 (entering) and 6 (leaving): both ends of a segment are open.
std::vector<End> open_ends() {
    const float after4 = std::nextafter(4.0f, 5.0f), before4 = std::nextafter(4.0f, 3.0f);
    const float after6 = std::nextafter(6.0f, 7.0f), before6 = std::nextafter(6.0f, 5.0f);
    return {{0, infinity, 0, 4},
            {0, 4, no_sphere, 4},
            {0, after4, 0, 4},
            {0, 0, no_sphere, 0},
            {before4, infinity, 0, 4},
            {4, infinity, inside_bit, 6},
            {4, 6, no_sphere, 6},
            {4, after6, inside_bit, 6},
            {before6, infinity, inside_bit, 6},
            {before6, 6, no_sphere, 6},
            {6, infinity, no_sphere, infinity}};
}

/// Runs `work` in a thread with this much stack.
void run_with_stack(std::size_t bytes, const std::function<void()>& work) {
    pthread_attr_t attributes;
    ASSERT_EQ(pthread_attr_init(&attributes), 0);
    ASSERT_EQ(pthread_attr_setstacksize(&attributes, bytes), 0);
    pthread_t thread;
    const auto call = [](void* f) -> void* {
        (*static_cast<const std::function<void()>*>(f))();
        return nullptr;
    };
    ASSERT_EQ(pthread_create(&thread, &attributes, call, const_cast<void*>(static_cast<const void*>(&work))), 0);
    EXPECT_EQ(pthread_join(thread, nullptr), 0);
    pthread_attr_destroy(&attributes);
}

// A segment takes room for itself, not for a packet of rays: it may be cast where stacks are small.
TEST(SegmentScalar, ThroughATreeTakesLittleStack) {
    std::vector<Ball> balls;
    for (int i = 0; i < 1000; ++i) balls.push_back({glm::dvec3(i % 10, i / 10 % 10, i / 100) * 3.0, 1});
    const Planted world(balls);
    ASSERT_NE(world->spheres.tree.count, 0u);
    const kernels::Segment<float> segment{-5, 3, 3, 1, 0, 0};
    kernels::SegmentHit<float> hit{};
    bool occluded = false;
    run_with_stack(std::size_t{64} << 10, [&] {
        hit = kernels::intersects(world->spheres, segment);
        occluded = kernels::is_occluded(world->spheres, segment);
    });
    EXPECT_EQ(hit.t, 4);
    EXPECT_TRUE(occluded);
}

TEST(SegmentScalar, EndsAreOpen) {
    const World world({{glm::dvec3(5, 0, 0), 1}});
    for (const End& end : open_ends()) {
        const Segment s = segment({0, 0, 0}, {1, 0, 0}, end.t_min, end.t_max);
        const auto hit = kernels::intersects(world.spheres, s);
        EXPECT_EQ(hit.sphere, end.hit & no_sphere) << end.t_min << " to " << end.t_max;
        EXPECT_EQ(hit.inside, (end.hit & inside_bit) != 0 && end.hit != no_sphere);
        EXPECT_EQ(hit.t, end.t);
        EXPECT_EQ(kernels::is_occluded(world.spheres, s), end.hit != no_sphere) << end.t_min << " to " << end.t_max;
    }
}

TEST(SegmentScalar, NothingIsHitAtZeroNorInAnEmptyWorld) {
    const World world({{glm::dvec3(1, 0, 0), 1}});
    EXPECT_EQ(kernels::intersects(world.spheres, segment({0, 0, 0}, {-1, 0, 0})).sphere, no_sphere);
    EXPECT_EQ(kernels::intersects(world.spheres, segment({0, 0, 0}, {1, 0, 0})).t, 2.0f);
    const World empty(std::vector<Ball>{});
    EXPECT_EQ(kernels::intersects(empty.spheres, segment({0, 0, 0}, {1, 0, 0}, 0, 3)).t, 3.0f);
    EXPECT_FALSE(kernels::is_occluded(empty.spheres, segment({0, 0, 0}, {1, 0, 0})));
}

class SegmentTest : public KernelTest {
protected:
    void expect_columns_are_the_scalar_form(const World& world, const std::vector<Segment>& segments) const {
        const auto count = static_cast<std::uint32_t>(segments.size());
        const Columns columns(segments);
        Hits hits(kernels::round_up(count) + kernels::widest);
        const Hits before = hits;
        stages.intersects(world.spheres, columns.view(), count, *hits);
        EXPECT_TRUE(hits.untouched_but(before, 0, kernels::round_up(count)));
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto wanted = kernels::intersects(world.spheres, segments[i]);
            const bool open = !exact() && meet(world, segments[i]).open;
            if (open) continue;
            ASSERT_EQ(hits->id[i], wanted.sphere | (wanted.inside ? inside_bit : 0)) << "segment " << i;
            if (exact() || wanted.sphere == no_sphere) {
                ASSERT_EQ(hits->t[i], wanted.t) << "segment " << i;
            } else {
                ASSERT_NEAR(hits->t[i], wanted.t, 2 * accuracy * meet(world, segments[i]).reach) << "segment " << i;
            }
        }
    }
    void expect_column_occlusion_is_the_scalar_form(const World& world, const std::vector<Segment>& segments) const {
        const auto count = static_cast<std::uint32_t>(segments.size());
        const Columns columns(segments);
        const Hits out(kernels::round_up(count) + kernels::widest);
        const Hits before = out;
        const std::uint32_t* const occluded = out->id;
        stages.is_occluded(world.spheres, columns.view(), count, out->id);
        EXPECT_TRUE(out.untouched_but(before, 0, kernels::round_up(count)));
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!exact() && meet(world, segments[i]).open) continue;
            ASSERT_EQ(occluded[i], kernels::is_occluded(world.spheres, segments[i]) ? 1u : 0u)
                << "segment " << i << ", " << segments[i].t_min << " to " << segments[i].t_max;
        }
    }
    /// All open ends at once, three times over, so that they meet every lane.
    static std::vector<Segment> segments_with_open_ends() {
        std::vector<Segment> segments;
        for (int round = 0; round < 3; ++round)
            for (const End& end : open_ends()) segments.push_back(segment({0, 0, 0}, {1, 0, 0}, end.t_min, end.t_max));
        return segments;
    }
};

TEST_P(SegmentTest, IntersectsColumns) {
    const World world(some_balls());
    for (const std::uint32_t count : awkward_counts) expect_columns_are_the_scalar_form(world, some_segments(count));
    expect_columns_are_the_scalar_form(world, some_segments(2001));
    expect_columns_are_the_scalar_form(World(std::vector<Ball>{}), some_segments(17));
}

TEST_P(SegmentTest, IntersectsColumnsEndsAreOpen) {
    expect_columns_are_the_scalar_form(World({{glm::dvec3(5, 0, 0), 1}}), segments_with_open_ends());
}

TEST_P(SegmentTest, IsOccludedColumns) {
    const World world(some_balls());
    for (const std::uint32_t count : awkward_counts)
        expect_column_occlusion_is_the_scalar_form(world, some_segments(count));
    expect_column_occlusion_is_the_scalar_form(world, some_segments(2001));
    expect_column_occlusion_is_the_scalar_form(World(std::vector<Ball>{}), some_segments(17));
}

TEST_P(SegmentTest, IsOccludedColumnsEndsAreOpen) {
    expect_column_occlusion_is_the_scalar_form(World({{glm::dvec3(5, 0, 0), 1}}), segments_with_open_ends());
}

// Nothing is said of alignment, so columns may begin at any number. In a process of its own: what aligned stores do to
// other addresses is no failed expectation.
TEST_P(SegmentTest, ColumnsMayLieAnywhere) {
    const World world(some_balls());
    const std::vector<Segment> segments = some_segments(17);
    const Columns columns(segments);
    const auto run = [&] {
        std::vector<float> t(kernels::round_up(17) + 64);
        std::vector<std::uint32_t> ids(t.size());
        for (std::size_t offset = 0; offset < 17; ++offset) {
            const kernels::HitQueue<float> hits{t.data() + offset, ids.data() + offset};
            stages.intersects(world.spheres, columns.view(), 17, hits);
            stages.is_occluded(world.spheres, columns.view(), 17, ids.data() + offset);
        }
        std::exit(0);
    };
    EXPECT_EXIT(run(), ::testing::ExitedWithCode(0), "");
}

INSTANTIATE_TEST_SUITE_P(Isas, SegmentTest, ::testing::ValuesIn(supported_isas()), name_of_isa);

}  // namespace
}  // namespace orrery::kernel_tests
