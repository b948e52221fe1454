#include "reference/reference.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <vector>

#include "reference/optics.hpp"
#include "reference/world.hpp"

namespace orrery::reference {
namespace {

using glm::dvec3;
using statistics::Estimate;
using statistics::RgbEstimate;
using statistics::RunningMoments;

// A hit with all that shading asks about it.
struct Vertex {
    Vertex(const Scene& scene, const Ray& ray, const Hit& hit)
        : sphere(hit.sphere),
          inside(hit.inside),
          primitive(scene.primitives[hit.sphere]),
          material(scene.materials[primitive.material]),
          incoming(ray.direction),
          point(surface_point(primitive, ray, hit.distance)),
          normal((inside ? -1.0 : 1.0) * (point - primitive.centre) / primitive.radius) {}

    bool diffuse() const { return material.kind == MaterialKind::diffuse; }

    std::size_t sphere;
    bool inside;
    const Primitive& primitive;
    const Material& material;
    dvec3 incoming;
    dvec3 point;
    dvec3 normal;  ///< unit, on the side the ray arrived at
};

class Renderer {
public:
    Renderer(const Scene& scene, const Options& options)
        : scene_(scene), options_(options), far_(greatest_distance(scene)) {}

    dvec3 sample(std::uint32_t x, std::uint32_t y, Random& random) const {
        const Ray ray = camera_ray(scene_, x, y, random);
        switch (scene_.settings.integrator) {
            case Integrator::path_tracing:
                return path_traced(ray, random);
            case Integrator::whitted:
                return whitted(ray, scene_.settings.depth, random);
            case Integrator::depth:
                break;
        }
        const Hit hit = closest_hit(scene_.primitives, ray);
        return dvec3{hit.sphere == nothing ? far_ : hit.distance};
    }

private:
    // The rendering equation, one random path: emission counts when the path runs into it.
    dvec3 path_traced(Ray ray, Random& random) const {
        dvec3 radiance{0}, throughput{1};
        bool emission_counted = false;  // at the previous vertex, by area_light
        for (std::uint32_t events = 0;; ++events) {
            const Hit hit = closest_hit(scene_.primitives, ray);
            const bool all = !options_.caustics_alone;
            if (hit.sphere == nothing) return all ? radiance + throughput * scene_.background : radiance;
            const Vertex v(scene_, ray, hit);
            if (v.primitive.emission && !emission_counted && all) radiance += throughput * *v.primitive.emission;
            if (events == scene_.settings.depth) return radiance;

            if (options_.caustics)
                radiance += throughput * from_caustics(v, scene_.settings.depth - events - 1, random);
            if (all) {
                radiance += throughput * from_point_lights(v);
                emission_counted = options_.next_event && v.diffuse();
                if (emission_counted) radiance += throughput * from_area_lights(v, random);
            }
            throughput *= scatter(v, ray, random);
            if (throughput == dvec3{0}) return radiance;
        }
    }

    // L D S* E: follows every specular branch, ends at the first diffuse surface. `depth`: scattering events left.
    dvec3 whitted(const Ray& ray, std::uint32_t depth, Random& random) const {
        const Hit hit = closest_hit(scene_.primitives, ray);
        if (hit.sphere == nothing) return scene_.background;
        const Vertex v(scene_, ray, hit);
        dvec3 radiance = v.primitive.emission.value_or(dvec3{0});
        if (depth == 0) return radiance;
        if (v.diffuse()) return radiance + from_point_lights(v) + from_area_lights(v, random);
        for (const Lobe& lobe : lobes_of(v.material, v.incoming, v.normal, v.inside)) {
            if (lobe.weight == dvec3{0}) continue;
            radiance += lobe.weight * whitted({v.point, lobe.axis, v.sphere}, depth - 1, random);
        }
        return radiance;
    }

