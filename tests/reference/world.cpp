#include "reference/world.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace orrery::reference {

using glm::dvec3;

Hit closest_hit(const std::vector<Primitive>& spheres, const Ray& ray) {
    Hit closest;
    const auto offer = [&closest](double distance, std::size_t sphere, bool inside) {
        if (distance > 0 && distance < closest.distance) closest = {distance, sphere, inside};
    };
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const dvec3 f = ray.origin - spheres[i].centre;
        const double r = spheres[i].radius;
        const double b = glm::dot(f, ray.direction);
        if (i == ray.left) {  // |f| = r: the roots are 0, where it left, and -2b, across the inside
            offer(-2 * b, i, true);
            continue;
        }
        const dvec3 nearest = f - b * ray.direction;  // from the centre to the line
        const double discriminant = r * r - glm::dot(nearest, nearest);
        if (discriminant <= 0) continue;
        // t^2 + 2bt + c = 0. The root without cancellation first, the other from their product c.
        const double distance = glm::length(f);
        const double c = (distance - r) * (distance + r);
        const double first = -b - std::copysign(std::sqrt(discriminant), b);
        const double second = c / first;
        const auto [near, far] = std::minmax(first, second);
        if (near > 0) {
            offer(near, i, false);
        } else {
            offer(far, i, true);
        }
    }
    return closest;
}

dvec3 surface_point(const Primitive& sphere, const Ray& ray, double distance) {
    const dvec3 point = ray.origin + distance * ray.direction;
    return sphere.centre + sphere.radius * glm::normalize(point - sphere.centre);
}

Ray camera_ray(const Scene& scene, std::uint32_t x, std::uint32_t y, Random& random) {
    const Camera& camera = scene.camera;
    const dvec3 z_axis = glm::normalize(camera.target - camera.position);
    dvec3 across = glm::cross(dvec3{0, 1, 0}, z_axis);
    if (glm::length(across) < 1e-12) across = glm::cross(dvec3{0, 0, 1}, z_axis);
    const dvec3 x_axis = glm::normalize(across);
    const dvec3 y_axis = glm::cross(z_axis, x_axis);

    const double half_height = std::tan(glm::radians(camera.fov) / 2);
    const double u = (2 * (x + random.uniform()) / scene.settings.width - 1) * half_height * camera.aspect;
    const double v = (1 - 2 * (y + random.uniform()) / scene.settings.height) * half_height;
    const dvec3 through = z_axis + u * x_axis + v * y_axis;
    if (camera.aperture == 0) return {camera.position, glm::normalize(through)};

    const dvec3 in_focus = camera.position + camera.focal_distance * through;
    const dvec3 disk = random.in_disk() * (camera.aperture / 2);
    const dvec3 on_lens = camera.position + disk.x * x_axis + disk.y * y_axis;
    return {on_lens, glm::normalize(in_focus - on_lens)};
}

double greatest_distance(const Scene& scene) {
    double farthest = 0.5;
    for (const Primitive& p : scene.primitives) {
        farthest =
            std::max(farthest, glm::length(p.centre - scene.camera.position) + p.radius + scene.camera.aperture / 2);
    }
    return 2 * farthest;
}

}  // namespace orrery::reference
