// What a kernel reads about the scene: flat arrays it does not own, and small structs of numbers.
//
// Filled by src/plan, one column per attribute. Lengths are in scene units; the program has none of its own.
#pragma once

#include <cstdint>

#include "kernels/lanes.hpp"
#include "kernels/tree.hpp"

namespace orrery::kernels {

/// How a surface scatters. The order is the order in which the wave sorts its hits.
enum class Scattering : std::uint32_t { diffuse, specular, glossy, dielectric, translucent };
inline constexpr std::uint32_t scattering_count = 5;

/// A sphere's `surface` word: the material's index, its Scattering above that, and whether it emits on top.
inline constexpr std::uint32_t surface_material_bits = 24;
inline constexpr std::uint32_t surface_material_mask = (1u << surface_material_bits) - 1;
inline constexpr std::uint32_t surface_emits = 1u << 31;
inline constexpr std::uint32_t surface_kind_mask = 0x7F;

/// A sphere reference with a side in the top bit: `id | inside_bit` is the sphere's inner side.
inline constexpr std::uint32_t inside_bit = 1u << 31;
inline constexpr std::uint32_t no_sphere = 0x7FFFFFFFu;

/// Columns of every table are readable up to a whole vector behind the last entry.
template <class Real>
struct SphereTable {
    using Word = WordOf<Real>;
    std::uint32_t count = 0;
    const Real* cx = nullptr;
    const Real* cy = nullptr;
    const Real* cz = nullptr;
    const Real* radius = nullptr;   ///< > 0
    const Real* radius2 = nullptr;  ///< radius * radius in Real, so a sphere whose radius is half an ulp off
    const Real* inverse_radius = nullptr;
    const Word* surface = nullptr;  ///< see surface_material_bits
    const Word* light = nullptr;    ///< index into the area lights where surface_emits is set, else 0
    SphereTree<Real> tree{};
};

template <class Real>
struct MaterialTable {
    std::uint32_t count = 0;
    const Real* rho_r = nullptr;  ///< reflectance (rhoR of a dielectric), [0, 1]
    const Real* rho_g = nullptr;
    const Real* rho_b = nullptr;
    const Real* tau_r = nullptr;  ///< rhoT, [0, 1]
    const Real* tau_g = nullptr;
    const Real* tau_b = nullptr;
    const Real* eta = nullptr;        ///< index of refraction, inside over outside, > 0
    const Real* roughness = nullptr;  ///< beta, [0, 1)
};

template <class Real>
struct PointLight {
    Real px, py, pz;
    Real r, g, b;  ///< radiant intensity, W/sr
};

/// A sphere that emits the radiance (r, g, b) on both sides.
template <class Real>
struct AreaLight {
    std::uint32_t sphere = 0;
    Real cx, cy, cz, radius;
    Real r, g, b;
};

/// The lights of which a vertex samples one, and how it is chosen: by Walker's alias method. Cells are equally likely,
/// and each belongs to its own light as far as `share`, to the light `other` beyond.
template <class Real>
struct LightTable {
    using Word = WordOf<Real>;
    std::uint32_t cells = 0;  ///< a power of two <= 2^24, so that the top bits of a random number are a cell; 0: unused
    const Real* share = nullptr;  ///< a multiple of 2^-24 in [0, 1]: no random number is rounded to the other side
    const Word* other = nullptr;

    std::uint32_t count = 0;   ///< of lights, <= cells
    const Real* px = nullptr;  ///< a point light's position, an area light's centre
    const Real* py = nullptr;
    const Real* pz = nullptr;
    const Real* radius = nullptr;  ///< 0 for a point light
    const Real* r = nullptr;       ///< radiant intensity or radiance
    const Real* g = nullptr;
    const Real* b = nullptr;
    const Real* inverse_probability = nullptr;  ///< of choosing it, >= 1
    const Word* sphere = nullptr;               ///< no_sphere for a point light
};

/// What an area light emits, by light index, for rays that run into one.
template <class Real>
struct EmissionTable {
    std::uint32_t count = 0;
    const Real* r = nullptr;
    const Real* g = nullptr;
    const Real* b = nullptr;
    const Real* probability = nullptr;  ///< that a vertex samples this light; null where every vertex samples all
    Real background_r = 0, background_g = 0, background_b = 0;
    bool has_background = false;
    bool has_emitters = false;
};

/// How a direction towards an area light is drawn.
enum class LightStrategy : std::uint32_t {
    area,  ///< uniform over the surface
    cone,  ///< uniform over the subtended solid angle; from inside the light, area
};

/// Camera frame. A ray through (x, y) of the image plane at distance 1 has the direction unit(x X + y Y + Z).
template <class Real>
struct CameraTable {
    Real px, py, pz;
    Real xx, xy, xz, yx, yy, yz, zx, zy, zz;  ///< orthonormal X (right), Y (up), Z (ahead)
    Real cell_width, cell_height;  ///< the jittered part of a pixel, in image-plane units; height < 0 is down
    Real lens_radius;              ///< 0: pinhole
    Real focal_distance;           ///< along Z
};

}  // namespace orrery::kernels
