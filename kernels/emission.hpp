// Stage `shade`, first step: the radiance a ray runs into, an emitter's or the enclosing volume's.
#pragma once

#include "kernels/lanes/compress.hpp"
#include "kernels/light.hpp"
#include "kernels/queues.hpp"
#include "kernels/radiance.hpp"

namespace orrery::kernels {

/// Weight of emission found by scattering with density `pdf` against light sampling with density `light_pdf`: the
/// balance heuristic (Veach and Guibas 1995). It keeps pdf * weight bounded where pdf has a singularity. Where the
/// densities are 0 / 0, as that of a light met at t = 0 by a ray along its surface, the weight is 0; where pdf is no
/// number, nor is the weight.
template <class V>
ORRERY_INLINE Floats<V> scattering_weight(const Floats<V>& pdf, const Floats<V>& light_pdf) {
    using F = Floats<V>;
    const auto whole = pdf > F(std::numeric_limits<RealOf<V>>::max());
    const F share = F(1) / (F(1) + light_pdf / pdf);
    return choose(whole, F(1), max(share, pdf * F(0)));  // the second where the first is no number
}

/// Lanes whose rays came from a vertex that samples caustics over one smooth sphere, and from that here.
template <class V>
ORRERY_INLINE Mask<V> came_over_ball(const ChainTable<RealOf<V>>& chains, const Rays<V>& rays, std::uint32_t i,
                                     const Mask<V>& emits) {
    using U = Words<V>;
    const U slot = choose(emits, load<U>(rays.slot + i), U(0u));
    const auto closed = words_equal(gather<U>(chains.state, slot) & U(chain_closed), U(chain_closed));
    const auto direct = load<Floats<V>>(rays.pdf + i) <= Floats<V>(std::numeric_limits<RealOf<V>>::max());
    return emits && closed && !direct && words_equal(gather<U>(chains.ball, slot), load<U>(rays.departed + i));
}

/// `lights` are all that a vertex may sample, with their probabilities where it samples one of them. Rays that came
/// over one smooth sphere from a vertex that samples caustics are put aside, in `aside`; returns how many.
template <class V>
std::uint32_t emission(const Spheres<V>& spheres, const Lights<V>& lights, const Background<RealOf<V>>& background,
                       LightStrategy strategy, const Rays<V>& rays, const Hits<V>& hits, std::uint32_t count,
                       const Slots<V>& slots, const Picks<V>& aside) {
    using F = Floats<V>;
    using U = Words<V>;
    std::uint32_t put_aside = 0;
    const bool emitters = lights.count > lights.points, shines = background.shines();
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto live = first_lanes<V>(count - i);
        const U hit = load<U>(hits.id + i);
        const auto missed = words_equal(hit, U(no_sphere)) && live;
        const U id = choose(live && !missed, hit & U(no_sphere), U(0u));
        if (shines && any(missed)) {
            const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i);
            const Vec3<F> radiance{F(background.r), F(background.g), F(background.b)};
            add_radiance<V>(slots, load<U>(rays.slot + i), throughput * radiance, missed);
        }
        if (!emitters) continue;
        const U surface = lookup<U>(spheres.surface, id, spheres.count);
        auto emits = live && !missed && words_equal(surface & U(surface_emits), U(surface_emits));
        if (!any(emits)) continue;
        if (slots.chains.state != nullptr) {
            const auto over_ball = came_over_ball<V>(slots.chains, rays, i, emits);
            if (const std::uint32_t chosen = bits(over_ball); chosen != 0) {
                compress_store<V>(aside.place + put_aside, consecutive<V>(i), chosen);
                put_aside += static_cast<std::uint32_t>(std::popcount(chosen));
                emits = emits && !over_ball;
            }
        }
        const U light = lookup<U>(spheres.light, id, spheres.count);
        F weight(1);
        if (rays.pdf != nullptr) {
            const auto inside = !words_equal(hit, id);
            F density = light_pdf<V>(strategy, load3<V>(rays.ox + i, rays.oy + i, rays.oz + i),
                                     load3<V>(rays.dx + i, rays.dy + i, rays.dz + i), load<F>(hits.t + i),
                                     gather_sphere<V>(spheres, id), inside);
            if (lights.probability != nullptr) density = density * lookup<F>(lights.probability, light, lights.count);
            weight = scattering_weight<V>(load<F>(rays.pdf + i), density);
        }
        const auto radiance = lookup3<V>(lights.r, lights.g, lights.b, light, lights.count);
        const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i) * weight;
        add_radiance<V>(slots, load<U>(rays.slot + i), throughput * radiance, emits);
    }
    return put_aside;
}

}  // namespace orrery::kernels
