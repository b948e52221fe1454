#include "scene/fingerprint.hpp"

#include <fmt/format.h>

#include <bit>

namespace orrery {
namespace {

/// A hash of numbers in their order.
class Hash {
public:
    void add(std::uint64_t x) {
        // Steele, Lea and Flood's SplitMix64 (2014): a bijection whose every bit of output depends on all of input.
        std::uint64_t z = (state_ ^ x) + 0x9e3779b97f4a7c15;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
        z = (z ^ z >> 27) * 0x94d049bb133111eb;
        state_ = z ^ z >> 31;
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x + 0.0)); }  // -0 is 0
    void add(const glm::dvec3& v) { add(v.x), add(v.y), add(v.z); }

    std::string digits() const { return fmt::format("{:016x}", state_); }

private:
    std::uint64_t state_ = 0;
};

}  // namespace

std::vector<std::pair<std::string, std::string>> fingerprints(const Scene& scene) {
    Hash camera, spheres, point_lights, background;
    const Camera& c = scene.camera;
    camera.add(c.position);
    camera.add(c.target);
    camera.add(c.fov);
    camera.add(c.aspect);
    camera.add(c.aperture);
    if (c.aperture > 0) camera.add(c.focal_distance);
    for (const Primitive& primitive : scene.primitives) {
        const Material& material = scene.materials[primitive.material];
        spheres.add(primitive.centre);
        spheres.add(primitive.radius);
        spheres.add(static_cast<std::uint64_t>(material.kind));
        spheres.add(material.rho);
        spheres.add(material.rho_t);
        spheres.add(material.eta);
        spheres.add(material.roughness);
        spheres.add(std::uint64_t{primitive.emission ? 1u : 0u});
        if (primitive.emission) spheres.add(*primitive.emission);
    }
    for (const PointLight& light : scene.point_lights) {
        point_lights.add(light.position);
        point_lights.add(light.intensity);
    }
    background.add(scene.background);
    const auto counted = [](std::size_t count, const Hash& hash) { return fmt::format("{} {}", count, hash.digits()); };
    return {{"camera", camera.digits()},
            {"spheres", counted(scene.primitives.size(), spheres)},
            {"point lights", counted(scene.point_lights.size(), point_lights)},
            {"background", background.digits()}};
}

}  // namespace orrery