    // Turns `ray` into the continuation at `v`; returns its weight.
    dvec3 scatter(const Vertex& v, Ray& ray, Random& random) const {
        if (v.diffuse()) {  // normal + uniform sphere is distributed by the cosine, which leaves rho
            ray = {v.point, glm::normalize(v.normal + random.on_sphere()), v.sphere};
            return v.material.rho;
        }
        const auto lobes = lobes_of(v.material, v.incoming, v.normal, v.inside);
        const Lobe& lobe = random.uniform() < lobes[0].probability ? lobes[0] : lobes[1];
        ray = {v.point, sample_lobe(lobe, v.material.roughness, random), v.sphere};
        return lobe.weight / lobe.probability;
    }

    // Radiance returned at `v` per irradiance on a plane facing `direction`, i.e. f times the cosine.
    dvec3 response(const Vertex& v, const dvec3& direction) const {
        if (v.diffuse()) {
            return v.material.rho * (std::max(0.0, glm::dot(direction, v.normal)) / std::numbers::pi);
        }
        dvec3 sum{0};
        if (v.material.roughness == 0) return sum;  // no direction chosen by a light is ever the mirror's
        for (const Lobe& lobe : lobes_of(v.material, v.incoming, v.normal, v.inside)) {
            if (lobe.probability > 0) sum += lobe.weight * lobe_density(lobe, v.material.roughness, direction);
        }
        return sum;
    }

    dvec3 from_point_lights(const Vertex& v) const {
        dvec3 sum{0};
        for (const PointLight& light : scene_.point_lights) {
            const double distance = glm::length(light.position - v.point);
            const dvec3 direction = (light.position - v.point) / distance;
            const dvec3 returned = response(v, direction);
            if (returned == dvec3{0}) continue;
            if (closest_hit(scene_.primitives, {v.point, direction, v.sphere}).distance < distance) continue;
            sum += returned * light.intensity / (distance * distance);
        }
        return sum;
    }

    // One uniform point y on each emissive sphere. It is seen exactly if the ray towards it meets that sphere first,
    // and from the side that y shows: a convex surface hides its own far side.
    dvec3 from_area_lights(const Vertex& v, Random& random) const {
        dvec3 sum{0};
        for (std::size_t i = 0; i < scene_.primitives.size(); ++i) {
            const Primitive& light = scene_.primitives[i];
            if (!light.emission) continue;
            const dvec3 normal = random.on_sphere();
            const dvec3 apart = light.centre + light.radius * normal - v.point;
            const double distance = glm::length(apart);
            const dvec3 direction = apart / distance;
            const double cosine = glm::dot(direction, normal);
            const Hit hit = closest_hit(scene_.primitives, {v.point, direction, v.sphere});
            if (hit.sphere != i || hit.inside != (cosine > 0)) continue;
            const double area = 4 * std::numbers::pi * light.radius * light.radius;
            sum += response(v, direction) * *light.emission * (area * std::abs(cosine) / (distance * distance));
        }
        return sum;
    }

    bool smooth(const Primitive& sphere) const {
        const MaterialKind kind = scene_.materials[sphere.material].kind;
        return kind == MaterialKind::specular || kind == MaterialKind::dielectric;
    }

    // Point lights over one smooth sphere that has vertex and light outside: off it, through it, or after one
    // reflection within. Random directions towards the sphere; `depth`: scattering events left.
    dvec3 from_caustics(const Vertex& v, std::uint32_t depth, Random& random) const {
        dvec3 sum{0};
        if (smooth(v.primitive) || scene_.point_lights.empty()) return sum;
        for (std::size_t i = 0; i < scene_.primitives.size(); ++i) {
            const Primitive& ball = scene_.primitives[i];
            const double sine = ball.radius / glm::length(ball.centre - v.point);
            if (!smooth(ball) || sine >= 1) continue;
            const double least_cosine = std::sqrt(1 - sine * sine);
            const double solid_angle = 2 * std::numbers::pi * (1 - least_cosine);
            for (std::uint32_t n = 0; n < options_.caustic_directions; ++n) {
                const dvec3 direction = random.in_cone(ball.centre - v.point, least_cosine);
                const dvec3 returned = response(v, direction);
                if (returned == dvec3{0}) continue;
                dvec3 arriving{0};
                for (std::uint32_t chords = 0; chords < std::min(depth, 3u); ++chords) {
                    arriving += over_ball(i, chords, {v.point, direction, v.sphere});
                }
                sum += returned * arriving * solid_angle;
            }
        }
        return sum / static_cast<double>(options_.caustic_directions);
    }

