#include "reference/optics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace orrery::reference {

using glm::dvec3;

double fresnel(double cosine, double n) {
    const double sine_beyond = std::sqrt(1 - cosine * cosine) / n;
    if (sine_beyond >= 1) return 1;
    const double cosine_beyond = std::sqrt(1 - sine_beyond * sine_beyond);
    const double s = (cosine - n * cosine_beyond) / (cosine + n * cosine_beyond);
    const double p = (n * cosine - cosine_beyond) / (n * cosine + cosine_beyond);
    return (s * s + p * p) / 2;
}

std::array<Lobe, 2> lobes_of(const Material& material, const dvec3& incoming, const dvec3& normal, bool inside) {
    const double cosine = std::min(1.0, -glm::dot(incoming, normal));
    const dvec3 mirrored = glm::normalize(incoming + 2 * cosine * normal);
    if (material.kind == MaterialKind::specular || material.kind == MaterialKind::glossy) {
        return {Lobe{1, material.rho, mirrored, normal}, Lobe{}};
    }
    const double n = inside ? 1 / material.eta : material.eta;
    const double reflected = fresnel(cosine, n);
    std::array<Lobe, 2> lobes{Lobe{reflected, reflected * material.rho, mirrored, normal}, Lobe{}};
    if (reflected < 1) {
        const dvec3 tangential = (incoming + cosine * normal) / n;  // Snell: the tangential part shrinks by n
        const dvec3 refracted = tangential - std::sqrt(1 - glm::dot(tangential, tangential)) * normal;
        // Radiance over index squared is what an interface keeps: L before it is L beyond it times (1 / n)^2.
        lobes[1] = {1 - reflected, (1 - reflected) / (n * n) * material.rho_t, glm::normalize(refracted), -normal};
    }
    return lobes;
}

dvec3 sample_lobe(const Lobe& lobe, double roughness, Random& random) {
    if (roughness == 0) return lobe.axis;
    for (;;) {
        const dvec3 direction = glm::normalize(lobe.axis + roughness * random.on_sphere());
        if (glm::dot(direction, lobe.side) > 0) return direction;
    }
}

double lobe_density(const Lobe& lobe, double roughness, const dvec3& direction) {
    const double cosine = glm::dot(direction, lobe.axis);
    if (cosine <= 0 || glm::dot(direction, lobe.side) <= 0) return 0;
    const double sine = glm::length(glm::cross(direction, lobe.axis));
    if (sine >= roughness) return 0;
    const double beta2 = roughness * roughness, sine2 = sine * sine;
    const double density = (1 - 2 * sine2 + beta2) / (2 * std::numbers::pi * roughness * std::sqrt(beta2 - sine2));
    const double kept = (1 + std::min(1.0, glm::dot(lobe.axis, lobe.side) / roughness)) / 2;
    return density / kept;
}

}  // namespace orrery::reference
