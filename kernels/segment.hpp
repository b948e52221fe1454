// Ray casting for everybody: closest hit and occlusion of a segment (O, D, t_min, t_max), one at a time or in vectors.
//
// Both forms are the maths body of the wavefront's stages (intersect.hpp) over scalar or vector lanes.
#pragma once

#include "kernels/intersect.hpp"

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

/// The closest hit of the segment. Never fails; a table of no spheres is never hit.
template <class Real>
SegmentHit<Real> intersects(const SphereTable<Real>& spheres, const Segment<Real>& segment) {
    using V = ScalarLanes<Real>;
    const Vec3<Real> o{segment.ox, segment.oy, segment.oz}, d{segment.dx, segment.dy, segment.dz};
    const auto best = closest_hit<V>(spheres, o, d, WordOf<Real>{no_sphere}, segment.t_min, segment.t_max);
    return {best.num / best.den, best.id & no_sphere, (best.id & inside_bit) != 0};
}

/// Whether anything is hit.
template <class Real>
bool is_occluded(const SphereTable<Real>& spheres, const Segment<Real>& segment) {
    using V = ScalarLanes<Real>;
    const Vec3<Real> o{segment.ox, segment.oy, segment.oz}, d{segment.dx, segment.dy, segment.dz};
    return any_hit<V>(spheres, o, d, WordOf<Real>{no_sphere}, segment.t_min, Real(1) / segment.t_max, no_sphere, true);
}

/// Segments as columns, capacity a multiple of `widest`.
template <class Real>
struct SegmentColumns {
    const Real *ox, *oy, *oz, *dx, *dy, *dz, *t_min, *t_max;
};

/// The vector form of `intersects`: hits[i] with inside_bit in the id, no_sphere and t_max where nothing was hit.
template <class V>
void intersects_columns(const SphereTable<typename V::Real>& spheres, const SegmentColumns<typename V::Real>& segments,
                        std::uint32_t count, const HitQueue<typename V::Real>& hits) {
    using F = typename V::F;
    using U = typename V::U;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto best = closest_hit<V>(spheres, load3<V>(segments.ox + i, segments.oy + i, segments.oz + i),
                                         load3<V>(segments.dx + i, segments.dy + i, segments.dz + i), U(no_sphere),
                                         load<F>(segments.t_min + i), load<F>(segments.t_max + i));
        save(hits.t + i, best.num / best.den);
        save(hits.id + i, best.id);
    }
}

/// The vector form of `is_occluded`: occluded[i] is 1 or 0.
template <class V>
void is_occluded_columns(const SphereTable<typename V::Real>& spheres, const SegmentColumns<typename V::Real>& segments,
                         std::uint32_t count, typename V::Word* occluded) {
    using F = typename V::F;
    using U = typename V::U;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto blocked = any_hit<V>(spheres, load3<V>(segments.ox + i, segments.oy + i, segments.oz + i),
                                        load3<V>(segments.dx + i, segments.dy + i, segments.dz + i), U(no_sphere),
                                        load<F>(segments.t_min + i), F(1) / load<F>(segments.t_max + i), no_sphere,
                                        first_lanes<V>(count - i));
        save(occluded + i, choose(blocked, U(1u), U(0u)));
    }
}

}  // namespace orrery::kernels
