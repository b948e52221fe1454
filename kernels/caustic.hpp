// The geometry of caustics: directions from a vertex that reach a spherical lamp over a ball, and their sampling.
//
// With A the axis from the vertex to the ball's centre, a direction is given by its impact parameter s and its azimuth
// phi about A; phi = 0 is towards the lamp. What leaves the ball has the impact parameter s again and the direction
// -cos T A + sin T e_phi, T(s) = 2 asin(s/R) - asin(s/d) + chords (pi - 2 asin(s/(eta R))). It meets the lamp, whose
// centre is w = along A + across e_0 from the ball's, iff (sin T along + cos T X + s)^2 + across^2 - X^2 <= r^2 for
// X = across cos phi. So for given s the azimuths are at most two intervals, about 0 and about pi; and the s for which
// there are any are looked for between the steps of a Caustic. What is overlooked there costs noise, but no bias: the
// samples compete with paths that find the lamp by chance (Veach and Guibas 1995).
#pragma once

#include "kernels/sampling.hpp"
#include "kernels/sphere.hpp"
#include "kernels/tables.hpp"

namespace orrery::kernels {

/// A vector of vertices beside a ball and its lamp.
template <class V>
struct BallFrame {
    Vec3Of<V> axis;                        ///< A, unit length
    Vec3Of<V> towards;                     ///< e_0, unit length, perpendicular to A
    Floats<V> distance, inverse_distance;  ///< to the ball's centre
    Floats<V> along, across;               ///< of the lamp's centre; across > 0
    Mask<V> outside;                       ///< the vertex is outside the ball; the rest means nothing elsewhere
};

template <class V>
ORRERY_INLINE BallFrame<V> ball_frame(const Caustic<RealOf<V>>& caustic, const Vec3Of<V>& p) {
    using F = Floats<V>;
    const Vec3<F> to = Vec3<F>{F(caustic.cx), F(caustic.cy), F(caustic.cz)} - p;
    const F distance2 = dot(to, to);
    const F inverse = F(1) / root(distance2);
    const Vec3<F> axis = to * inverse;
    const Vec3<F> w{F(caustic.wx), F(caustic.wy), F(caustic.wz)};
    const F on_axis = dot(w, axis);
    const Vec3<F> off = back_along(w, on_axis, axis);
    const F across = root(dot(off, off));
    // On the axis all azimuths are alike.
    const F least = F(4 * std::numeric_limits<RealOf<V>>::epsilon()) * root(dot(w, w));
    const auto beside = across > least;
    const Vec3<F> towards = choose(beside, off * (F(1) / across), basis_around(axis).s);
    return {axis,
            towards,
            distance2 * inverse,
            inverse,
            on_axis,
            max(across, least),
            power_of_point(to, F(caustic.radius2)) > F(0)};
}

/// T, as its sine and cosine.
template <class F>
struct Turn {
    F sine, cosine;
};

template <class V, class Step>
ORRERY_INLINE Turn<Floats<V>> turn_at(const Step& step, const BallFrame<V>& frame) {
    using F = Floats<V>;
    const F sine = F(step.s) * frame.inverse_distance;  // of asin(s/d)
    const F cosine = root(max(neg_mul_add(sine, sine, F(1)), F(0)));
    return {mul_sub(F(step.sine), cosine, F(step.cosine) * sine), mul_add(F(step.cosine), cosine, F(step.sine) * sine)};
}

/// The azimuths for which a direction reaches the lamp: |phi| <= first, and |phi - pi| <= second.
template <class F>
struct Azimuths {
    F first, second;      ///< radians
    F u_first, u_second;  ///< 1 - cos of them
};

namespace detail {

/// 1 - cos of the greatest azimuth, counted from the side where X = across, or (`other`) X = -across; 0: none, 2: all.
/// With X = +- across (1 - u) the inequality above is a quadratic one in u, a u^2 + 2 b u + c <= 0 with a <= 0; in this
/// form nothing cancels for small lamps.
template <class V>
ORRERY_INLINE Floats<V> reach_of_azimuth(const BallFrame<V>& frame, const Turn<Floats<V>>& turn, const Floats<V>& s,
                                         const Floats<V>& lamp_radius, bool other) {
    using F = Floats<V>;
    const F x = other ? F(0) - frame.across : frame.across;
    const F off = mul_add(turn.sine, frame.along, mul_add(turn.cosine, x, s));
    const F c = (off - lamp_radius) * (off + lamp_radius);
    const F b = x * neg_mul_add(off, turn.cosine, x);
    const F broad = turn.sine * frame.across;
    const F disc = mul_add(b, b, broad * broad * c);
    const F below = b + root(max(disc, F(0)));
    const auto ahead = mul_sub(turn.sine, x, turn.cosine * frame.along) > F(0);
    const auto crosses = disc > F(0) && below > F(0);
    const F u = choose(crosses, min((F(0) - c) / below, F(2)), F(2));
    return choose(ahead && c < F(0), u, F(0));
}

/// The angle in [0, pi] with 1 - cos = u, to 1e-7 of itself: 2 asin(sqrt(u / 2)), by the series of Cephes' asinf
/// (Moshier).
template <class V>
ORRERY_INLINE Floats<V> angle_of(const Floats<V>& u) {
    using F = Floats<V>;
    using Real = typename V::Real;
    const auto series = [](const F& x, const F& z) {
        F sum(static_cast<Real>(4.2163199048e-2));
        for (const double k : {2.4181311049e-2, 4.5470025998e-2, 7.4953002686e-2, 1.6666752422e-1})
            sum = mul_add(sum, z, F(static_cast<Real>(k)));
        return mul_add(sum * z, x, x);
    };
    const F z = u * F(0.5f), x = root(z);
    const auto wide = x > F(0.5f);
    const F rest = choose(wide, (F(1) - x) * F(0.5f), z);
    const F part = series(root(max(rest, F(0))), rest);
    return choose(wide, neg_mul_add(F(4), part, F(static_cast<Real>(std::numbers::pi))), part + part);
}

}  // namespace detail

template <class V>
ORRERY_INLINE Azimuths<Floats<V>> azimuths_at(const Caustic<RealOf<V>>& caustic, const BallFrame<V>& frame,
                                              const Turn<Floats<V>>& turn, const Floats<V>& s) {
    using F = Floats<V>;
    const F r(caustic.lamp_radius), pi(static_cast<RealOf<V>>(std::numbers::pi));
    Azimuths<F> to;
    to.u_first = detail::reach_of_azimuth<V>(frame, turn, s, r, false);
    to.u_second = detail::reach_of_azimuth<V>(frame, turn, s, r, true);
    const auto all_ways = to.u_first >= F(2) && to.u_second >= F(2);
    to.u_first = choose(all_ways, F(1), to.u_first);
    to.u_second = choose(all_ways, F(1), to.u_second);
    to.first = detail::angle_of<V>(to.u_first);
    to.second = detail::angle_of<V>(to.u_second);
    const auto once_around = to.first + to.second > pi;  // by rounding, or where one of the two is all
    const auto whole_first = once_around && !all_ways;
    to.first = choose(whole_first, pi, to.first), to.u_first = choose(whole_first, F(2), to.u_first);
    to.second = choose(whole_first, F(0), to.second), to.u_second = choose(whole_first, F(0), to.u_second);
    return to;
}

/// Impact parameters from `from` to `to` for which the lamp may be met near azimuth 0 or pi; sampled at `rate` a
/// length.
template <class F>
struct Interval {
    F from, to, rate;
};

namespace detail {

/// How far the exit line passes beside the lamp's centre in the plane of A and the lamp, on the side of azimuth 0 or
/// pi; where it runs away from the lamp, far off.
template <class V>
ORRERY_INLINE Floats<V> miss_of(const BallFrame<V>& frame, const Turn<Floats<V>>& turn, const Floats<V>& s,
                                const Floats<V>& far, bool other) {
    using F = Floats<V>;
    const F x = other ? F(0) - frame.across : frame.across;
    const F off = F(0) - mul_add(turn.sine, frame.along, mul_add(turn.cosine, x, s));
    const auto ahead = mul_sub(turn.sine, x, turn.cosine * frame.along) > F(0);
    return choose(ahead, off, choose(off < F(0), off - far, off + far));
}

}  // namespace detail

/// Calls visit(interval about azimuth 0, interval about pi) between all steps where some lane has one; the rate is 0
/// where a lane has none. Deterministic in the vertex: what samples and what tells the density see the same intervals.
template <class V, class Visit>
ORRERY_INLINE void each_interval(const Caustic<RealOf<V>>& caustic, const BallFrame<V>& frame, const Visit& visit) {
    using F = Floats<V>;
    using Real = typename V::Real;
    const F r(caustic.lamp_radius), far(1000 * caustic.lamp_radius), near(900 * caustic.lamp_radius);
    Turn<F> last{};
    F miss[2] = {F(0), F(0)};
    for (std::uint32_t i = 0; i <= caustic.steps; ++i) {
        const auto& step = caustic.step[i];
        const Turn<F> turn = turn_at(step, frame);
        const F next[2] = {detail::miss_of<V>(frame, turn, F(step.s), far, false),
                           detail::miss_of<V>(frame, turn, F(step.s), far, true)};
        if (i > 0) {
            const auto& before = caustic.step[i - 1];
            // T is no straight line between two steps: a margin.
            const auto margin = [&](int k) {
                return mul_add(F(Real(0.05)), min(magnitude(next[k] - miss[k]), F(4) * r), F(Real(1.15)) * r);
            };
            const auto met = [&](int k, const F& m) {
                return frame.outside && min(miss[k], next[k]) < m && max(miss[k], next[k]) > F(0) - m &&
                       min(magnitude(miss[k]), magnitude(next[k])) < near;
            };
            const F margins[2] = {margin(0), margin(1)};
            const Mask<V> some[2] = {met(0, margins[0]), met(1, margins[1])};
            if (any(some[0] || some[1])) {
                const F length(step.s - before.s), middle((step.s + before.s) / 2);
                const Turn<F> sum{last.sine + turn.sine, last.cosine + turn.cosine};
                const F norm = F(1) / root(mul_add(sum.sine, sum.sine, sum.cosine * sum.cosine));
                const Turn<F> mean{sum.sine * norm, sum.cosine * norm};
                const F width = root(F(2) * detail::reach_of_azimuth<V>(frame, mean, middle, r, false)) +
                                root(F(2) * detail::reach_of_azimuth<V>(frame, mean, middle, r, true));
                const F rate = (middle + F(Real(0.02) * caustic.radius)) *
                               F((before.share + step.share) / 2 + Real(0.02)) * (width + F(Real(0.3)));
                Interval<F> found[2];
                for (int k = 0; k < 2; ++k) {
                    const F slope = next[k] - miss[k];
                    const F inverse = F(1) / slope;
                    const F at_low = (F(0) - margins[k] - miss[k]) * inverse,
                            at_high = (margins[k] - miss[k]) * inverse;
                    const auto straight = magnitude(slope) > F(0) && max(magnitude(miss[k]), magnitude(next[k])) < near;
                    const F begin = choose(straight, max(min(at_low, at_high), F(0)), F(0));
                    const F end = choose(straight, min(max(at_low, at_high), F(1)), F(1));
                    found[k] = {mul_add(begin, length, F(before.s)), mul_add(end, length, F(before.s)),
                                choose(some[k] && end > begin, rate, F(0))};
                }
                visit(found[0], found[1]);
            }
        }
        last = turn;
        miss[0] = next[0], miss[1] = next[1];
    }
}

/// How often a vertex would sample one of a ball's caustics: `rate` times the ball's apparent size and the cosine with
/// the normal. 0 where geometry alone excludes them: the vertex within or on the ball, the ball below the horizon.
template <class V>
ORRERY_INLINE Floats<V> caustic_demand(const Caustic<RealOf<V>>& caustic, const Floats<V>& rate, const Vec3Of<V>& p,
                                       const Vec3Of<V>& normal, const Words<V>& sphere) {
    using F = Floats<V>;
    using U = Words<V>;
    const Vec3<F> to = Vec3<F>{F(caustic.cx), F(caustic.cy), F(caustic.cz)} - p;
    const F inverse = F(1) / root(dot(to, to));
    const F sine = F(caustic.radius) * inverse, cosine = dot(to, normal) * inverse;
    const F demand = rate * sine * sine * max(cosine, sine * F(0.5f));
    const auto above =
        power_of_point(to, F(caustic.radius2)) > F(0) && cosine > F(0) - sine && !words_equal(sphere, U(caustic.ball));
    return choose(above, demand, F(0));
}

/// The demands of a vertex by group, and their sum. It samples one caustic at most: one of a group with the probability
/// of its demand over the sum, or over 1 if that is more.
template <class V>
struct CausticDemands {
    Floats<V> of[most_caustic_groups];
    Floats<V> sum;
    ORRERY_INLINE Floats<V> all() const { return max(sum, Floats<V>(1)); }
};

template <class V>
ORRERY_INLINE CausticDemands<V> caustic_demands(const CausticTable<RealOf<V>>& caustics, const Floats<V>& scale,
                                                const Vec3Of<V>& p, const Vec3Of<V>& normal, const Words<V>& sphere) {
    using F = Floats<V>;
    CausticDemands<V> demands;
    demands.sum = F(0);
    for (std::uint32_t g = 0; g < caustics.groups; ++g) {
        const auto& group = caustics.group[g];
        demands.of[g] = caustic_demand<V>(caustics.entries[group.first], F(group.rate) * scale, p, normal, sphere);
        demands.sum = demands.sum + demands.of[g];
    }
    return demands;
}

}  // namespace orrery::kernels
