// What a path remembers at smooth and glossy spheres, so that light it meets by chance is weighed against sampled
// caustics.
//
// Two loops of their own around that of `scatter`, for scenes that need it: in its loop they would cost registers.
#pragma once

#include <bit>
#include <limits>

#include "kernels/lobes.hpp"
#include "kernels/stages.hpp"
#include "kernels/vertex.hpp"

namespace orrery::kernels {

namespace detail {
/// Calls run(lane) for every bit.
template <class Run>
ORRERY_INLINE void each_lane(std::uint32_t bits_of_lanes, const Run& run) {
    for (std::uint32_t rest = bits_of_lanes; rest != 0; rest &= rest - 1)
        run(static_cast<std::uint32_t>(std::countr_zero(rest)));
}
/// Rays i.. of a run: those that met something, what, and where they are kept.
template <class V>
struct ChainRays {
    Mask<V> live;
    Words<V> hit, sphere, slot;
    Mask<V> outside;  ///< met from there
};
template <class V>
ORRERY_INLINE ChainRays<V> chain_rays(const Rays<V>& rays, const Hits<V>& hits, std::uint32_t i, std::uint32_t count) {
    using U = Words<V>;
    const U met = load<U>(hits.id + i);
    const auto live = first_lanes<V>(count) && !words_equal(met, U(no_sphere));
    const U hit = choose(live, met, U(0u)), sphere = hit & U(no_sphere);
    return {live, hit, sphere, choose(live, load<U>(rays.slot + i), U(0u)), words_equal(hit, sphere)};
}
}  // namespace detail

/// Before a run of smooth or glossy spheres scatters: chains begin where rays of finite density, that is from vertices
/// that sample caustics, meet a sphere from outside; those that are not within their ball end.
template <class V>
[[gnu::noinline]] void begin_chains(const ChainTable<RealOf<V>>& chains, Range run, const Rays<V>& rays,
                                    const Hits<V>& hits) {
    using Real = typename V::Real;
    using Word = WordOf<Real>;
    using F = Floats<V>;
    using U = Words<V>;
    const Real* const from[] = {rays.ox, rays.oy, rays.oz, rays.dx, rays.dy, rays.dz, rays.pdf};
    Real* const to[] = {chains.x, chains.y, chains.z, chains.dx, chains.dy, chains.dz, chains.pdf};
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto at = detail::chain_rays<V>(rays, hits, i, run.count - n);
        const auto begins = at.outside && load<F>(rays.pdf + i) <= F(std::numeric_limits<Real>::max());
        const U state = gather<U>(chains.state, at.slot);
        const auto within = !at.outside && words_equal(state & U(chain_open), U(chain_open)) &&
                            words_equal(gather<U>(chains.ball, at.slot), at.sphere);
        alignas(64) Word slots[V::count], states[V::count], spheres[V::count];
        save(slots, at.slot);
        save(states, choose(begins, U(chain_begun), choose(within, state, U(0u))));
        save(spheres, at.sphere);
        detail::each_lane(bits(at.live),
                          [&](std::uint32_t lane) ORRERY_INLINE_LAMBDA { chains.state[slots[lane]] = states[lane]; });
        detail::each_lane(bits(begins && at.live), [&](std::uint32_t lane) ORRERY_INLINE_LAMBDA {
            const Word slot = slots[lane];
            chains.ball[slot] = spheres[lane];
            chains.departed[slot] = rays.departed[i + lane];
            for (std::size_t c = 0; c < std::size(to); ++c) to[c][slot] = from[c][i + lane];
        });
    }
}

/// After it: what happened, and how probable it was. Fresnel's reflectance is the same for the angle on the other side.
template <class V, bool is_interface>
[[gnu::noinline]] void note_events(const ScatterContext<RealOf<V>>& context, Range run, const Rays<V>& rays,
                                   const Hits<V>& hits) {
    using Real = typename V::Real;
    using Word = WordOf<Real>;
    using F = Floats<V>;
    using U = Words<V>;
    const auto& chains = context.slots.chains;
    const auto& spheres = context.spheres;
    const auto& materials = context.materials;
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto at = detail::chain_rays<V>(rays, hits, i, run.count - n);
        const U state = gather<U>(chains.state, at.slot);
        const auto follows = at.live && !words_equal(state, U(0u));
        if (!any(follows)) continue;
        const auto begun = words_equal(state, U(chain_begun));
        auto transmits = begun && !begun;
        F pdf = gather<F>(chains.pdf, at.slot);
        if constexpr (is_interface) {
            const U departed = choose(at.live, load<U>(rays.departed + i), U(0u));
            transmits = !words_equal(departed, at.hit);
            const auto leaves_outward = words_equal(departed, departed & U(no_sphere));
            const auto centre = lookup3<V>(spheres.cx, spheres.cy, spheres.cz, at.sphere, spheres.count);
            const auto outward = (load3<V>(rays.ox + i, rays.oy + i, rays.oz + i) - centre) *
                                 lookup<F>(spheres.inverse_radius, at.sphere, spheres.count);
            const F cosine = min(magnitude(dot(outward, load3<V>(rays.dx + i, rays.dy + i, rays.dz + i))), F(1));
            const U material = lookup<U>(spheres.surface, at.sphere, spheres.count) & U(surface_material_mask);
            const F eta = lookup<F>(materials.eta, material, materials.count);
            const F reflected = interface_at<V>(cosine, choose(leaves_outward, eta, F(1) / eta)).reflectance;
            pdf = pdf * choose(transmits, F(1) - reflected, reflected);
        }
        const U chords = state & U(chain_chords);
        const U one_more = choose(words_equal(chords, U(chain_chords)), chords, chords + U(1u));
        const U next = choose(begun, choose(transmits, U(chain_open | 1u), U(chain_closed)),
                              choose(transmits, chords | U(chain_closed), one_more | U(chain_open)));
        alignas(64) Word slots[V::count], states[V::count];
        alignas(64) Real pdfs[V::count];
        save(slots, at.slot), save(states, next), save(pdfs, pdf);
        detail::each_lane(bits(follows), [&](std::uint32_t lane) ORRERY_INLINE_LAMBDA {
            chains.state[slots[lane]] = states[lane];
            chains.pdf[slots[lane]] = pdfs[lane];
        });
    }
}

}  // namespace orrery::kernels
