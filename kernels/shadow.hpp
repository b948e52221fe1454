// Stage `shadow`: what the shadow queue carries arrives where nothing blocks it.
#pragma once

#include "kernels/emission.hpp"
#include "kernels/intersect.hpp"

namespace orrery::kernels {

template <class V, class Among, class Target>
ORRERY_INLINE void shadow_among(const SphereTable<typename V::Real>& spheres, const Among& among,
                                const ShadowQueue<typename V::Real>& queue, std::uint32_t begin, std::uint32_t end,
                                const Target& target, const SlotTable<typename V::Real>& slots) {
    using F = typename V::F;
    using U = typename V::U;
    for (std::uint32_t i = begin; i < end; i += V::count) {
        const auto live = first_lanes<V>(end - i);
        const auto o = load3<V>(queue.ox + i, queue.oy + i, queue.oz + i);
        const auto d = load3<V>(queue.dx + i, queue.dy + i, queue.dz + i);
        const U left = choose(live, load<U>(queue.left + i), U(no_sphere));
        const auto blocked = any_hit<V>(spheres, among, o, d, left, FromOrigin{}, load<F>(queue.inverse_t_max + i),
                                        targets_at<V>(target, i), live);
        const auto lit = live && !blocked;
        if (!any(lit)) continue;
        add_radiance<V>(slots, load<U>(queue.slot + i), load3<V>(queue.r + i, queue.g + i, queue.b + i), lit);
    }
}

/// Calls run(target) with what the queue's segments end on: its column, or `target` for all of them.
template <class Real, class Run>
ORRERY_INLINE void with_target(const ShadowQueue<Real>& queue, std::uint32_t target, const Run& run) {
    if (queue.target != nullptr) return run(static_cast<const WordOf<Real>*>(queue.target));
    run(target);
}

/// Where the queue has no column for it, `target` is the light's own sphere, which bounds the segments and cannot block
/// them; no_sphere for a point light.
template <class V>
void shadow(const SphereTable<typename V::Real>& spheres, const ShadowQueue<typename V::Real>& queue,
            std::uint32_t count, std::uint32_t target, const SlotTable<typename V::Real>& slots) {
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        shadow_among<V>(spheres, AllSpheres{spheres.count}, queue, 0, count, ends, slots);
    });
}

/// The same, as intersect_coherent.
template <class V>
void shadow_coherent(const SphereTable<typename V::Real>& spheres, const ShadowQueue<typename V::Real>& queue,
                     std::uint32_t count, std::uint32_t target, const SlotTable<typename V::Real>& slots) {
    with_target(queue, target, [&](const auto& ends) ORRERY_INLINE_LAMBDA {
        for (std::uint32_t begin = 0; begin < count; begin += bunch_size) {
            const std::uint32_t end = count - begin < bunch_size ? count : begin + bunch_size;
            const SomeSpheres among = candidates<V>(spheres, span_of(queue, begin, end - begin));
            shadow_among<V>(spheres, among, queue, begin, end, ends, slots);
        }
    });
}

}  // namespace orrery::kernels
