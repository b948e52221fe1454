// Ray casting for everybody: closest hit and occlusion of a segment (O, D, t_min, t_max), one at a time or in vectors.
//
// Both forms are the maths body of the wavefront's stages (loop.hpp, tree_cast.hpp) over scalar or vector lanes.
#pragma once

#include "kernels/stages.hpp"
#include "kernels/tree_cast.hpp"

namespace orrery::kernels {

/// Points O + t D with t_min < t < t_max. D of unit length; 0 <= t_min, t_max may be +inf. Nothing is hit at t = 0.
template <class Real>
struct Segment {
    Real ox, oy, oz;
    Real dx, dy, dz;
    Real t_min = 0;
    Real t_max = std::numeric_limits<Real>::infinity();
};

template <class Real>
struct SegmentHit {
    Real t;               ///< t_min < t < t_max, t_max where nothing was hit
    WordOf<Real> sphere;  ///< index into the table, no_sphere where nothing was hit
    bool inside;          ///< met from within the sphere
};

template <class Real>
ORRERY_INLINE TreeSource<Real> source_of(const Segment<Real>& s) {
    return {&s.ox, &s.oy, &s.oz, &s.dx, &s.dy, &s.dz, nullptr, &s.t_min};
}

/// The closest hit of the segment. Never fails; a table of no spheres is never hit.
template <class Real>
SegmentHit<Real> intersects(const SphereTable<Real>& spheres, const Segment<Real>& segment) {
    using V = ScalarLanes<Real>;
    if (spheres.tree.count != 0) {
        TreeHits<Real, 1> hits;
        hits.t[0] = segment.t_max;
        closest_in_tree<V>(spheres, source_of(segment), 1, hits);
        return {hits.t[0], hits.id[0] & no_sphere, (hits.id[0] & inside_bit) != 0};
    }
    const Vec3<Real> o{segment.ox, segment.oy, segment.oz}, d{segment.dx, segment.dy, segment.dz};
    const auto best =
        closest_hit<V>(spheres, AllSpheres{spheres.count}, o, d, WordOf<Real>{no_sphere}, segment.t_min, segment.t_max);
    return {best.num / best.den, best.id & no_sphere, (best.id & inside_bit) != 0};
}

/// Whether anything is hit.
template <class Real>
bool is_occluded(const SphereTable<Real>& spheres, const Segment<Real>& segment) {
    using V = ScalarLanes<Real>;
    const Real inverse_t_max = Real(1) / segment.t_max;
    if (spheres.tree.count != 0) {
        WordOf<Real> occluded = 0;
        occluded_in_tree<V, 1>(spheres, source_of(segment), &inverse_t_max, 1, no_sphere, &occluded);
        return occluded != 0;
    }
    const Vec3<Real> o{segment.ox, segment.oy, segment.oz}, d{segment.dx, segment.dy, segment.dz};
    return any_hit<V>(spheres, AllSpheres{spheres.count}, o, d, WordOf<Real>{no_sphere}, segment.t_min, inverse_t_max,
                      no_sphere, true);
}

template <class Real>
ORRERY_INLINE TreeSource<Real> source_of(const SegmentColumns<Real>& s, std::uint32_t at) {
    return {s.ox + at, s.oy + at, s.oz + at, s.dx + at, s.dy + at, s.dz + at, nullptr, s.t_min + at};
}

/// The vector form of `intersects`: hits[i] with inside_bit in the id, no_sphere and t_max where nothing was hit.
template <class V>
void intersects_columns(const Spheres<V>& spheres, const SegmentColumns<RealOf<V>>& segments, std::uint32_t count,
                        const Hits<V>& hits) {
    using F = Floats<V>;
    using U = Words<V>;
    if (spheres.tree.count == 0) {
        for (std::uint32_t i = 0; i < count; i += V::count) {
            const auto best = closest_hit<V>(spheres, AllSpheres{spheres.count},
                                             load3<V>(segments.ox + i, segments.oy + i, segments.oz + i),
                                             load3<V>(segments.dx + i, segments.dy + i, segments.dz + i), U(no_sphere),
                                             load<F>(segments.t_min + i), load<F>(segments.t_max + i));
            save(hits.t + i, best.num / best.den);
            save(hits.id + i, best.id);
        }
        return;
    }
    TreeHits<RealOf<V>> found;
    for (std::uint32_t first = 0; first < count; first += packet_size) {
        const std::uint32_t packet = count - first < packet_size ? count - first : packet_size;
        for (std::uint32_t i = 0; i < packet; i += V::count) save(found.t + i, load<F>(segments.t_max + first + i));
        closest_in_tree<V>(spheres, source_of(segments, first), packet, found);
        for (std::uint32_t i = 0; i < packet; i += V::count) {
            save(hits.t + first + i, load<F>(found.t + i));
            save(hits.id + first + i, load<U>(found.id + i));
        }
    }
}

/// The vector form of `is_occluded`: occluded[i] is 1 or 0.
template <class V>
void is_occluded_columns(const Spheres<V>& spheres, const SegmentColumns<RealOf<V>>& segments, std::uint32_t count,
                         WordOf<RealOf<V>>* occluded) {
    using F = Floats<V>;
    using U = Words<V>;
    if (spheres.tree.count == 0) {
        for (std::uint32_t i = 0; i < count; i += V::count) {
            const auto blocked = any_hit<V>(
                spheres, AllSpheres{spheres.count}, load3<V>(segments.ox + i, segments.oy + i, segments.oz + i),
                load3<V>(segments.dx + i, segments.dy + i, segments.dz + i), U(no_sphere), load<F>(segments.t_min + i),
                F(1) / load<F>(segments.t_max + i), no_sphere, first_lanes<V>(count - i));
            save(occluded + i, choose(blocked, U(1u), U(0u)));
        }
        return;
    }
    alignas(64) RealOf<V> inverse_t_max[packet_size];
    for (std::uint32_t first = 0; first < count; first += packet_size) {
        const std::uint32_t packet = count - first < packet_size ? count - first : packet_size;
        for (std::uint32_t i = 0; i < packet; i += V::count)
            save(inverse_t_max + i, F(1) / load<F>(segments.t_max + first + i));
        occluded_in_tree<V>(spheres, source_of(segments, first), inverse_t_max, packet, no_sphere, occluded + first);
    }
}

}  // namespace orrery::kernels
