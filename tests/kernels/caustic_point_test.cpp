// Paths from a vertex over a ball to a point: none missing, none too many, with the right share of solid angle.
//
// The truth follows rays in double, event by event, and knows nothing of the closed form: directions in the plane of
// vertex, centre and point are scanned for rays that pass the point, and the solid angle is that of neighbouring rays.
#include "kernels/caustic_point_connect.hpp"

#include <optional>

#include "kernel_test.hpp"
#include "numbers.hpp"
#include "optics_reference.hpp"

namespace orrery::kernel_tests {
namespace {

using glm::dvec3;

/// A ball of radius 1 about the origin.
struct Setting {
    double eta;
    std::uint32_t chords;
    dvec3 vertex, point;
};

struct Line {
    dvec3 origin, direction;
};

/// What leaves the ball of a ray from the vertex, after the prescribed events.
std::optional<Line> over_ball(const Setting& s, const dvec3& direction) {
    Line ray{s.vertex, direction};
    for (std::uint32_t event = 0; event <= s.chords; ++event) {
        const double b = -glm::dot(ray.origin, ray.direction);
        const dvec3 nearest = ray.origin + b * ray.direction;
        const double half = 1 - glm::dot(nearest, nearest);
        if (half <= 0 || b <= 0) return {};
        const bool inside = event > 0, through = s.chords > 0 && (event == 0 || event == s.chords);
        const dvec3 at = glm::normalize(nearest + (inside ? 1.0 : -1.0) * std::sqrt(half) * ray.direction);
        const dvec3 normal = inside ? -at : at;
        const double eta = inside ? 1 / s.eta : s.eta, cosine = -glm::dot(normal, ray.direction);
        if (through && std::sqrt(1 - cosine * cosine) >= eta) return {};
        ray = {at, glm::normalize(through ? refract(ray.direction, normal, eta) : ray.direction + 2 * cosine * normal)};
    }
    return ray;
}

struct Axes {
    explicit Axes(const Setting& s) : ahead(glm::normalize(-s.vertex)) {
        const dvec3 off = s.point - glm::dot(s.point, ahead) * ahead;
        towards = glm::normalize(off);
    }
    dvec3 at(double angle) const { return std::cos(angle) * ahead + std::sin(angle) * towards; }
    dvec3 ahead, towards;
};

/// How far the ray passes the point on one side or the other, of those that run towards it.
std::optional<double> passes(const Setting& s, const Axes& axes, double angle) {
    const auto ray = over_ball(s, axes.at(angle));
    if (!ray) return {};
    const dvec3 apart = s.point - ray->origin;
    if (glm::dot(apart, ray->direction) <= 0) return {};
    return glm::dot(glm::cross(ray->direction, apart), glm::cross(axes.ahead, axes.towards));
}

/// Of directions that meet the ball, and with chords enter it.
double widest_angle(const Setting& s) {
    return std::asin((s.chords > 0 ? std::min(1.0, s.eta) : 1) / glm::length(s.vertex));
}

/// Angles with the axis, positive towards the point.
std::vector<double> scan(const Setting& s) {
    const Axes axes(s);
    const double widest = widest_angle(s);
    std::vector<double> found;
    for (const int side : {-1, 1}) {
        std::optional<double> last;
        double before = 0;
        constexpr int steps = 2000;
        for (int i = 0; i <= steps; ++i) {
            const double angle = side * widest * std::sin(pi / 2 * (i + 1e-7) / (steps + 2e-7));
            const auto next = passes(s, axes, angle);
            if (next && last && (*next < 0) != (*last < 0)) {
                double low = before, high = angle;
                for (int k = 0; k < 60; ++k) {
                    const double middle = (low + high) / 2;
                    const auto there = passes(s, axes, middle);
                    if (!there) break;
                    ((*there < 0) == (*last < 0) ? low : high) = middle;
                }
                found.push_back((low + high) / 2);
            }
            last = next, before = angle;
        }
    }
    return found;
}

/// Solid angle per area across the ray at the point, by rays beside it.
double spread(const Setting& s, double angle) {
    const Axes axes(s);
    const dvec3 d = axes.at(angle), u = axes.at(angle + pi / 2), v = glm::cross(d, u);
    const auto middle = over_ball(s, d);
    if (!middle) return 0;
    const double h = std::min(1e-5 / glm::length(s.vertex), 1e-3 * (widest_angle(s) - std::abs(angle)));
    const auto meets = [&](const dvec3& direction) {
        const auto ray = over_ball(s, glm::normalize(direction));
        if (!ray) return dvec3(std::nan(""));
        const double t =
            glm::dot(s.point - ray->origin, middle->direction) / glm::dot(ray->direction, middle->direction);
        return ray->origin + t * ray->direction;
    };
    const dvec3 by_u = (meets(d + h * u) - meets(d - h * u)) / (2 * h),
                by_v = (meets(d + h * v) - meets(d - h * v)) / (2 * h);
    return 1 / glm::length(glm::cross(by_u, by_v));
}

struct Path {
    double angle, spread, inverse_t, incidence;
    dvec3 direction;
};

template <class Real>
std::vector<Path> found_by_kernel(const Setting& s) {
    using V = kernels::ScalarLanes<Real>;
    const auto f = [](double x) { return static_cast<Real>(x); };
    const kernels::Sphere<Real> ball{{0, 0, 0}, 1, 1};
    const auto vec = [&](const dvec3& v) { return kernels::Vec3<Real>{f(v.x), f(v.y), f(v.z)}; };
    const Axes axes(s);
    std::vector<Path> list;
    kernels::paths_over_ball<V>(
        ball, f(s.eta), s.chords, vec(s.vertex), vec(s.point), true,
        [&](bool some, const kernels::Vec3<Real>& d, Real inverse_t, Real incidence, Real share) {
            if (!some) return;
            const dvec3 direction{d.x, d.y, d.z};
            EXPECT_NEAR(glm::length(direction), 1, 8 * std::numeric_limits<Real>::epsilon());
            const double angle = std::atan2(glm::dot(direction, axes.towards), glm::dot(direction, axes.ahead));
            list.push_back({angle, share, inverse_t, incidence, direction});
        });
    return list;
}

/// Rounded to float, so that float and double see the same numbers.
dvec3 rounded(const dvec3& v) { return glm::dvec3(glm::vec3(v)); }

Setting random_setting(Numbers& random) {
    Setting s;
    s.chords = random.below(3);
    const double kind = random.uniform();
    s.eta = kind < 0.1   ? 1
            : kind < 0.5 ? random.between(1, 3)
            : kind < 0.7 ? 1 + random.scale(1e-4, 1e-1)
            : kind < 0.9 ? random.between(0.2, 1)
                         : random.scale(1, 10);
    s.eta = narrow(s.eta);
    const auto distance = [&] {
        const double k = random.uniform();
        return k < 0.2 ? 1 + random.scale(1e-3, 1e-1) : k < 0.8 ? random.between(1.05, 6) : random.scale(2, 1e3);
    };
    s.vertex = rounded(distance() * random.direction());
    s.point = rounded(distance() * random.direction());
    if (random.uniform() < 0.1)
        s.point = rounded(glm::length(s.point) * glm::normalize(-s.vertex + 0.01 * random.direction()));
    return s;
}

template <class Real>
class PointPaths : public testing::Test {};
using BothReals = testing::Types<float, double>;
TYPED_TEST_SUITE(PointPaths, BothReals);

TYPED_TEST(PointPaths, AreAllThereAreWithTheirShareOfSolidAngle) {
    constexpr bool single = sizeof(TypeParam) == 4;
    constexpr double precision = single ? 4e-6 : 1e-10;
    Numbers random(7);
    std::uint32_t paths = 0, rough = 0, by_chords[3] = {};
    for (int n = 0; n < 3000; ++n) {
        const Setting s = random_setting(random);
        const auto wanted = scan(s);
        auto found = found_by_kernel<TypeParam>(s);
        SCOPED_TRACE(testing::Message() << "eta " << s.eta << ", " << s.chords << " chords, vertex at "
                                        << glm::length(s.vertex) << ", point at " << glm::length(s.point)
                                        << ", angle between "
                                        << std::acos(glm::dot(s.vertex, s.point) / glm::length(s.vertex) /
                                                     glm::length(s.point)));
        for (const double angle : wanted) {
            const auto nearest =
                std::ranges::min_element(found, {}, [&](const Path& p) { return std::abs(p.angle - angle); });
            ASSERT_NE(nearest, found.end()) << "missing at " << angle;
            // Near a caustic's edge many directions nearly lead there.
            const double share = spread(s, angle);
            const double loose = precision * (1 + std::sqrt(share * glm::dot(s.point, s.point)));
            EXPECT_LT(std::abs(nearest->angle - angle), loose * 10);
            ++paths, ++by_chords[s.chords];
            if (!(std::abs(nearest->spread / share - 1) < (single ? 2e-3 : 1e-4))) ++rough;
            found.erase(nearest);
        }
        // Two that the scan took for none: they must pass the point all the same, as far as the direction's digits
        // tell; rays that graze the ball turn away by much for a little.
        for (const Path& path : found) {
            const auto miss = passes(s, Axes(s), path.angle);
            EXPECT_TRUE(!miss || std::abs(*miss) < (single ? 1e-3 : 1e-4) * glm::length(s.point))
                << "at " << path.angle << " misses by " << miss.value_or(0);
        }
    }
    for (const std::uint32_t some : by_chords) EXPECT_GT(some, 300u);
    EXPECT_LT(rough, paths / 200);
}

TYPED_TEST(PointPaths, MeetTheBallWhereTheySay) {
    Numbers random(8);
    for (int n = 0; n < 3000; ++n) {
        const Setting s = random_setting(random);
        for (const Path& path : found_by_kernel<TypeParam>(s)) {
            const dvec3 at = s.vertex + path.direction / path.inverse_t;
            const double grain = 16 * std::numeric_limits<TypeParam>::epsilon() * glm::length(s.vertex);
            EXPECT_NEAR(glm::length(at), 1, grain / path.incidence);
            EXPECT_NEAR(glm::dot(at, -path.direction), path.incidence, grain / path.incidence);
        }
    }
}

// On the axis a path is a single one, and as wide as paraxial optics has it: of light into the solid angle w, the area
// w (B e)^2 is lit, B being the height that an angle becomes.
TYPED_TEST(PointPaths, AreParaxialOnTheAxis) {
    const double d = 5, e = 8;
    for (const double eta : {3.0, 0.5}) {
        const auto height = [&](std::uint32_t chords) {
            double y = d - 1, angle = 1;
            if (chords == 0) return y + (e - 1) * (angle + 2 * y);
            angle = angle / eta - (1 - 1 / eta) * y;
            for (std::uint32_t k = 0; k < chords; ++k) {
                if (k > 0) angle -= 2 * y;
                y += 2 * angle;
            }
            angle = angle * eta - (eta - 1) * y;
            return y + (e - 1) * angle;
        };
        for (std::uint32_t chords = 0; chords <= kernels::most_point_chords; ++chords) {
            const double side = chords % 2 == 0 ? -1 : 1;
            Setting s{eta, chords, {0, 0, -d}, {1e-30, 0, side * e}};
            const auto found = found_by_kernel<TypeParam>(s);
            ASSERT_EQ(found.size(), 1u) << eta << ' ' << chords;
            EXPECT_NEAR(found[0].angle, 0, 1e-6);
            const double truth = 1 / (height(chords) * height(chords));
            EXPECT_NEAR(found[0].spread, truth, 1e-5 * truth) << eta << ' ' << chords;
        }
    }
}

}  // namespace
}  // namespace orrery::kernel_tests
