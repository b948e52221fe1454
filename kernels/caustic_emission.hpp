// Light that paths met by chance over one smooth or glossy sphere, weighed against the caustics that vertices sample.
#pragma once

#include "kernels/caustic_connect.hpp"
#include "kernels/chain.hpp"
#include "kernels/emission.hpp"

namespace orrery::kernels {

/// What the balance heuristic leaves the light that a path of the slot's chain brings from `light` by `chords`, where
/// the vertex that the chain begins at samples that light too; else 1. The lamp is met after context.bounce events.
template <class V>
ORRERY_INLINE Floats<V> weight_of_chance(const CausticContext<RealOf<V>>& context, const Mask<V>& live,
                                         const Words<V>& slot, const Words<V>& light, const Words<V>& chords) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& spheres = context.spheres;
    const auto& chains = context.slots.chains;
    const U ball = gather<U>(chains.ball, slot);
    const auto at = [&](const RealOf<V>* column) { return gather<F>(column, slot); };
    const Vec3<F> p{at(chains.x), at(chains.y), at(chains.z)}, direction{at(chains.dx), at(chains.dy), at(chains.dz)};
    const U departed = choose(live, gather<U>(chains.departed, slot), U(0u)), sphere = departed & U(no_sphere);
    const auto normal = departed_normal<V>(spheres, p, departed);
    const U surface = lookup<U>(spheres.surface, sphere, spheres.count);
    const auto rough = !words_equal(surface >> surface_material_bits & U(surface_kind_mask), U(0u));
    F weight(1);
    for (std::uint32_t g = 0; g < context.caustics.groups; ++g) {
        const auto& group = context.caustics.group[g];
        const auto* const members = context.caustics.entries + group.first;
        if (!any(live && words_equal(ball, U(members->ball)))) continue;
        for (const auto* caustic = members; caustic != members + group.count; ++caustic) {
            const auto of_it = live && words_equal(ball, U(caustic->ball)) && words_equal(light, U(caustic->light)) &&
                               words_equal(chords, U(caustic->chords));
            if (!any(of_it) || context.bounce < caustic->chords + 2) continue;
            const auto scale = caustic_scale(context.caustics, context.bounce - caustic->chords - 2);
            const F of_vertex = choose(rough, F(rough_scale<Response::glossy>(scale)), F(scale));
            const auto demands = caustic_demands<V>(context.caustics, of_vertex, p, normal, sphere);
            const F q = demands.of[g] * F(caustic->share) / demands.all();
            const F density = q * caustic_pdf<V>(*caustic, ball_frame<V>(*caustic, p), direction);
            weight = choose(of_it && q > F(0), scattering_weight<V>(at(chains.pdf), density), weight);
        }
    }
    return weight;
}

/// Shadow rays from glossy spheres to `light`: of those whose paths came there from a vertex, their share.
template <class V>
void weigh_shadows(const CausticContext<RealOf<V>>& context, std::uint32_t light, std::uint32_t count,
                   const Shadows<V>& queue) {
    using U = Words<V>;
    const auto& chains = context.slots.chains;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto in_queue = first_lanes<V>(count - i);
        const U slot = choose(in_queue, load<U>(queue.slot + i), U(0u));
        const auto came = in_queue && words_equal(gather<U>(chains.state, slot), U(chain_begun));
        if (!any(came)) continue;
        const auto weight = weight_of_chance<V>(context, came, slot, U(light), U(0u));
        save3<V>(queue.r + i, queue.g + i, queue.b + i, load3<V>(queue.r + i, queue.g + i, queue.b + i) * weight);
    }
}

/// For the rays that `emission` put aside.
template <class V>
void caustic_emission(const CausticContext<RealOf<V>>& context, std::uint32_t count, const Rays<V>& rays,
                      const Hits<V>& hits, const Picks<V>& picks) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& spheres = context.spheres;
    const auto& lights = context.lights;
    const auto& chains = context.slots.chains;
    for (std::uint32_t n = 0; n < count; n += V::count) {
        const auto live = first_lanes<V>(count - n);
        const U i = choose(live, load<U>(picks.place + n), U(0u));
        const U slot = gather<U>(rays.slot, i);
        const U light =
            lookup<U>(spheres.light, choose(live, gather<U>(hits.id, i) & U(no_sphere), U(0u)), spheres.count);
        const U chords = gather<U>(chains.state, slot) & U(chain_chords);
        const auto weight = weight_of_chance<V>(context, live, slot, light, chords);
        const auto radiance = lookup3<V>(lights.r, lights.g, lights.b, light, lights.count);
        const auto throughput = Vec3<F>{gather<F>(rays.tr, i), gather<F>(rays.tg, i), gather<F>(rays.tb, i)} * weight;
        add_radiance<V>(context.slots, slot, throughput * radiance, live);
    }
}

}  // namespace orrery::kernels
