#include "plan/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "plan/precision.hpp"
#include "plan/tables.hpp"
#include "system/printable.hpp"

namespace orrery {

namespace {

using std::numbers::pi;

constexpr double harmless_share = 0.002;  // of light or picture
/// What is that many times deeper or wider than a surface is uncertain is good to a thousandth of itself.
constexpr double well_apart = 1024;
/// Surfaces that by rounding may be in the wrong order.
constexpr double confused = 4;
/// Paths between two transparent surfaces meet their order so often.
constexpr double to_and_fro = 16;
/// What falls through a slit may be all the light there is: so much more it counts than what a picture shows of it.
constexpr double slit_light = 40;
constexpr std::size_t most_looked_at = 64;  // lamps, and as many spheres

double area(double radius) { return 4 * pi * radius * radius; }
double sum(const glm::dvec3& v) { return v.x + v.y + v.z; }

struct Ball {
    glm::dvec3 centre;
    double radius;
    double error;     ///< by which its surface is uncertain
    double distance;  ///< of the eye from its surface
    bool eye_within;
    bool transparent;
};

/// A sphere that is looked at, and how much of what it shows is uncertain.
struct Subject {
    std::uint32_t sphere;
    Ball ball;
    double weight;           ///< what orders them
    double visible = 0;      ///< of a lamp: area on the camera's side of all others
    double uncertain = 0;    ///< of a lamp: area; of others: share of the picture
    double worst = 0;        ///< the largest part of that
    std::uint32_t with = 0;  ///< whose it is
    double depth = 0;        ///< of the overlap there, < 0 for a gap
    double error = 0;        ///< of either surface there
};

/// The heaviest.
std::vector<Subject> heaviest(std::vector<Subject> subjects) {
    const std::size_t size = std::min(subjects.size(), most_looked_at);
    std::ranges::partial_sort(subjects, subjects.begin() + static_cast<std::ptrdiff_t>(size), std::greater{},
                              &Subject::weight);
    subjects.resize(size);
    return subjects;
}

struct Contact {
    double d;      ///< between centres
    double error;  ///< by which surfaces are uncertain
    bool nested;   ///< if they touch, then one from inside the other
    double depth;  ///< of the overlap, or by which one pokes out of the other; < 0: they are apart, or one is within
    double uncertain;  ///< area of either
};

/// Nothing where they are so far apart that rounding cannot matter.
std::optional<Contact> contact(const Ball& p, const Ball& q, double reach) {
    const glm::dvec3 between = q.centre - p.centre;
    const double d2 = glm::dot(between, between), e = std::max(p.error, q.error);
    const double a = p.radius, b = q.radius, far = a + b + reach * e;
    if (d2 > far * far) return std::nullopt;
    const double d = std::sqrt(d2);
    const bool nested = d < std::max(a, b);
    const double depth = nested ? d - std::abs(a - b) : a + b - d;
    const bool uncertain = depth > -confused * e;
    return Contact{d, e, nested, depth, uncertain ? std::min(area(std::min(a, b)), 2 * pi * a * b * e / d) : 0};
}

class Looking {
public:
    Looking(const Scene& scene, Precision precision)
        : scene_(scene), unit_(unit_roundoff(precision)), eye_(scene.camera.position) {
        const double half = std::tan(scene.camera.fov * pi / 360), aspect = scene.camera.aspect;
        image_ = std::min(4 * half * half * aspect, 2 * pi);
        corner_ = std::atan(half * std::sqrt(1 + aspect * aspect));
        ahead_ = glm::normalize(scene.camera.target - scene.camera.position);
        std::vector<Subject> lamps, large;
        for (std::uint32_t i = 0; i < scene.primitives.size(); ++i) {
            const Primitive& p = scene.primitives[i];
            const Ball ball = ball_of(p);
            const double whole = area(p.radius), most = whole * (ball.transparent ? to_and_fro : 1);
            if (emits(p)) lamps.push_back({i, ball, whole * sum(*p.emission), whole});
            if (most > harmless_share * image_ * ball.distance * ball.distance)
                large.push_back({i, ball, p.radius / (ball.distance + p.radius)});
        }
        lamps_ = heaviest(std::move(lamps));
        large_ = heaviest(std::move(large));
    }

    std::optional<std::string> worst() {
        if (lamps_.empty() && large_.empty()) return std::nullopt;
        for (std::uint32_t k = 0; k < scene_.primitives.size(); ++k) {
            const Ball ball = ball_of(scene_.primitives[k]);
            for (Subject& lamp : lamps_) shade(lamp, ball, k);
            for (Subject& sphere : large_) hide(sphere, ball, k);
        }
        const auto lamp = worst_lamp();
        return lamp ? lamp : worst_sight();
    }

private:
    Ball ball_of(const Primitive& p) const {
        const glm::dvec3 c = glm::abs(p.centre);
        const double from_eye = glm::length(p.centre - eye_);
        const auto kind = scattering_of(scene_.materials[p.material], scene_.settings.integrator);
        return {p.centre,
                p.radius,
                unit_ * std::max({p.radius, c.x, c.y, c.z}),
                std::abs(from_eye - p.radius),
                from_eye < p.radius,
                kernels::traits_of(kind).is_interface};
    }

