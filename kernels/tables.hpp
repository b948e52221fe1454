// What a kernel reads about the scene: flat arrays it does not own, and small structs of numbers.
//
// Filled by src/plan, one column per attribute. Lengths are in scene units; the program has none of its own.
#pragma once

#include <cstdint>
#include <iterator>

#include "kernels/common.hpp"

namespace orrery::kernels {

/// How a surface scatters: a row each in scattering_traits, in whose order the wave sorts its hits.
enum class Scattering : std::uint32_t { diffuse, specular, glossy, dielectric, translucent };

/// By which density a vertex scatters, where lights are sampled from it; none: into single directions.
enum class Response : std::uint32_t { diffuse, glossy, none };

/// All that the program has to know of a way of scattering, but for the scattering itself (scatter.hpp).
struct ScatteringTraits {
    const char* name;
    int dimensions;  ///< random numbers that an event takes
    Response response;
    bool is_interface;       ///< light may pass through the surface
    Scattering unperturbed;  ///< what is left of it without roughness, as Whitted ray tracing has it
    constexpr bool is_rough() const { return response == Response::glossy; }
};
inline constexpr ScatteringTraits scattering_traits[] = {
    {"diffuse", 2, Response::diffuse, false, Scattering::diffuse},
    {"specular", 0, Response::none, false, Scattering::specular},
    {"glossy", 2, Response::glossy, false, Scattering::specular},
    {"dielectric", 3, Response::none, true, Scattering::dielectric},
    {"translucent", 3, Response::glossy, true, Scattering::dielectric},
};
inline constexpr std::uint32_t scattering_count = std::size(scattering_traits);

constexpr const ScatteringTraits& traits_of(Scattering kind) {
    return scattering_traits[static_cast<std::size_t>(kind)];
}
constexpr std::uint32_t bit_of(Scattering kind) { return 1u << static_cast<unsigned>(kind); }
/// Bits of the ways of scattering whose traits hold for `holds`.
template <class Holds>
constexpr std::uint32_t scattering_where(const Holds& holds) {
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < scattering_count; ++k) bits |= holds(scattering_traits[k]) ? 1u << k : 0u;
    return bits;
}

/// A sphere's `surface` word: the material's index, its Scattering above that, and whether it emits on top.
inline constexpr std::uint32_t surface_material_bits = 24;
inline constexpr std::uint32_t surface_material_mask = (1u << surface_material_bits) - 1;
inline constexpr std::uint32_t surface_emits = 1u << 31;
inline constexpr std::uint32_t surface_kind_mask = 0x7F;

/// A sphere reference with a side in the top bit: `id | inside_bit` is the sphere's inner side.
inline constexpr std::uint32_t inside_bit = 1u << 31;
inline constexpr std::uint32_t no_sphere = 0x7FFFFFFFu;

// Many spheres: a tree of bounding boxes, sixteen to a node. Leaves are runs of up to sixteen neighbours in the sphere
// table itself, whose order is the tree's: a leaf is where its run begins, and a sphere's id remains its place. Built
// by src/plan/tree.hpp, traversed by tree_traverse.hpp.

/// Children of a node and spheres of a leaf: one vector of the widest instruction set.
inline constexpr std::uint32_t tree_width = 16;
/// No path from the root passes more nodes than this; the builder sees to it.
inline constexpr std::uint32_t tree_depth = 64;
/// A child that is a leaf: leaf_bit | first sphere.
inline constexpr std::uint32_t leaf_bit = 1u << 31;

/// Sixteen boxes; those of unused children lie at low = +inf, high = -inf and are met by no ray.
template <class Real>
struct alignas(64) TreeNode {
    Real bound[6][tree_width];        ///< low x, high x, low y, high y, low z, high z
    std::uint32_t child[tree_width];  ///< a node, or a leaf where leaf_bit is set
    /// Children front to back, four bits each, by octant: bit a of the index is set where a ray runs down axis a.
    std::uint64_t order[8];
};

template <class Real>
struct SphereTree {
    std::uint32_t count = 0;                ///< nodes; 0: no tree
    const TreeNode<Real>* nodes = nullptr;  ///< the root first
    Real extent = 0;                        ///< the largest magnitude of a bound's coordinate
};

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
    const Word* light = nullptr;    ///< index into the lights where surface_emits is set, else 0
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

/// All lights, points first: a point, or a sphere that emits on both sides.
template <class Real>
struct LightTable {
    using Word = WordOf<Real>;
    std::uint32_t points = 0;  ///< how many of them are points
    std::uint32_t count = 0;
    const Real* px = nullptr;  ///< a point's position, a sphere's centre
    const Real* py = nullptr;
    const Real* pz = nullptr;
    const Real* radius = nullptr;  ///< 0 for a point
    const Real* r = nullptr;       ///< a point's radiant intensity in W/sr, a sphere's radiance
    const Real* g = nullptr;
    const Real* b = nullptr;
    const Word* sphere = nullptr;  ///< no_sphere for a point

    // How a vertex chooses one of them, by Walker's alias method. Cells are equally likely, and each belongs to its own
    // light as far as `share`, to the light `other` beyond.
    std::uint32_t cells = 0;      ///< a power of two <= 2^24, so that the top bits of a random number are a cell; 0: a
                                  ///< vertex samples all lights, and the other columns are null
    const Real* share = nullptr;  ///< a multiple of 2^-24 in [0, 1]: no random number is rounded to the other side
    const Word* other = nullptr;
    const Real* probability = nullptr;  ///< of choosing the light
    const Real* inverse_probability = nullptr;
};

