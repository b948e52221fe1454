// The geometry of point lights' caustics: the directions from a vertex whose rays pass a point after reflection off a
// ball, or after a number of chords within it.
//
// Every normal of a ball passes its centre, so that such a path stays in the plane of centre, vertex and point, and
// passes the centre at the same distance s all the way. As seen from there it turns by
//     Phi = 2 asin(s/R) - asin(s/d) - asin(s/e) + chords (pi - 2 asin(s/(eta R))),
// d and e being the distances of vertex and point, and that must be 2 pi n +- Phi0, Phi0 the angle between the two.
// With theta the greater one of asin(s/R) and asin(s/(eta R)), Phi falls all the way where eta < 1 and there are
// chords. Elsewhere it is convex, as asin(c sin theta) for c <= 1 is concave: it falls to a least value, the edge of a
// caustic, and rises. So every target has one root at most on either side, and none is missed.
#pragma once

#include <limits>

#include "kernels/sampling.hpp"

namespace orrery::kernels {

/// What vertices, a ball and a point tell of the paths between them. Each of the angles is asin(c sin theta) for a c
/// in [0, 1] and comes with 1 - c^2, where digits would be lost.
template <class V>
struct PointPaths {
    struct Angle {
        Floats<V> c, rest;
    };
    std::uint32_t chords;
    Mask<V> dense;    ///< theta is the angle with the normal outside the ball and `other` that within, else the
                      ///< reverse; set without chords
    Angle other;      ///< unused without chords
    Angle at_vertex;  ///< between the path and the axis to the centre
    Angle at_point;
    SinCos<Floats<V>> between;  ///< Phi0, in [0, pi]; its sine > 0
};

/// One of them.
template <class V>
struct PointPath {
    SinCos<Floats<V>> from_axis;  ///< of its direction at the vertex
    Floats<V> incidence;          ///< cosine of the angle with the normal outside the ball
    Floats<V> spread;             ///< solid angle at the vertex per area at the point, across the path, times e^2
};

template <class M, class F>
ORRERY_INLINE SinCos<F> choose(const M& m, const SinCos<F>& a, const SinCos<F>& b) {
    return {choose(m, a.sin, b.sin), choose(m, a.cos, b.cos)};
}

namespace detail {

/// An angle by its sine and cosine, and its derivatives by theta.
template <class F>
struct AngleAt {
    SinCos<F> e;
    F slope, curve;
};

template <class F, class Angle>
ORRERY_INLINE AngleAt<F> angle_at(const Angle& angle, const SinCos<F>& theta) {
    const F sine = angle.c * theta.sin, across = angle.c * theta.cos;
    const F cosine = root(mul_add(across, across, angle.rest));
    const F inverse = F(1) / cosine;
    return {{sine, cosine}, across * inverse, F(0) - sine * angle.rest * (inverse * inverse * inverse)};
}

template <class F>
ORRERY_INLINE SinCos<F> sum(const SinCos<F>& a, const SinCos<F>& b) {
    return {mul_add(a.sin, b.cos, a.cos * b.sin), mul_sub(a.cos, b.cos, a.sin * b.sin)};
}
template <class F>
ORRERY_INLINE SinCos<F> difference(const SinCos<F>& a, const SinCos<F>& b) {
    return {mul_sub(a.sin, b.cos, a.cos * b.sin), mul_add(a.cos, b.cos, a.sin * b.sin)};
}

/// The angle in [0, pi] to 4e-5 (Abramowitz and Stegun, 4.4.49). On its cosine being -1 it is no number.
template <class V>
ORRERY_INLINE Floats<V> roughly(const SinCos<Floats<V>>& e) {
    using F = Floats<V>;
    const auto obtuse = e.cos < F(0);
    const F t = e.sin / (F(1) + magnitude(e.cos)), t2 = t * t;
    F series(0.0208351f);
    for (const float k : {-0.0851330f, 0.1801410f, -0.3302995f, 0.9998660f}) series = mul_add(series, t2, F(k));
    const F acute = F(2) * t * series;
    return choose(obtuse, F(static_cast<RealOf<V>>(std::numbers::pi)) - acute, acute);
}

/// Phi: by sine and cosine exactly, in radians roughly, and its derivatives.
template <class F>
struct PhiAt {
    AngleAt<F> phi;
    F angle;
};

template <class V>
ORRERY_INLINE PhiAt<Floats<V>> phi_at(const PointPaths<V>& paths, const Floats<V>& theta) {
    using F = Floats<V>;
    using Real = RealOf<V>;
    const F two(2), pi(static_cast<Real>(std::numbers::pi));
    const auto itself = sincos_turns<V>(theta * F(static_cast<Real>(0.5 * std::numbers::inv_pi)));
    const auto vertex = angle_at<F>(paths.at_vertex, itself), point = angle_at<F>(paths.at_point, itself);
    const F m(static_cast<Real>(paths.chords));
    SinCos<F> phi = sum(itself, itself);
    F angle = two * theta, slope = two, curve(0);
    if (paths.chords > 0) {
        const auto other = angle_at<F>(paths.other, itself);
        const F other_angle = roughly<V>(other.e);
        const SinCos<F> normal = choose(paths.dense, itself, other.e), within = choose(paths.dense, other.e, itself);
        const auto bend = difference(normal, within);
        phi = sum(bend, bend);
        const auto chord = sum(within, within);
        for (std::uint32_t k = 1; k < paths.chords; ++k) phi = difference(phi, chord);
        if (paths.chords % 2 == 1) phi = {F(0) - phi.sin, F(0) - phi.cos};
        const F of_within(Real(-2) * static_cast<Real>(paths.chords));
        const F of_theta = choose(paths.dense, two, of_within), of_other = choose(paths.dense, of_within, two);
        angle = mul_add(of_theta, theta, mul_add(of_other, other_angle, m * pi));
        slope = mul_add(of_other, other.slope, of_theta);
        curve = of_other * other.curve;
    }
    return {{difference(difference(phi, vertex.e), point.e), slope - vertex.slope - point.slope,
             curve - vertex.curve - point.curve},
            angle - roughly<V>(vertex.e) - roughly<V>(point.e)};
}

/// What Phi shall be: 2 pi rounds + side Phi0.
struct Target {
    std::uint32_t rounds;
    int side;
};

/// Phi less the target: by its sine, which is exact, where it is small, and roughly elsewhere.
template <class V>
ORRERY_INLINE Floats<V> beyond(const PointPaths<V>& paths, const Floats<V>& between, const Target& target,
                               const SinCos<Floats<V>>& phi, const Floats<V>& angle) {
    using F = Floats<V>;
    const F side(static_cast<RealOf<V>>(target.side));
    const F rounds(static_cast<RealOf<V>>(2 * std::numbers::pi * target.rounds));
    const F far = angle - mul_add(side, between, rounds);
    const F near = mul_sub(phi.sin, paths.between.cos, side * phi.cos * paths.between.sin);
    return choose(magnitude(far) > F(0.25f), far, near);
}

/// Newton's and Halley's methods end where a step is so small a part of what it came to: the next one would be below
/// rounding.
template <class V>
inline constexpr RealOf<V> small_step = sizeof(RealOf<V>) == 4 ? RealOf<V>(1e-4) : RealOf<V>(1e-6);

/// A zero between low and high by `step(theta, f)`, which returns what to subtract from theta and sets f to the value
/// there; the value has the sign of `sign` at low. A step that leaves the bracket halves it instead. Lanes that
/// have arrived stay, so that none depends on its neighbours.
template <class V, class Step>
ORRERY_INLINE Floats<V> zero_between(Mask<V> open, Floats<V> low, Floats<V> high, const Floats<V>& sign,
                                     Floats<V> theta, const Step& step) {
    using F = Floats<V>;
    for (int n = 0; n < 64 && any(open); ++n) {
        F f;
        const F change = step(theta, f);
        const auto as_low = f * sign > F(0);
        low = choose(as_low, theta, low);
        high = choose(as_low, high, theta);
        const F next = theta - change;
        const auto inside = next > low && next < high;
        const F to = choose(inside, next, F(0.5f) * (low + high));
        const F moved = magnitude(to - theta);
        theta = choose(open, to, theta);
        open = open && moved > choose(inside, F(small_step<V>), F(4 * std::numeric_limits<RealOf<V>>::epsilon())) * to;
    }
    return theta;
}

}  // namespace detail

/// Calls visit(lanes that have one, side, path) for every path: side 1 where it leaves the vertex towards the point's
/// side of the axis, else -1. `among`: lanes that matter.
template <class V, class Visit>
ORRERY_INLINE void each_point_path(const PointPaths<V>& paths, const Mask<V>& among, const Visit& visit) {
    using F = Floats<V>;
    using Real = RealOf<V>;
    using namespace detail;
    const F zero(0), end(static_cast<Real>(std::numbers::pi / 2 * (1 - 0x1p-20)));
    const F between = roughly<V>(paths.between);
    const PhiAt<F> first{{{zero, F(paths.chords % 2 == 0 ? Real(1) : Real(-1))}, zero, zero},
                         F(static_cast<Real>(std::numbers::pi * paths.chords))};
    const PhiAt<F> last = phi_at(paths, end);
    // Phi falls from 0 to `lowest` and rises from there to the end.
    F slope = F(2) - paths.at_vertex.c - paths.at_point.c;
    if (paths.chords > 0) slope = slope - F(static_cast<Real>(2 * paths.chords)) * paths.other.c;
    const auto falls = among && (slope < zero || !paths.dense), turns = falls && paths.dense;
    F lowest = choose(paths.dense, choose(turns, end * F(0.5f), zero), end);
    SinCos<F> least = choose(paths.dense, first.phi.e, last.phi.e);
    F least_angle = choose(paths.dense, first.angle, last.angle);
    if (any(turns)) {
        lowest = zero_between<V>(turns, zero, end, F(-1), lowest, [&](const F& theta, F& f) ORRERY_INLINE_LAMBDA {
            const auto phi = phi_at(paths, theta).phi;
            f = phi.slope;
            return phi.slope / phi.curve;
        });
        const PhiAt<F> there = phi_at(paths, lowest);
        least = choose(turns, there.phi.e, least);
        least_angle = choose(turns, there.angle, least_angle);
    }
    for (std::uint32_t k = 0; k <= paths.chords; ++k) {
        const Target target{(k + 1) / 2, k % 2 == 0 ? 1 : -1};
        const F before = beyond(paths, between, target, first.phi.e, first.angle);
        const F after = beyond(paths, between, target, last.phi.e, last.angle);
        const F middle = beyond(paths, between, target, least, least_angle);
        const auto found = [&](const Mask<V>& some, const F& low, const F& high, const F& sign,
                               const F& start) ORRERY_INLINE_LAMBDA {
            if (!any(some)) return;
            const F theta = zero_between<V>(some, low, high, sign, start, [&](const F& at, F& f) ORRERY_INLINE_LAMBDA {
                const PhiAt<F> turn = phi_at(paths, at);
                f = beyond(paths, between, target, turn.phi.e, turn.angle);
                const F twice = F(2) * turn.phi.slope;
                return twice * f / mul_sub(twice, turn.phi.slope, f * turn.phi.curve);
            });
            const auto e = sincos_turns<V>(theta * F(static_cast<Real>(0.5 * std::numbers::inv_pi)));
            const auto phi = phi_at(paths, theta).phi;
            const auto vertex = angle_at<F>(paths.at_vertex, e).e, point = angle_at<F>(paths.at_point, e).e;
            F incidence = e.cos;
            if (paths.chords > 0) incidence = choose(paths.dense, incidence, angle_at<F>(paths.other, e).e.cos);
            const F spread = paths.at_vertex.c * paths.at_vertex.c * e.sin * e.cos /
                             (vertex.cos * point.cos * magnitude(phi.e.sin * phi.slope));
            visit(some, target.side, PointPath<V>{vertex, incidence, spread});
        };
        // Begins where a parabola with its vertex at the least value would have it, or a straight line.
        const auto share = [&](const F& to) { return middle / (middle - to); };
        if (paths.chords > 0) {
            const F part = share(before);
            found(falls && before > zero && middle < zero, zero, lowest, F(1),
                  lowest * (F(1) - choose(paths.dense, root(max(part, zero)), part)));
        }
        const F part = share(after);
        found(among && paths.dense && middle < zero && after >= zero, lowest, end, F(-1),
              mul_add(end - lowest, choose(falls, root(max(part, zero)), part), lowest));
    }
}

}  // namespace orrery::kernels