    /// What sphere k leaves of a lamp's light on the camera's side of it.
    static void shade(Subject& lamp, const Ball& q, std::uint32_t k) {
        if (k == lamp.sphere || q.transparent) return;
        const auto c = contact(lamp.ball, q, confused);
        if (!c) {
            if (q.eye_within) lamp.visible = 0;
            return;
        }
        const double a = lamp.ball.radius, b = q.radius;
        const double cap = c->d > 0 ? (b - (c->d - a)) * (b + (c->d - a)) / (2 * c->d) : b > a ? 2 * a : 0;
        const double within = 2 * pi * a * std::clamp(cap, 0.0, 2 * a);
        lamp.visible = std::min(lamp.visible, q.eye_within ? within : area(a) - within);
        note(lamp, *c, c->uncertain, k);
    }

    /// How much of the picture is uncertain because of where sphere k meets a smaller one that looks large.
    void hide(Subject& sphere, const Ball& q, std::uint32_t k) const {
        const Ball& p = sphere.ball;
        const double a = p.radius, b = q.radius;
        if (b < a || (b == a && k <= sphere.sphere)) return;
        const auto c = contact(p, q, well_apart);
        if (!c || std::abs(c->depth) > well_apart * c->error) return;
        // The point of contact, on the line of centres.
        const glm::dvec3 out =
            c->d > 0 ? (c->nested ? p.centre - q.centre : q.centre - p.centre) / c->d : glm::dvec3{0};
        const glm::dvec3 to = p.centre + a * out - eye_;
        const double from_eye = glm::length(to);
        const auto share = [&](double patch, double distance, double unseen) {
            const double angle = std::acos(std::clamp(glm::dot(ahead_, to) / from_eye, -1.0, 1.0));
            const bool seen = !(angle > corner_ + std::asin(std::min(1.0, std::sqrt(patch / pi) / distance)));
            return std::min(1.0, patch / ((seen ? image_ : std::max(image_, unseen)) * distance * distance));
        };
        const bool crevice = !p.eye_within && q.eye_within == c->nested;
        if (crevice && !p.transparent && !q.transparent) {
            const double gap = std::max(std::abs(c->depth), c->error);
            const double width = 2 * std::sqrt(2 * a * b / std::max(c->d, c->error) * gap);
            const double light = slit_light * share(width * c->error, std::max(p.distance, from_eye), 0.05);
            if (light > harmless_share) note(sphere, *c, std::min(1.0, light), k);
            return;
        }
        const double uncertain = std::min((p.transparent && q.transparent ? to_and_fro : 1) * c->uncertain, area(a));
        const double distance = std::max(p.distance, from_eye - std::sqrt(uncertain / pi));
        // What the camera does not look at it may see by way of a mirror, in passing.
        note(sphere, *c, share(uncertain, distance, 2 * pi), k);
    }

    static void note(Subject& subject, const Contact& c, double uncertain, std::uint32_t with) {
        subject.uncertain += uncertain;
        if (uncertain > subject.worst) {
            subject.worst = uncertain;
            subject.with = with, subject.depth = c.depth, subject.error = c.error;
        }
    }

    std::string words(const Subject& worst, double share, const char* whole) const {
        const Primitive &p = scene_.primitives[worst.sphere], &q = scene_.primitives[worst.with];
        return fmt::format(
            "spheres {} and {} {} by {:.2g}, where surfaces are good to {:.1g}: {:.1g} % of the {} is in doubt",
            in_quotes(p.id), in_quotes(q.id), worst.depth > 0 ? "overlap" : "miss each other", std::abs(worst.depth),
            worst.error, 100 * share, whole);
    }

    std::optional<std::string> worst_lamp() const {
        double light = 0, uncertain = 0;
        const Subject* worst = nullptr;
        const auto power = [&](const Subject& lamp) { return sum(*scene_.primitives[lamp.sphere].emission); };
        for (const Subject& lamp : lamps_) {
            light += power(lamp) * lamp.visible;
            uncertain += power(lamp) * lamp.uncertain;
            if (lamp.uncertain > 0 && (!worst || power(lamp) * lamp.uncertain > power(*worst) * worst->uncertain))
                worst = &lamp;
        }
        if (!(uncertain > harmless_share * light)) return std::nullopt;
        return words(*worst, std::min(1.0, uncertain / light), "light");
    }

    std::optional<std::string> worst_sight() const {
        double uncertain = 0;
        for (const Subject& sphere : large_) uncertain += sphere.uncertain;
        if (!(uncertain > harmless_share)) return std::nullopt;
        return words(*std::ranges::max_element(large_, {}, &Subject::uncertain), std::min(1.0, uncertain), "picture");
    }

    const Scene& scene_;
    double unit_;
    glm::dvec3 eye_, ahead_;
    double image_;   ///< solid angle of it, near enough
    double corner_;  ///< angle from the camera's axis to its corner
    std::vector<Subject> lamps_, large_;
};

}  // namespace

std::optional<std::string> uncertain_contact(const Scene& scene, Precision precision) {
    return Looking(scene, precision).worst();
}

}  // namespace orrery