/// How many chords of light within a ball a Caustic may have: reflected off it, straight through, and after one to
/// three reflections inside.
inline constexpr std::uint32_t most_chords = 4;
/// The same where point lights are looked for.
inline constexpr std::uint32_t most_point_chords = 2;
/// Steps of the impact parameter between which a Caustic is looked for, at most.
inline constexpr std::uint32_t most_caustic_steps = 24;

/// Light of one area light that reaches a vertex over one smooth sphere, the ball, by a number of chords within it. All
/// normals of a ball pass its centre, so that such a path stays in a plane and passes the centre at the same distance
/// s, its impact parameter, before and after every event. Over a glossy sphere light comes by its lobe: what is looked
/// for is the mirrored direction, in a lamp as much larger as the lobe is wide.
template <class Real>
struct Caustic {
    std::uint32_t ball, light, lamp;  ///< sphere, light, and the light's sphere
    std::uint32_t chords;             ///< <= most_chords
    bool obstructed;                  ///< some other surface may cut the chords
    Real cx, cy, cz, radius, radius2;
    Real eta;             ///< of the ball, inside over outside; of a mirror without meaning
    bool mirror;          ///< smooth or not, it only reflects
    Real roughness;       ///< of a glossy ball; 0: smooth
    Real wx, wy, wz;      ///< from the ball's centre to the lamp's
    Real lamp_radius;     ///< where directions are looked for
    Real r, g, b;         ///< the lamp's radiance times what the ball's surface leaves of it, Fresnel's share apart
    Real share;           ///< of the samples over its ball
    std::uint32_t steps;  ///< <= most_caustic_steps
    /// At impact parameter s the events turn the direction; that angle less asin(s / distance) is what the vertex sees.
    struct Step {
        Real s, sine, cosine;
        Real share;  ///< Fresnel's, of all events
    } step[most_caustic_steps + 1];
};

/// Balls whose caustics are sampled, at most.
inline constexpr std::uint32_t most_caustic_groups = 8;
/// The caustics of one ball, `first` and those behind it.
template <class Real>
struct CausticGroup {
    std::uint32_t first, count;
    Real rate;  ///< how often they are sampled, over what a vertex knows of the ball (caustic.hpp)
};

/// Smooth spheres that point lights may be seen over: the leaves of a binary tree, by which a vertex chooses one. Node
/// 1 is the root, and nodes 2k and 2k + 1 are below node k; leaves are the last 2^levels.
template <class Real>
struct SpheresOverPoints {
    std::uint32_t levels = 0;  ///< below the root
    bool obstructed = false;   ///< some other surface may cut chords within some of them
    const Real* cx = nullptr;  ///< by node: a sphere around all spheres below it
    const Real* cy = nullptr;
    const Real* cz = nullptr;
    const Real* reach = nullptr;           ///< its radius
    const Real* area = nullptr;            ///< sum of their squared radii; 0 where there is none
    const WordOf<Real>* sphere = nullptr;  ///< by leaf
    Real rate = 0;                         ///< how often one is asked, over what may come of it
};

/// All that are sampled. A vertex samples one of those of area lights at most.
template <class Real>
struct CausticTable {
    std::uint32_t count = 0, groups = 0;
    const Caustic<Real>* entries = nullptr;
    const CausticGroup<Real>* group = nullptr;
    Real carried = 1;  ///< what an event leaves of the throughput, about: by that, later vertices sample less often
    SpheresOverPoints<Real> over_points{};  ///< null columns without Needs::point_caustics
};

/// Spots that rays are guided to, at most.
inline constexpr std::uint32_t most_spots = 4;
/// Diffuse balls as lamps beside them light them (guide.hpp); columns by spot.
template <class Real>
struct GuideTable {
    std::uint32_t count = 0;
    const WordOf<Real>* ball = nullptr;  ///< sphere
    const Real* cx = nullptr;            ///< its centre
    const Real* cy = nullptr;
    const Real* cz = nullptr;
    const Real* radius = nullptr;
    const Real* px = nullptr;  ///< its point nearest to the lamp's centre, which is outside
    const Real* py = nullptr;
    const Real* pz = nullptr;
    const Real* nx = nullptr;  ///< from the ball's centre towards the lamp's, unit length
    const Real* ny = nullptr;
    const Real* nz = nullptr;
    const Real* gap = nullptr;         ///< of the lamp's centre and the ball
    const Real* cone = nullptr;        ///< 1 - cos of the half angle that the ball subtends from the lamp
    const Real* brightness = nullptr;  ///< what the spot sends on for its area, the brightest being 1
    // Inverses and ratios of these.
    const Real* inverse_width = nullptr;  ///< of the spot: the gap, or the radius where that is less
    const Real* inverse_radius = nullptr;
    const Real* sine = nullptr;       ///< of that half angle, radius / (radius + gap)
    const Real* gap_share = nullptr;  ///< gap / (radius + gap)
    const Real* scale = nullptr;      ///< sine^2 over the cone's solid angle
};

/// The radiance of the enclosing volume.
template <class Real>
struct Background {
    Real r = 0, g = 0, b = 0;
    ORRERY_INLINE bool shines() const { return r != 0 || g != 0 || b != 0; }
};

/// How a direction towards an area light is drawn, or what is done in place of that.
enum class LightStrategy : std::uint32_t {
    area,  ///< uniform over the surface
    cone,  ///< uniform over the subtended solid angle; from inside the light, area
    exact  ///< from outside light samples alone count: at diffuse vertices the closed form, or else by the cone, at
           ///< rough ones the lobe's own directions within the cone; from inside the light, area
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

// Those of a type of lanes, for short.
template <class V>
using Spheres = SphereTable<typename V::Real>;
template <class V>
using Materials = MaterialTable<typename V::Real>;
template <class V>
using Lights = LightTable<typename V::Real>;

}  // namespace orrery::kernels
