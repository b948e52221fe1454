// The stages as a table of function pointers, one table per instruction set, chosen once at start-up.
//
// Every pointer does what the template of the same name documents (generate.hpp, intersect.hpp, ...).
#pragma once

#include "kernels/connect.hpp"
#include "kernels/isa.hpp"
#include "kernels/scatter.hpp"
#include "kernels/segment.hpp"

namespace orrery::kernels {

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

    void (*emission)(const SphereTable<Real>&, const LightTable<Real>&, const Background<Real>&, LightStrategy,
                     const RayQueue<Real>&, const HitQueue<Real>&, std::uint32_t count, const SlotTable<Real>&);
    Runs (*sort_by_scattering)(const SphereTable<Real>&, std::uint32_t kinds, const RayQueue<Real>&,
                               const HitQueue<Real>&, std::uint32_t count, const RayQueue<Real>& sorted_rays,
                               const HitQueue<Real>& sorted_hits);
    using Scatter = void (*)(const ScatterContext<Real>&, Range, const RayQueue<Real>&, const HitQueue<Real>&,
                             const LobeQueue<Real>&);
    Scatter scatter[scattering_count];  ///< by Scattering

    using Connect = std::uint32_t (*)(const ConnectContext<Real>&, std::uint32_t light, Range, const RayQueue<Real>&,
                                      const LobeQueue<Real>&, const ShadowQueue<Real>&);
    Connect connect[2];  ///< by Response

    using Shadow = void (*)(const SphereTable<Real>&, const ShadowQueue<Real>&, std::uint32_t count,
                            std::uint32_t target, const SlotTable<Real>&);
    Shadow shadow, shadow_coherent, shadow_tree;

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
