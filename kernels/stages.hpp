// The stages as a table of function pointers, one table per instruction set, chosen once at start-up.
//
// Every pointer does what the template of the same name documents (generate.hpp, loop.hpp, ...).
#pragma once

#include "kernels/isa.hpp"
#include "kernels/queues.hpp"

namespace orrery::kernels {

/// What all scattering kernels of a plan share.
template <class Real>
struct ScatterContext {
    SphereTable<Real> spheres;
    MaterialTable<Real> materials;
    SlotTable<Real> slots;
    std::uint32_t seed = 0;
    std::uint32_t bounce = 0;
    /// Whether emission found by scattering competes with light samples at every non-delta vertex (mis) or is not
    /// counted behind diffuse ones (nee). Read only where RayQueue::pdf is present.
    bool competing_pdf = false;
};

/// What direct lighting knows.
template <class Real>
struct ConnectContext {
    SphereTable<Real> spheres;
    MaterialTable<Real> materials;
    LightTable<Real> lights;
    SlotTable<Real> slots;
    std::uint32_t seed = 0;
    std::uint32_t bounce = 0;
    LightStrategy strategy = LightStrategy::area;
    /// Whether the light sample competes with scattering that may find the light as well (mis).
    bool competing = false;
};

/// In place of a light's number: every vertex chooses its own.
inline constexpr std::uint32_t chosen_light = 0xFFFFFFFFu;

/// What sampling caustics knows.
template <class Real>
struct CausticContext {
    SphereTable<Real> spheres;
    MaterialTable<Real> materials;
    LightTable<Real> lights;
    SlotTable<Real> slots;
    CausticTable<Real> caustics;
    std::uint32_t seed = 0;
    std::uint32_t bounce = 0;
};

/// What the stage `guide` reads besides rays.
template <class Real>
struct GuideContext {
    SphereTable<Real> spheres;
    SlotTable<Real> slots;
    GuideTable<Real> guide;
    std::uint32_t seed = 0;
    std::uint32_t bounce = 0;
    bool competing_pdf = false;  ///< as in ScatterContext
};

/// Segments as columns, capacity a multiple of `widest`.
template <class Real>
struct SegmentColumns {
    const Real *ox, *oy, *oz, *dx, *dy, *dz, *t_min, *t_max;
};

template <class Real>
struct Stages {
    Isa isa = Isa::scalar;
    std::uint32_t lanes = 1;  ///< numbers per vector
    std::uint32_t step = 1;   ///< rays a stage takes at a time, one vector or two; sort_by_scattering takes `lanes`
    std::uint32_t sphere_step = 1;  ///< the same for intersect and shadow

    using Generate = void (*)(const CameraTable<Real>&, const SlotTable<Real>&, std::uint32_t count, std::uint32_t seed,
                              const RayQueue<Real>&);
    Generate generate_pinhole, generate_lens;

    using Intersect = void (*)(const SphereTable<Real>&, const RayQueue<Real>&, std::uint32_t count,
                               const HitQueue<Real>&);
    Intersect intersect, intersect_coherent, intersect_tree;

    std::uint32_t (*emission)(const SphereTable<Real>&, const LightTable<Real>&, const Background<Real>&, LightStrategy,
                              const RayQueue<Real>&, const HitQueue<Real>&, std::uint32_t count, const SlotTable<Real>&,
                              const PickQueue<Real>&);
    void (*caustic_emission)(const CausticContext<Real>&, std::uint32_t count, const RayQueue<Real>&,
                             const HitQueue<Real>&, const PickQueue<Real>&);
    void (*weigh_shadows)(const CausticContext<Real>&, std::uint32_t light, std::uint32_t count,
                          const ShadowQueue<Real>&);
    Runs (*sort_by_scattering)(const SphereTable<Real>&, std::uint32_t kinds, const RayQueue<Real>&,
                               const HitQueue<Real>&, std::uint32_t count, const RayQueue<Real>& sorted_rays,
                               const HitQueue<Real>& sorted_hits);
    using Scatter = void (*)(const ScatterContext<Real>&, Range, const RayQueue<Real>&, const HitQueue<Real>&,
                             const LobeQueue<Real>&);
    Scatter scatter[scattering_count];  ///< by Scattering

