#include "scene_from_bytes.hpp"

#include <array>

#include "scene/range.hpp"

namespace orrery::fuzz {

namespace {

double length_in_range(double x) { return std::clamp(x, 1e-17, 1e17); }
double coordinate_in_range(double x) { return std::abs(x) < 1e-17 ? 0 : std::clamp(x, -1e17, 1e17); }
glm::dvec3 coordinates_in_range(const glm::dvec3& p) {
    return {coordinate_in_range(p.x), coordinate_in_range(p.y), coordinate_in_range(p.z)};
}

/// Draws the parts of one scene in turn.
class Draw {
public:
    explicit Draw(Choices& choices) : choices_(choices) {}

    DrawnScene scene() {
        settings();
        world();
        materials();
        const bool many = choices_.chance(24);
        const std::uint32_t count = many ? 65 + choices_.below(40) : choices_.below(9);
        for (std::uint32_t i = 0; i < count; ++i) sphere(many && i > 8);
        point_lights();
        camera();
        background();
        return out_;
    }

private:
    using enum MaterialKind;

    void settings() {
        RenderSettings& s = out_.scene.settings;
        s.integrator = choices_.one_of(std::array{Integrator::path_tracing, Integrator::path_tracing,
                                                  Integrator::path_tracing, Integrator::whitted, Integrator::depth});
        s.estimator = choices_.one_of(std::array{Estimator::uniform, Estimator::stratified, Estimator::sobol});
        s.transport = choices_.one_of(std::array{Transport::naive, Transport::nee, Transport::mis});
        s.light_sampling = choices_.one_of(std::array{LightSampling::cone, LightSampling::area, LightSampling::exact});
        s.light_choice = choices_.one_of(std::array{LightChoice::all, LightChoice::uniform, LightChoice::power});
        s.precision = choices_.one_of(std::array{Precision::automatic, Precision::binary32, Precision::binary64});
        s.caustics = choices_.chance(192);
        s.roulette = choices_.chance(128);
        s.roulette_from = choices_.below(10);
        s.width = 1 + choices_.below(5);
        s.height = 1 + choices_.below(5);
        s.samples = 1 + choices_.below(6);
        s.depth = choices_.below(choices_.chance(16) ? 20 : 7);
        s.seed = choices_.byte();
    }

    /// The size of things and where they are.
    void world() {
        out_.extreme = choices_.chance(64);
        unit_ = out_.extreme ? choices_.power_of_ten(-15, 15) : choices_.chance(64) ? choices_.power_of_ten(-6, 7) : 1;
        if (choices_.chance(48))
            place_ = choices_.direction() * (unit_ * choices_.power_of_ten(0, out_.extreme ? 9 : 4));
    }

    double fraction() { return choices_.chance(32) ? choices_.below(2) : choices_.unit(); }
    glm::dvec3 colour() {
        const double r = fraction();
        if (choices_.chance(160)) return glm::dvec3(r);
        const double g = fraction();
        return {r, g, fraction()};
    }
    glm::dvec3 power() {
        if (out_.extreme && choices_.chance(32)) return colour() * choices_.power_of_ten(-30, 29.9);
        return colour() * choices_.power_of_ten(-1, 3);
    }

    void materials() {
        const std::uint32_t count = 1 + choices_.below(4);
        for (std::uint32_t i = 0; i < count; ++i) {
            Material m;
            m.id = "m" + std::to_string(i);
            m.kind = choices_.one_of(std::array{diffuse, specular, glossy, dielectric, translucent});
            m.rho = colour();
            if (m.kind == dielectric || m.kind == translucent) {
                m.rho_t = colour();
                m.eta = out_.extreme && choices_.chance(64)
                            ? choices_.power_of_ten(-6, 6)
                            : choices_.one_of(std::array{1.5, 1 / 1.5, 1.0, 1.0001, 2.4, 1.01});
            }
            if (m.kind == glossy || m.kind == translucent)
                m.roughness = choices_.chance(32) ? choices_.one_of(std::array{1e-6, 1e-3, 0.999, 0.999999})
                                                  : choices_.between(0.01, 0.99);
            out_.scene.materials.push_back(m);
        }
    }

    void sphere(bool plain) {
        std::vector<Primitive>& all = out_.scene.primitives;
        Primitive p;
        p.id = "p" + std::to_string(all.size());
        const std::uint32_t how = plain ? 0 : choices_.below(16);
        if (how < 8 || all.empty()) {
            p.radius =
                unit_ * (how == 1 && out_.extreme ? choices_.power_of_ten(-6, 7) : choices_.power_of_ten(-1.3, 0.3));
            p.centre = place_ + choices_.point(3) * unit_;
            if (how == 2) {  // a ground
                p.radius = unit_ * choices_.power_of_ten(1, out_.extreme ? 7 : 4);
                p.centre = place_ - choices_.direction() * (p.radius + unit_ * choices_.between(-1, 3));
            }
        } else {
            beside(all[choices_.below(static_cast<std::uint32_t>(all.size()))], how, p);
        }
        p.centre = coordinates_in_range(p.centre);
        p.radius = length_in_range(p.radius);
        p.material = choices_.below(static_cast<std::uint32_t>(out_.scene.materials.size()));
        if (choices_.chance(48)) p.emission = power();
        all.push_back(p);
    }

