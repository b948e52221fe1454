// The queues between the stages: structures of arrays.
//
// Each queue's fields are declared once, with unit and range, and listed once in each_field, which calls its argument
// with every field's name and member pointer; allocation, compaction, sorting and the bytes-per-ray figure are written
// on top of that list. All fields are as wide as a number. A field the plan does not need is a null pointer.
//
// Common to all queues: owned by one thread; allocated once per thread; capacities are whole vectors of the widest
// instruction set, so kernels have no tail code and may write garbage behind the last item. Entries are only ever
// appended or compacted in order, never reordered among equals: the order of a path's contributions is its own history.
#pragma once

#include <cstdint>

#include "kernels/tables.hpp"

namespace orrery::kernels {

/// The most lanes any kernel works on at once (two AVX-512 vectors); every capacity is a multiple.
inline constexpr std::uint32_t widest = 32;

/// Rays bounded together, and rays that go down a tree together. Fewer waste the bound, more widen it.
inline constexpr std::uint32_t packet_size = 256;

ORRERY_INLINE constexpr std::uint32_t round_up(std::uint32_t n) { return (n + widest - 1) / widest * widest; }

/// Rays in flight, one bounce number for all (Whitted: one live ray per slot).
template <class Real>
struct RayQueue {
    using Word = WordOf<Real>;
    Real *ox, *oy, *oz;    ///< origin, scene units
    Real *dx, *dy, *dz;    ///< direction, unit length
    Real *tr, *tg, *tb;    ///< throughput, >= 0; all zero marks a dead ray
    Real* pdf;             ///< density of the scattering that made the direction, per solid angle, as far as emission
                           ///< found by this ray competes with light samples: +inf counts it whole, 0 not at all.
                           ///< Null where the plan has no such competition.
    Real* roulette_scale;  ///< what of the throughput roulette must not see: (eta_i / eta_t)^2 of refractions, what
                           ///< guided rays are weighed by. Null without either.
    Word* departed;        ///< sphere the ray leaves, inside_bit set when it runs inward; no_sphere from the camera
    Word* slot;            ///< which (pixel, sample) of the wave
    Word* pixel;  ///< the slot's pixel and sample, of Sobol's sequences with bits reversed: keys of randomness, carried
    Word* sample;  ///< along, as moving two words with the ray costs less than gathering them by slot at four uses
    Word* vertex;  ///< Whitted: the ray's node in the slot's ray tree, root 1, children 2n and 2n + 1. Null for paths,
                   ///< where all rays have the number of the bounce.

    template <class Visit>
    ORRERY_INLINE static void each_field(Visit&& visit) {
        visit("ox", &RayQueue::ox), visit("oy", &RayQueue::oy), visit("oz", &RayQueue::oz);
        visit("dx", &RayQueue::dx), visit("dy", &RayQueue::dy), visit("dz", &RayQueue::dz);
        visit("tr", &RayQueue::tr), visit("tg", &RayQueue::tg), visit("tb", &RayQueue::tb);
        visit("pdf", &RayQueue::pdf), visit("roulette_scale", &RayQueue::roulette_scale);
        visit("departed", &RayQueue::departed), visit("slot", &RayQueue::slot);
        visit("pixel", &RayQueue::pixel), visit("sample", &RayQueue::sample), visit("vertex", &RayQueue::vertex);
    }
};

/// What each ray of a RayQueue met, in the same order.
template <class Real>
struct HitQueue {
    using Word = WordOf<Real>;
    Real* t;   ///< distance, > 0; +inf where nothing was hit
    Word* id;  ///< sphere, inside_bit set when met from inside; no_sphere where nothing was hit

    template <class Visit>
    ORRERY_INLINE static void each_field(Visit&& visit) {
        visit("t", &HitQueue::t), visit("id", &HitQueue::id);
    }
};

/// The unperturbed direction of the lobe a glossy or translucent vertex scattered into, beside the RayQueue. Only
/// present where lights are sampled from such vertices.
template <class Real>
struct LobeQueue {
    using Word = WordOf<Real>;
    Real *x, *y, *z;  ///< unit length

    template <class Visit>
    ORRERY_INLINE static void each_field(Visit&& visit) {
        visit("lobe_x", &LobeQueue::x), visit("lobe_y", &LobeQueue::y), visit("lobe_z", &LobeQueue::z);
    }
};

/// Segments towards lights, with the radiance that arrives if nothing blocks them.
template <class Real>
struct ShadowQueue {
    using Word = WordOf<Real>;
    Real *ox, *oy, *oz;   ///< origin, scene units
    Real *dx, *dy, *dz;   ///< direction, unit length
    Real* inverse_t_max;  ///< 1 / distance to the light; what the occlusion test wants
    Real *r, *g, *b;      ///< contribution if unoccluded
    Word* departed;       ///< as in RayQueue
    Word* slot;
    Word* target;  ///< sphere the segment ends on, no_sphere for a point light. Null where all of a queue end on one.

    template <class Visit>
    ORRERY_INLINE static void each_field(Visit&& visit) {
        visit("ox", &ShadowQueue::ox), visit("oy", &ShadowQueue::oy), visit("oz", &ShadowQueue::oz);
        visit("dx", &ShadowQueue::dx), visit("dy", &ShadowQueue::dy), visit("dz", &ShadowQueue::dz);
        visit("inverse_t_max", &ShadowQueue::inverse_t_max);
        visit("r", &ShadowQueue::r), visit("g", &ShadowQueue::g), visit("b", &ShadowQueue::b);
        visit("departed", &ShadowQueue::departed), visit("slot", &ShadowQueue::slot);
        visit("target", &ShadowQueue::target);
    }
};

/// Numbers in [0, 1) drawn for the rays of a queue ahead of the stage that uses them, in the same order.
template <class Real>
struct SobolQueue {
    using Word = WordOf<Real>;
    Real *x, *y, *z, *w;