    using Connect = std::uint32_t (*)(const ConnectContext<Real>&, std::uint32_t light, Range, const RayQueue<Real>&,
                                      const LobeQueue<Real>&, const ShadowQueue<Real>&);
    Connect connect[2];  ///< by Response

    /// To an area light; returns the number of rays put aside for connect.
    std::uint32_t (*exact)(const ConnectContext<Real>&, std::uint32_t light, Range, const RayQueue<Real>&,
                           const RayQueue<Real>& aside);

    using Shadow = void (*)(const SphereTable<Real>&, const ShadowQueue<Real>&, std::uint32_t count,
                            std::uint32_t target, const SlotTable<Real>&);
    Shadow shadow, shadow_coherent, shadow_tree;

    using PickCaustics = std::uint32_t (*)(const CausticContext<Real>&, Range, const RayQueue<Real>&,
                                           const PickQueue<Real>&);
    PickCaustics pick_caustics[2];  ///< by Response
    using ConnectCaustic = std::uint32_t (*)(const CausticContext<Real>&, std::uint32_t which, std::uint32_t picked,
                                             const RayQueue<Real>&, const LobeQueue<Real>&, const PickQueue<Real>&,
                                             const ShadowQueue<Real>&);
    ConnectCaustic connect_caustic[2];  ///< by Response
    using PickPoints = std::uint32_t (*)(const CausticContext<Real>&, Range, const RayQueue<Real>&,
                                         const PickQueue<Real>&);
    PickPoints pick_point_caustics[2];  ///< by Response
    using ConnectPoints = std::uint32_t (*)(const CausticContext<Real>&, std::uint32_t chords, std::uint32_t light,
                                            Range picked, const RayQueue<Real>&, const LobeQueue<Real>&,
                                            const PickQueue<Real>&, const ShadowQueue<Real>&);
    ConnectPoints connect_point_caustic[2];  ///< by Response
    void (*follow_point_caustic)(const CausticContext<Real>&, std::uint32_t chords, std::uint32_t light,
                                 std::uint32_t event, const ShadowQueue<Real>&, std::uint32_t count);
    using Unblocked = std::uint32_t (*)(const SphereTable<Real>&, const ShadowQueue<Real>&, std::uint32_t count,
                                        std::uint32_t target);
    Unblocked unblocked, unblocked_coherent, unblocked_tree;
    void (*follow_caustic)(const SphereTable<Real>&, const Caustic<Real>&, std::uint32_t event,
                           const ShadowQueue<Real>&, std::uint32_t count);
    std::uint32_t (*follow_lobe)(const CausticContext<Real>&, const Caustic<Real>&, std::uint32_t count,
                                 const ShadowQueue<Real>&);

    void (*guide)(const GuideContext<Real>&, Range, const RayQueue<Real>&);

    std::uint32_t (*roulette)(const SlotTable<Real>&, std::uint32_t seed, std::uint32_t bounce, bool play, const Runs&,
                              const RayQueue<Real>&);

    void (*expire)(std::uint32_t depth, std::uint32_t count, const RayQueue<Real>&);
    void (*branch)(const ScatterContext<Real>&, Range, const RayQueue<Real>&, const HitQueue<Real>&,
                   const BranchStack<Real>&);
    std::uint32_t (*resume)(const SlotTable<Real>&, const BranchStack<Real>&, std::uint32_t count,
                            const RayQueue<Real>&, WordOf<Real>* live);

    void (*intersects)(const SphereTable<Real>&, const SegmentColumns<Real>&, std::uint32_t count,
                       const HitQueue<Real>&);
    void (*is_occluded)(const SphereTable<Real>&, const SegmentColumns<Real>&, std::uint32_t count,
                        WordOf<Real>* occluded);
};

/// The stages compiled for `isa`, in float or double. Throws nothing; the caller has asked isa_supported first.
template <class Real = float>
const Stages<Real>& stages_for(Isa isa);
template <>
const Stages<float>& stages_for(Isa isa);
template <>
const Stages<double>& stages_for(Isa isa);

}  // namespace orrery::kernels