    /// A sphere that has something to do with another one.
    void beside(const Primitive& other, std::uint32_t how, Primitive& p) {
        const glm::dvec3 aside = choices_.direction();
        const double tiny = choices_.power_of_ten(-17, -2);
        p.radius = other.radius;
        p.centre = other.centre;
        switch (how) {
            case 8:  // the same
                break;
            case 9:  // nearly the same
                p.centre += aside * (tiny * other.radius);
                break;
            case 10:
                p.radius *= 1 + tiny;
                break;
            case 11:  // tangent from outside
                p.radius *= choices_.power_of_ten(-3, 3);
                p.centre += aside * (p.radius + other.radius);
                break;
            case 12:  // tangent from within
                p.radius *= choices_.between(0.01, 1);
                p.centre += aside * (other.radius - p.radius);
                break;
            case 13:  // pokes through a little
                p.radius *= choices_.power_of_ten(-3, 0);
                p.centre += aside * (p.radius + other.radius * (1 - tiny));
                break;
            case 14:  // concentric
                p.radius *= choices_.between(0.1, 1);
                break;
            default:  // anywhere within
                p.radius *= choices_.between(0.1, 0.5);
                p.centre += aside * (0.4 * other.radius * choices_.unit());
        }
    }

    /// A place that has something to do with the spheres.
    glm::dvec3 spot() {
        const std::vector<Primitive>& all = out_.scene.primitives;
        const std::uint32_t how = choices_.below(8);
        if (how < 4 || all.empty()) return coordinates_in_range(place_ + choices_.point(5) * unit_);
        const Primitive& p = choices_.one_of(all);
        if (how == 4) return p.centre;
        const double height = how == 5 ? 1 : choices_.between(0, 2);  // on it; in it or above it
        return coordinates_in_range(p.centre + choices_.direction() * (height * p.radius));
    }

    void point_lights() {
        const std::uint32_t count = choices_.below(3);
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::dvec3 at = spot(), intensity = power();
            out_.scene.point_lights.push_back(
                {"l" + std::to_string(i), at, glm::min(intensity * (unit_ * unit_), glm::dvec3(1e29))});
        }
    }

    void camera() {
        Camera& c = out_.scene.camera;
        const bool before = choices_.chance(160);
        c.position = before ? coordinates_in_range(place_ - choices_.direction() * (8 * unit_)) : spot();
        c.target = choices_.chance(64) || out_.scene.primitives.empty() ? coordinates_in_range(place_)
                                                                        : choices_.one_of(out_.scene.primitives).centre;
        if (c.position == c.target) c.target.z += std::max(length_in_range(unit_), std::abs(c.target.z) * 0.5);
        c.fov = choices_.chance(32) ? choices_.between(0.01, 179) : choices_.between(10, 60);
        c.aspect = choices_.chance(16) ? choices_.power_of_ten(-6, 6) : 1;
        if (choices_.chance(48)) {
            c.aperture = length_in_range(unit_ * choices_.power_of_ten(-3, 0));
            c.focal_distance = length_in_range(unit_ * choices_.power_of_ten(-2, 2));
        }
    }

    void background() {
        if (choices_.chance(128)) out_.scene.background = out_.extreme && choices_.chance(16) ? power() : colour();
    }

    Choices& choices_;
    DrawnScene out_;
    double unit_ = 1;
    glm::dvec3 place_{0};
};

bool in_range(const Range& range, double value) { return !expectation(range, value); }
bool in_range(const Range& range, const glm::dvec3& v) {
    return in_range(range, v.x) && in_range(range, v.y) && in_range(range, v.z);
}

}  // namespace

DrawnScene scene_from_bytes(Choices& choices) { return Draw(choices).scene(); }

bool has_contact(const Scene& scene) {
    const std::vector<Primitive>& all = scene.primitives;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double larger = std::max(all[i].radius, all[j].radius),
                         smaller = std::min(all[i].radius, all[j].radius);
            const double apart = glm::length(all[i].centre - all[j].centre);
            const double reach = std::max({larger, glm::length(all[i].centre), glm::length(all[j].centre)});
            if (std::min(std::abs(apart - larger - smaller), std::abs(apart - larger + smaller)) < 1e-4 * reach)
                return true;
        }
    return false;
}

bool in_range(const Scene& scene) {
    const Camera& c = scene.camera;
    bool all = in_range(range::coordinate, c.position) && in_range(range::coordinate, c.target) &&
               in_range(range::length_or_zero, c.aperture) && in_range(range::length, c.focal_distance) &&
               in_range(range::radiance, scene.background);
    for (const Primitive& p : scene.primitives)
        all = all && in_range(range::coordinate, p.centre) && in_range(range::length, p.radius) &&
              (!p.emission || in_range(range::radiance, *p.emission));
    for (const PointLight& l : scene.point_lights)
        all = all && in_range(range::coordinate, l.position) && in_range(range::radiance, l.intensity);
    return all;
}

}  // namespace orrery::fuzz
