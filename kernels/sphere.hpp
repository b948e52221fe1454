// Ray against sphere, once: the maths body of every intersection and occlusion test.
//
// With f = C - O, b = f.D, c = f.f - r^2 and the perpendicular l = f - b D, the discriminant r^2 - l.l keeps its
// digits where b^2 - c cancels (Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
// 2019: b^2 - c misses 2 % of the hits at distance 1000 r). With s = sqrt(disc) and q = |b| + s, which never cancels,
// the roots are q and c/q (b > 0) or their negatives. A root is kept as a fraction num/den and compared by
// cross-multiplication, so that a sphere costs no division; the winner is divided once, after the loop.
//
// The sign of c says on which side the origin is, so there is no t_min and no epsilon. A ray that leaves a sphere
// carries its id instead: outward it cannot meet that sphere again, inward only at the far root, which for an origin on
// the surface is 2b.
#pragma once

#include "kernels/tables.hpp"
#include "kernels/vec3.hpp"

namespace orrery::kernels {

template <class F>
struct Sphere {
    Vec3<F> centre;
    F radius, radius2;
};

template <class V>
ORRERY_INLINE Sphere<Floats<V>> broadcast_sphere(const Spheres<V>& spheres, std::uint32_t k) {
    using F = Floats<V>;
    return {{F(spheres.cx[k]), F(spheres.cy[k]), F(spheres.cz[k])}, F(spheres.radius[k]), F(spheres.radius2[k])};
}

template <class V>
ORRERY_INLINE Sphere<Floats<V>> gather_sphere(const Spheres<V>& spheres, const Words<V>& id) {
    const auto radius = lookup<Floats<V>>(spheres.radius, id, spheres.count);
    return {lookup3<V>(spheres.cx, spheres.cy, spheres.cz, id, spheres.count), radius, radius * radius};
}

/// f.f - r^2: > 0 outside the sphere, < 0 inside (the power of the point).
template <class F>
ORRERY_INLINE F power_of_point(const Vec3<F>& f, const F& radius2) {
    return mul_add(f.x, f.x, mul_add(f.y, f.y, mul_sub(f.z, f.z, radius2)));
}

/// The line of a ray against one sphere.
template <class F>
struct Chord {
    F b;     ///< distance along the ray to the point closest to the centre
    F c;     ///< power of the origin
    F disc;  ///< half chord squared; the line meets the sphere where > 0: a tangent misses
};

template <class F>
ORRERY_INLINE Chord<F> chord(const Vec3<F>& origin, const Vec3<F>& direction, const Sphere<F>& sphere) {
    const Vec3<F> f = sphere.centre - origin;
    const F b = dot(f, direction);
    const Vec3<F> l = back_along(f, b, direction);
    const F disc = neg_mul_add(l.x, l.x, neg_mul_add(l.y, l.y, neg_mul_add(l.z, l.z, sphere.radius2)));
    return {b, power_of_point(f, sphere.radius2), disc};
}

/// t = num / den, den > 0.
template <class V>
struct Root {
    Floats<V> num, den;
    Mask<V> exists;
    Mask<V> inside;  ///< it is the far one: the ray meets the sphere from within
};

/// A segment that begins at its ray's origin: t_min = 0, known when compiling.
struct FromOrigin {};
template <class F>
ORRERY_INLINE F times(FromOrigin, const F&) {
    return F(0);
}
template <class F>
ORRERY_INLINE F times(const F& t_min, const F& den) {
    return t_min * den;
}

/// The first root > t_min of a chord whose half length is s = sqrt(disc), among the lanes of `candidate`. Where the
/// line misses the sphere s is no number, and num or den with it: no comparison of t holds. Start is FromOrigin or a
/// vector of t_min >= 0.
template <class V, class Start>
ORRERY_INLINE Root<V> first_root(const Chord<Floats<V>>& chord, const Floats<V>& s, const Start& t_min,
                                 const Mask<V>& candidate) {
    using F = Floats<V>;
    const auto ahead = chord.b > F(0);
    const F q = magnitude(chord.b) + s;
    // Ahead: the near root c/q, or the far one q where the near one is not beyond t_min (from inside, c < 0, it never
    // is). Behind: -c/q, from inside only.
    const auto far_is_q = ahead && chord.c <= times(t_min, q);
    const F num = choose(far_is_q, q, magnitude(chord.c));
    const F den = choose(far_is_q, F(1), q);
    auto exists = candidate && (ahead || chord.c < F(0));
    if constexpr (!std::is_same_v<Start, FromOrigin>) exists = exists && num > times(t_min, den);
    return {num, den, exists, far_is_q || !ahead};
}

/// Lanes whose near root c / (b + sqrt(disc)) exists and lies before 1 / inverse_t: exactly where g = c / t - b is
/// negative or g^2 < disc. No square root and no division; the signs are tested together, one comparison where masks
/// would take three.
template <class V>
ORRERY_INLINE Mask<V> near_root_before(const Chord<Floats<V>>& chord, const Floats<V>& inverse_t) {
    using F = Floats<V>;
    const F g = mul_sub(chord.c, inverse_t, chord.b);
    return min(chord.disc, min(chord.b, chord.c)) > F(0) && g * magnitude(g) < chord.disc;
}

/// Where a ray that leaves sphere `departed` inward meets it again: 2b, clamped at 0 for rounding at grazing incidence.
template <class F>
ORRERY_INLINE F inner_far_root(const Vec3<F>& origin, const Vec3<F>& direction, const Sphere<F>& sphere) {
    const F b = dot(sphere.centre - origin, direction);
    return max(b + b, F(0));
}

}  // namespace orrery::kernels