    // Radiance of the point lights, as small spheres, where `ray` ends after `chords` chords within the ball.
    dvec3 over_ball(std::size_t ball, std::uint32_t chords, Ray ray) const {
        const Primitive& sphere = scene_.primitives[ball];
        dvec3 weight{1};
        for (std::uint32_t event = 0; event <= chords; ++event) {
            const Hit hit = closest_hit(scene_.primitives, ray);
            if (hit.sphere != ball) return dvec3{0};
            const Vertex v(scene_, ray, hit);
            const bool through = chords > 0 && (event == 0 || event == chords);
            const Lobe lobe = lobes_of(v.material, v.incoming, v.normal, v.inside)[through ? 1 : 0];
            weight *= lobe.weight;
            if (weight == dvec3{0}) return weight;
            ray = {v.point, lobe.axis, ball};
        }
        const double free = closest_hit(scene_.primitives, ray).distance;
        dvec3 sum{0};
        for (const PointLight& light : scene_.point_lights) {
            const double gap = glm::length(light.position - sphere.centre) - sphere.radius;
            const double radius = options_.lamp_radius * gap;
            const dvec3 apart = light.position - ray.origin;
            const double along = glm::dot(apart, ray.direction);
            if (gap <= 0 || along <= 0 || along >= free) continue;
            // Over the disc these weights have mean 1 and no second moment, which leaves an error of fourth order.
            const dvec3 aside = (apart - along * ray.direction) / radius;
            const double square = glm::dot(aside, aside);
            if (square < 1) sum += light.intensity * ((4 - 6 * square) / (std::numbers::pi * radius * radius));
        }
        return weight * sum;
    }

    const Scene& scene_;
    const Options& options_;
    double far_;
};

// Runs task(i) for i < count on some threads; which one runs which is no matter.
template <typename Task>
void parallel_for(std::size_t count, unsigned threads, const Task& task) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::exception_ptr> failures(threads);
    const auto work = [&](unsigned me) {
        try {
            for (std::size_t i = next++; i < count; i = next++) task(i);
        } catch (...) {
            failures[me] = std::current_exception();
        }
    };
    std::vector<std::thread> pool;
    for (unsigned t = 1; t < threads; ++t) pool.emplace_back(work, t);
    work(0);
    for (std::thread& thread : pool) thread.join();
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

// I' = 1 - I/(1+I); its variance to first order in that of I.
Estimate post_processed(const Estimate& distance) {
    const double scaled = 1 / (1 + distance.mean);
    return {scaled, distance.variance * std::pow(scaled, 4), distance.degrees};
}

}  // namespace

statistics::BlockImage render(const Scene& scene, const Options& options) {
    const std::uint32_t width = scene.settings.width, height = scene.settings.height;
    const std::uint32_t samples = options.samples > 0 ? options.samples : scene.settings.samples;
    const bool post_process = options.post_process && scene.settings.integrator == Integrator::depth;
    const Renderer renderer(scene, options);
    std::vector<RgbEstimate> pixels(std::size_t{width} * height);
    const unsigned threads = options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
    parallel_for(pixels.size(), threads, [&](std::size_t i) {
        Random random(options.seed, i);
        std::array<RunningMoments, 3> moments;
        for (std::uint32_t s = 0; s < samples; ++s) {
            const dvec3 value =
                renderer.sample(static_cast<std::uint32_t>(i % width), static_cast<std::uint32_t>(i / width), random);
            if (!std::isfinite(value.x + value.y + value.z)) throw std::domain_error("a sample is not finite");
            for (int channel = 0; channel < 3; ++channel) {
                moments[static_cast<std::size_t>(channel)].add(value[channel]);
            }
        }
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const Estimate estimate = estimate_of(moments[channel]);
            pixels[i][channel] = post_process ? post_processed(estimate) : estimate;
        }
    });
    return blocks_of_pixels(width, height, pixels, options.block_size);
}

}  // namespace orrery::reference