    template <class Visit>
    ORRERY_INLINE static void each_field(Visit&& visit) {
        visit("sobol_x", &SobolQueue::x), visit("sobol_y", &SobolQueue::y);
        visit("sobol_z", &SobolQueue::z), visit("sobol_w", &SobolQueue::w);
    }
};

/// How a path came from its last vertex of no delta to where it is, as far as that was over one smooth sphere; by slot.
/// Written at smooth spheres only.
template <class Real>
struct ChainTable {
    using Word = WordOf<Real>;
    Word* state;         ///< one of the words below with the number of chords, or 0: not over one smooth sphere
    Word* ball;          ///< the smooth sphere
    Word* departed;      ///< the vertex's sphere and side
    Real *x, *y, *z;     ///< the vertex
    Real *dx, *dy, *dz;  ///< direction from it to the ball, unit length
    Real* pdf;           ///< density of that direction times Fresnel's probability of what happened at the ball

    template <class Visit>
    ORRERY_INLINE static void each_field(Visit&& visit) {
        visit("state", &ChainTable::state), visit("ball", &ChainTable::ball);
        visit("departed", &ChainTable::departed);
        visit("x", &ChainTable::x), visit("y", &ChainTable::y), visit("z", &ChainTable::z);
        visit("dx", &ChainTable::dx), visit("dy", &ChainTable::dy), visit("dz", &ChainTable::dz);
        visit("pdf", &ChainTable::pdf);
    }
};
inline constexpr std::uint32_t chain_chords = 7;   ///< mask; seven or more count as seven
inline constexpr std::uint32_t chain_open = 8;     ///< the path is within the ball
inline constexpr std::uint32_t chain_closed = 16;  ///< it has left it
inline constexpr std::uint32_t chain_begun = 32;   ///< it has met it, what happened there is still open

/// Vertices that sample a caustic, or look for point lights over a sphere.
template <class Real>
struct PickQueue {
    using Word = WordOf<Real>;
    Word* place;        ///< in the ray queue
    Word* caustic;      ///< which one; or the sphere
    Real* probability;  ///< of sampling any of its group; or of asking that sphere

    template <class Visit>
    ORRERY_INLINE static void each_field(Visit&& visit) {
        visit("place", &PickQueue::place), visit("caustic", &PickQueue::caustic);
        visit("probability", &PickQueue::probability);
    }
};

/// The (pixel, sample) pairs of a wave, indexed by slot.
template <class Real>
struct SlotTable {
    using Word = WordOf<Real>;
    Word* pixel;              ///< y * width + x
    Word* sample;             ///< sample number within the pixel
    Real *plane_x, *plane_y;  ///< corner of the sample's cell on the image plane at distance 1
    Real* radiance;           ///< gathered so far: r, g, b and one unused, four numbers per slot
    SobolQueue<Real> sobol;   ///< present where samples are those of Sobol's sequences
    ChainTable<Real> chains;  ///< present where caustics are sampled

    template <class Visit>
    ORRERY_INLINE static void each_field(Visit&& visit) {
        visit("pixel", &SlotTable::pixel), visit("sample", &SlotTable::sample);
        visit("plane_x", &SlotTable::plane_x), visit("plane_y", &SlotTable::plane_y);
        visit("radiance", &SlotTable::radiance);
    }
};

/// Whitted's postponed branches: a small stack per slot, entry `level * slots + slot`.
template <class Real>
struct BranchStack {
    using Word = WordOf<Real>;
    std::uint32_t slots = 0;  ///< stride between levels
    Word* height = nullptr;   ///< by slot: pending branches
    RayQueue<Real> rays{};    ///< as many levels of `slots` entries as the greatest depth, since depth-first one branch
                              ///< a level is pending at most; without pixel and sample, which the slot knows
};

/// A run of a queue; begin is a multiple of `widest`.
struct Range {
    std::uint32_t begin = 0;
    std::uint32_t count = 0;
};

/// A ray queue split by way of scattering, in enum order. Between runs lies anything.
struct Runs {
    Range run[scattering_count];
    bool moved = false;  ///< by sorting: the records stand in the other queues
};

/// What a run of `count` records takes of a queue: compress writes whole vectors, up to one less than `widest` records
/// behind the last, and the next run begins on a whole vector behind that.
ORRERY_INLINE constexpr std::uint32_t padded_run(std::uint32_t count) { return round_up(count + widest - 1); }

/// What a ray queue must hold for a wave of `slots`, whichever way it is sorted: a run of n takes at most
/// n + 2 (widest - 1) places.
ORRERY_INLINE constexpr std::uint32_t ray_capacity(std::uint32_t slots) {
    return round_up(slots + scattering_count * 2 * widest);
}

// Those of a type of lanes, for short.
template <class V>
using Rays = RayQueue<typename V::Real>;
template <class V>
using Hits = HitQueue<typename V::Real>;
template <class V>
using Lobes = LobeQueue<typename V::Real>;
template <class V>
using Shadows = ShadowQueue<typename V::Real>;
template <class V>
using Slots = SlotTable<typename V::Real>;
template <class V>
using Picks = PickQueue<typename V::Real>;

}  // namespace orrery::kernels
