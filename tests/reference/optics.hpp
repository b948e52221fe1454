// How a ray leaves a surface (scenes/README.md): Fresnel, Snell and the rough cone about both.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "reference/random.hpp"
#include "scene/scene.hpp"

namespace orrery::reference {

/// Unpolarised reflectance at a smooth interface. `n` is the index beyond over the index before it, `cosine` > 0 that
/// of the angle of incidence; 1 under total internal reflection.
double fresnel(double cosine, double n);

/// One way to leave a surface: along `axis`, or by a rough material near it.
struct Lobe {
    double probability = 0;  ///< of a path taking this way; 0 where there is no such way
    glm::dvec3 weight{0};    ///< radiance returned per radiance arriving along it (probability not divided out)
    glm::dvec3 axis{0};      ///< R, the unperturbed direction
    glm::dvec3 side{0};      ///< unit normal of the half space the lobe is in
};

/// The lobes of any material but diffuse: reflected, then transmitted. `normal` faces the side `incoming` (pointing at
/// the surface) arrives from; `inside` says that this is the inside of the sphere.
std::array<Lobe, 2> lobes_of(const Material& material, const glm::dvec3& incoming, const glm::dvec3& normal,
                             bool inside);

/// unit(R + beta S), S uniform on the unit sphere, again and again until it leaves on the lobe's side.
/// Brute force on purpose: the closed forms elsewhere are tested against it.
glm::dvec3 sample_lobe(const Lobe& lobe, double roughness, Random& random);

/// Density per solid angle of what sample_lobe returns; roughness > 0.
double lobe_density(const Lobe& lobe, double roughness, const glm::dvec3& direction);

}  // namespace orrery::reference
