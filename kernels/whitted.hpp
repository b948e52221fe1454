// Whitted ray tracing's own steps: both branches at a dielectric, one live ray per slot, the other branch postponed.
//
// Depth-first per slot: a tree of depth D has at most D branches pending, so the storage is bounded whatever the glass,
// and a slot's contributions are summed in the order of its own tree, whatever shares the wave with it. (Breadth-first
// would need 2^D rays per sample, or give up the order of summation, and with it the same bytes for every wave size.)
#pragma once

#include "kernels/scatter.hpp"

namespace orrery::kernels {

/// Below this weight a branch is dropped (scenes/README.md).
template <class Real>
inline constexpr Real branch_cut = Real(1e-5);

/// Kills the rays that have scattered `depth` times. Runs after `emission`.
template <class V>
void expire(std::uint32_t depth, std::uint32_t count, const Rays<V>& rays) {
    using F = Floats<V>;
    using U = Words<V>;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto alive = words_equal(load<U>(rays.vertex + i) >> static_cast<int>(depth), U(0u));
        const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i);
        const Vec3<F> none{F(0), F(0), F(0)};
        save3<V>(rays.tr + i, rays.tg + i, rays.tb + i, choose(alive, throughput, none));
    }
}

/// Every ray of the run becomes the transmitted one, or the reflected one where reflection is total; what was reflected
/// elsewhere goes onto the slot's stack.
template <class V>
void branch(const ScatterContext<RealOf<V>>& context, Range run, const Rays<V>& rays, const Hits<V>& hits,
            const BranchStack<RealOf<V>>& stack) {
    using F = Floats<V>;
    using U = Words<V>;
    using Real = typename V::Real;
    using Word = WordOf<RealOf<V>>;
    const U zero(0u);
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto in = arriving<V>(context.spheres, rays, hits, i, run.count - n);
        const auto& vertex = in.vertex;
        const auto& materials = context.materials;
        const F eta = lookup<F>(materials.eta, vertex.material, materials.count);
        const auto at = interface_at<V>(vertex.cosine, choose(words_equal(vertex.side, zero), eta, F(1) / eta));
        const auto rho = reflectance_of<V>(materials, vertex.material) * at.reflectance;
        const auto tau =
            lookup3<V>(materials.tau_r, materials.tau_g, materials.tau_b, vertex.material, materials.count) *
            ((F(1) - at.reflectance) * at.inverse_eta * at.inverse_eta);
        const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i);
        const auto weigh = [&](const Vec3<F>& w) {
            const Vec3<F> out = throughput * w;
            // Not by their maximum, which may forget what is no number.
            const F cut(branch_cut<Real>);
            const auto dropped = out.x < cut && out.y < cut && out.z < cut;
            return choose(in.live && !dropped, out, Vec3<F>{F(0), F(0), F(0)});
        };
        const Vec3<F> transmitted = weigh(tau);
        const Vec3<F> mirrored = weigh(rho);
        const auto continues = !carries_nothing(transmitted);
        const auto postponed = continues && !carries_nothing(mirrored);
        const Vec3<F> mirror = unit(reflected(in.direction, vertex.normal, vertex.cosine));
        const Vec3<F> through = refracted<V>(in.direction, vertex.normal, vertex.cosine, at);
        const U mirror_departed = vertex.sphere | vertex.side;
        const U node = load<U>(rays.vertex + i) << 1;

        save3<V>(rays.ox + i, rays.oy + i, rays.oz + i, vertex.position);
        save3<V>(rays.dx + i, rays.dy + i, rays.dz + i, choose(continues, through, mirror));
        save3<V>(rays.tr + i, rays.tg + i, rays.tb + i, choose(continues, transmitted, mirrored));
        save(rays.departed + i, choose(continues, mirror_departed ^ U(inside_bit), mirror_departed));
        save(rays.vertex + i, choose(continues, node | U(1u), node));

        alignas(64) Word slot_of[V::count], node_of[V::count], departed_of[V::count];
        alignas(64) Real numbers[9][V::count];
        save(slot_of, load<U>(rays.slot + i));
        save(node_of, node);
        save(departed_of, mirror_departed);
        save3<V>(numbers[0], numbers[1], numbers[2], vertex.position);
        save3<V>(numbers[3], numbers[4], numbers[5], mirror);
        save3<V>(numbers[6], numbers[7], numbers[8], mirrored);
        for (std::uint32_t rest = bits(postponed); rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(rest));
            const Word s = slot_of[lane];
            const std::size_t entry = std::size_t{stack.height[s]++} * stack.slots + s;
            Real* const to[9] = {stack.rays.ox, stack.rays.oy, stack.rays.oz, stack.rays.dx, stack.rays.dy,
                                 stack.rays.dz, stack.rays.tr, stack.rays.tg, stack.rays.tb};
            for (int f = 0; f < 9; ++f) to[f][entry] = numbers[f][lane];
            stack.rays.departed[entry] = departed_of[lane];
            stack.rays.slot[entry] = s;
            stack.rays.vertex[entry] = node_of[lane];
        }
    }
}

/// Appends to `rays` the topmost postponed branch of every slot without a live ray. `live` has an entry per slot, zero
/// on entry and on return. Returns the new count.
template <class V>
std::uint32_t resume(const Slots<V>& slots, const BranchStack<RealOf<V>>& stack, std::uint32_t count,
                     const Rays<V>& rays, WordOf<RealOf<V>>* live) {
    for (std::uint32_t i = 0; i < count; ++i) live[rays.slot[i]] = 1;
    for (std::uint32_t s = 0; s < stack.slots; ++s) {
        if (live[s] == 0 && stack.height[s] != 0) {
            const std::size_t entry = std::size_t{--stack.height[s]} * stack.slots + s;
            Rays<V>::each_field([&](const char*, auto field) {
                if (stack.rays.*field != nullptr) (rays.*field)[count] = (stack.rays.*field)[entry];
            });
            rays.pixel[count] = slots.pixel[s];
            rays.sample[count] = slots.sobol.x == nullptr ? slots.sample[s] : reversed_bits(slots.sample[s]);
            ++count;
        }
        live[s] = 0;
    }
    return count;
}

}  // namespace orrery::kernels
