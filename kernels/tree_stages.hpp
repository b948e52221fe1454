// The stages `intersect` and `shadow`, and the columns of segments, for tables with a tree.
#pragma once

#include "kernels/segment.hpp"
#include "kernels/shadow.hpp"
#include "kernels/tree_coherent.hpp"

namespace orrery::kernels {

template <class V>
void intersect_tree(const SphereTable<typename V::Real>& spheres, const RayQueue<typename V::Real>& rays,
                    std::uint32_t count, const HitQueue<typename V::Real>& hits) {
    using Real = typename V::Real;
    using F = typename V::F;
    using U = typename V::U;
    TreeHits<Real> found;
    for (std::uint32_t first = 0; first < count; first += bunch_size) {
        const std::uint32_t bunch = count - first < bunch_size ? count - first : bunch_size;
        SphereList<Real> list;
        if (collect<V>(spheres, span_of(rays, first, bunch), list)) {
            intersect_list<V>(spheres, list, rays, first, first + bunch, hits);
            continue;
        }
        for (std::uint32_t i = 0; i < bunch_size; ++i) found.t[i] = std::numeric_limits<Real>::infinity();
        closest_in_tree<V>(spheres,
                           {rays.ox + first, rays.oy + first, rays.oz + first, rays.dx + first, rays.dy + first,
                            rays.dz + first, rays.left + first, nullptr},
                           bunch, found);
        for (std::uint32_t i = 0; i < bunch; i += V::count) {
            save(hits.t + first + i, load<F>(found.t + i));
            save(hits.id + first + i, load<U>(found.id + i));
        }
    }
}

/// `target` as in targets_at.
template <class V, class Target>
ORRERY_INLINE void shadow_in_tree(const SphereTable<typename V::Real>& spheres,
                                  const ShadowQueue<typename V::Real>& queue, std::uint32_t count, const Target& target,
                                  const SlotTable<typename V::Real>& slots) {
    using Word = typename V::Word;
    using U = typename V::U;
    alignas(64) Word occluded[bunch_size];
    for (std::uint32_t first = 0; first < count; first += bunch_size) {
        const std::uint32_t bunch = count - first < bunch_size ? count - first : bunch_size;
        SphereList<typename V::Real> list;
        if (collect<V>(spheres, span_of(queue, first, bunch), list)) {
            shadow_among<V>(spheres, list, queue, first, first + bunch, target, slots);
            continue;
        }
        occluded_in_tree<V>(spheres,
                            {queue.ox + first, queue.oy + first, queue.oz + first, queue.dx + first, queue.dy + first,
                             queue.dz + first, queue.left + first, nullptr},
                            queue.inverse_t_max + first, bunch, targets_behind(target, first), occluded);
        for (std::uint32_t i = 0; i < bunch; i += V::count) {
            const auto live = first_lanes<V>(bunch - i);
            const auto lit = live && words_equal(load<U>(occluded + i), U(0u));
            const std::uint32_t at = first + i;
            if (any(lit))
                add_radiance<V>(slots, load<U>(queue.slot + at), load3<V>(queue.r + at, queue.g + at, queue.b + at),
                                lit);
        }
    }
}

template <class V>
void shadow_tree(const SphereTable<typename V::Real>& spheres, const ShadowQueue<typename V::Real>& queue,
                 std::uint32_t count, std::uint32_t target, const SlotTable<typename V::Real>& slots) {
    with_target(queue, target,
                [&](const auto& ends) ORRERY_INLINE_LAMBDA { shadow_in_tree<V>(spheres, queue, count, ends, slots); });
}

/// intersects_columns of a table with or without a tree.
template <class V>
void intersects_any_table(const SphereTable<typename V::Real>& spheres,
                          const SegmentColumns<typename V::Real>& segments, std::uint32_t count,
                          const HitQueue<typename V::Real>& hits) {
    using Real = typename V::Real;
    using F = typename V::F;
    using U = typename V::U;
    if (spheres.tree.count == 0) return intersects_columns<V>(spheres, segments, count, hits);
    TreeHits<Real> found;
    for (std::uint32_t first = 0; first < count; first += bunch_size) {
        const std::uint32_t bunch = count - first < bunch_size ? count - first : bunch_size;
        for (std::uint32_t i = 0; i < bunch; i += V::count) save(found.t + i, load<F>(segments.t_max + first + i));
        closest_in_tree<V>(spheres, source_of(segments, first), bunch, found);
        for (std::uint32_t i = 0; i < bunch; i += V::count) {
            save(hits.t + first + i, load<F>(found.t + i));
            save(hits.id + first + i, load<U>(found.id + i));
        }
    }
}

/// is_occluded_columns of a table with or without a tree.
template <class V>
void is_occluded_any_table(const SphereTable<typename V::Real>& spheres,
                           const SegmentColumns<typename V::Real>& segments, std::uint32_t count,
                           typename V::Word* occluded) {
    using Real = typename V::Real;
    using F = typename V::F;
    if (spheres.tree.count == 0) return is_occluded_columns<V>(spheres, segments, count, occluded);
    alignas(64) Real inverse_t_max[bunch_size];
    for (std::uint32_t first = 0; first < count; first += bunch_size) {
        const std::uint32_t bunch = count - first < bunch_size ? count - first : bunch_size;
        for (std::uint32_t i = 0; i < bunch; i += V::count)
            save(inverse_t_max + i, F(1) / load<F>(segments.t_max + first + i));
        occluded_in_tree<V>(spheres, source_of(segments, first), inverse_t_max, bunch, no_sphere, occluded + first);
    }
}

}  // namespace orrery::kernels
