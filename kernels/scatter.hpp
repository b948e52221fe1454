// Stage `shade`, third step: each hit of a run becomes the ray that leaves it. One kernel per way of scattering, in
// place.
#pragma once

#include <limits>

#include "kernels/chain.hpp"
#include "kernels/lobes.hpp"
#include "kernels/stages.hpp"
#include "kernels/vertex.hpp"

namespace orrery::kernels {

/// What a scattering event makes of a ray, its throughput apart.
template <class V>
struct Scattered {
    Vec3Of<V> direction;  ///< unit length
    Floats<V> pdf;        ///< see RayQueue::pdf
    Words<V> side;        ///< inside_bit where the ray leaves inward
    Vec3Of<V> lobe;       ///< unperturbed direction, glossy and translucent only
    Mask<V> transmits;    ///< it crosses the surface, dielectric and translucent only
    Floats<V> eta_scale;  ///< (eta_i / eta_t)^2 of this event, 1 unless it crosses; as above
};

template <class V>
ORRERY_INLINE Vec3Of<V> reflectance_of(const Materials<V>& materials, const Words<V>& material) {
    return lookup3<V>(materials.rho_r, materials.rho_g, materials.rho_b, material, materials.count);
}

/// Throughput factor, radiance scaling by eta included.
template <class V, Scattering kind>
ORRERY_INLINE Vec3Of<V> weight_of(const Materials<V>& materials, const Words<V>& material, const Scattered<V>& out) {
    const auto rho = reflectance_of<V>(materials, material);
    if constexpr (traits_of(kind).is_interface) {
        // One lobe at random, chosen with probability F: what F multiplies cancels.
        const auto tau = lookup3<V>(materials.tau_r, materials.tau_g, materials.tau_b, material, materials.count);
        return choose(out.transmits, tau * out.eta_scale, rho);
    } else {
        return rho;
    }
}

template <class V, Scattering kind>
ORRERY_INLINE Scattered<V> scatter_at(const ScatterContext<RealOf<V>>& context, const Vertex<V>& vertex,
                                      const Vec3Of<V>& direction, const RandomNumbers<Floats<V>>& random) {
    using F = Floats<V>;
    using U = Words<V>;
    using Real = typename V::Real;
    const F infinity(std::numeric_limits<Real>::infinity());
    const F one(1);
    Scattered<V> out;
    out.side = vertex.side;
    if constexpr (kind == Scattering::specular) {
        out.direction = unit(reflected(direction, vertex.normal, vertex.cosine));
        out.pdf = infinity;
        return out;
    }
    if constexpr (kind == Scattering::diffuse) {
        const auto sample = sample_cosine<V>(vertex.normal, random.x, random.y);
        out.direction = sample.direction;
        out.pdf = context.competing_pdf ? sample.cosine * F(static_cast<Real>(std::numbers::inv_pi)) : F(0);
    } else {
        const auto& materials = context.materials;
        out.lobe = reflected(direction, vertex.normal, vertex.cosine);
        F lobe_cosine = vertex.cosine;
        Vec3<F> normal = vertex.normal;  // on the side the lobe leaves
        if constexpr (traits_of(kind).is_interface) {
            const F eta = lookup<F>(materials.eta, vertex.material, materials.count);
            const auto from_outside = words_equal(vertex.side, U(0u));
            const auto at = interface_at<V>(vertex.cosine, choose(from_outside, eta, one / eta));
            const auto reflects = random.z < at.reflectance;
            out.transmits = !reflects;
            out.eta_scale = choose(reflects, one, at.inverse_eta * at.inverse_eta);
            out.lobe = choose(reflects, out.lobe, refracted<V>(direction, vertex.normal, vertex.cosine, at));
            lobe_cosine = choose(reflects, vertex.cosine, at.cosine_t);
            normal = choose(reflects, normal, normal * F(-1));
            out.side = choose(reflects, out.side, out.side ^ U(inside_bit));
        }
        out.lobe = unit(out.lobe);
        if constexpr (traits_of(kind).is_rough()) {
            const F beta = lookup<F>(materials.roughness, vertex.material, materials.count);
            const auto sample = sample_glossy<V>(out.lobe, normal, lobe_cosine, beta, random.x, random.y);
            out.direction = sample.direction;
            out.pdf = context.competing_pdf ? sample.pdf : infinity;
        } else {
            out.direction = out.lobe;
            out.pdf = infinity;
        }
    }
    return out;
}

/// Everything is loaded where it is needed and saved as soon as it is known: what stays alive across the sampling
/// spills.
template <class V, Scattering kind>
void scatter(const ScatterContext<RealOf<V>>& context, Range run, const Rays<V>& rays, const Hits<V>& hits,
             const Lobes<V>& lobes) {
    using F = Floats<V>;
    using U = Words<V>;
    const Vec3<F> none{F(0), F(0), F(0)};
    constexpr int dimensions = traits_of(kind).dimensions;
    const RandomKey key{context.seed, Dimension::scattering, 0};
    if constexpr (dimensions > 0) draw<V, dimensions>(context.slots, rays, run, key, context.bounce);
    constexpr bool smooth = traits_of(kind).response == Response::none;
    constexpr bool on_chains = smooth || kind == Scattering::glossy;
    const bool noted = on_chains && context.slots.chains.state != nullptr;
    if (noted) begin_chains<V>(context.slots.chains, run, rays, hits);
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        // Ahead of the vertex, which needs none of them: the processor works on both at once.
        RandomNumbers<F> random{};
        if constexpr (dimensions > 0) random = random_for<V, dimensions>(context.slots, rays, i, key, context.bounce);
        const auto in = arriving<V>(context.spheres, rays, hits, i, run.count - n);
        save3<V>(rays.ox + i, rays.oy + i, rays.oz + i, in.vertex.position);
        const auto out = scatter_at<V, kind>(context, in.vertex, in.direction, random);
        save3<V>(rays.dx + i, rays.dy + i, rays.dz + i, out.direction);
        save(rays.departed + i, in.vertex.sphere | out.side);
        if (rays.pdf != nullptr) save(rays.pdf + i, out.pdf);
        // In a ray tree a mirror has one branch. (What a diffuse vertex has is its light samples, under its own
        // number.)
        if constexpr (kind == Scattering::specular) {
            if (rays.vertex != nullptr) save(rays.vertex + i, load<U>(rays.vertex + i) << 1);
        }
        if constexpr (traits_of(kind).is_interface) {
            if (rays.roulette_scale != nullptr)
                save(rays.roulette_scale + i, load<F>(rays.roulette_scale + i) * out.eta_scale);
        }
        if constexpr (traits_of(kind).is_rough()) {
            if (lobes.x != nullptr) save3<V>(lobes.x + i, lobes.y + i, lobes.z + i, out.lobe);
        }
        // Misses leave with no throughput.
        const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i) *
                                weight_of<V, kind>(context.materials, in.vertex.material, out);
        save3<V>(rays.tr + i, rays.tg + i, rays.tb + i, choose(in.live, throughput, none));
    }
    if constexpr (smooth) {
        if (noted) note_events<V, traits_of(kind).is_interface>(context, run, rays, hits);
    }
}

}  // namespace orrery::kernels
