// Directions from a vertex to a lamp over a ball: drawn at random, and the density with which they are.
#pragma once

#include "kernels/caustic.hpp"
#include "kernels/lobes.hpp"

namespace orrery::kernels {

/// Fresnel's share of all events at a ball of glass, by the cosine of the angle with the normal outside: the same angle
/// each time.
template <class V>
ORRERY_INLINE Floats<V> share_of_events(std::uint32_t chords, const Floats<V>& eta, const Floats<V>& cosine) {
    using F = Floats<V>;
    const F reflected = interface_at<V>(cosine, eta).reflectance;
    if (chords == 0) return reflected;
    F share = (F(1) - reflected) * (F(1) - reflected);
    for (std::uint32_t m = 1; m < chords; ++m) share = share * reflected;
    return share;
}

/// The same for impact parameter s; of a mirror 1.
template <class V>
ORRERY_INLINE Floats<V> share_of_events(const Caustic<RealOf<V>>& caustic, const Floats<V>& s) {
    using F = Floats<V>;
    if (caustic.mirror) return F(1);
    const F sine = s * F(1 / caustic.radius);
    const F cosine = root(max((F(1) - sine) * (F(1) + sine), F(0)));
    return share_of_events<V>(caustic.chords, F(caustic.eta), cosine);
}

/// A number that chooses between things that come one after another, with weights known only then.
template <class F>
struct Choosing {
    F number;        ///< uniform in [0, 1), used up and stretched again at each
    F total = F(0);  ///< of the weights so far

    /// Lanes that take the newcomer.
    ORRERY_INLINE auto takes(const F& weight) {
        total = total + weight;
        const F scaled = number * total;
        const auto taken = scaled < weight;
        const F range = choose(taken, weight, total - weight);
        // A weight of 0 leaves it as it is, so that no lane depends on what its neighbours find.
        number = choose(min(weight, range) > F(0), choose(taken, scaled, scaled - weight) / range, number);
        return taken;
    }
};

/// A direction sampled from a vertex.
template <class V>
struct CausticSample {
    Vec3Of<V> direction;
    Floats<V> s;
    Floats<V> pdf;  ///< per solid angle, > 0 where valid
    Mask<V> valid;
};

/// Per solid angle, from that of s and phi: d omega = s ds dphi / (d^2 cos psi), sin psi = s / d.
template <class V>
ORRERY_INLINE Floats<V> caustic_density(const BallFrame<V>& frame, const Floats<V>& s, const Floats<V>& s_density,
                                        const Azimuths<Floats<V>>& azimuths) {
    using F = Floats<V>;
    const F sine = s * frame.inverse_distance;
    const F cosine = root(max(neg_mul_add(sine, sine, F(1)), F(0)));
    return s_density * frame.distance * frame.distance * cosine / (F(2) * (azimuths.first + azimuths.second) * s);
}

/// T between the steps.
template <class V>
ORRERY_INLINE Turn<Floats<V>> turn_between(const Caustic<RealOf<V>>& caustic, const BallFrame<V>& frame,
                                           const Floats<V>& s) {
    using F = Floats<V>;
    const auto unit_of = [](const F& sine) { return Turn<F>{sine, root(max((F(1) - sine) * (F(1) + sine), F(0)))}; };
    const auto sum = [](const Turn<F>& a, const Turn<F>& b) {
        return Turn<F>{mul_add(a.sine, b.cosine, a.cosine * b.sine), mul_sub(a.cosine, b.cosine, a.sine * b.sine)};
    };
    const Turn<F> hit = unit_of(min(s * F(1 / caustic.radius), F(1)));
    Turn<F> turn = sum(hit, hit);
    if (caustic.chords > 0) {
        // pi less twice the angle within: its sine, and its negated cosine.
        const Turn<F> within = unit_of(min(s * F(1 / (caustic.eta * caustic.radius)), F(1)));
        const Turn<F> twice = sum(within, within);
        for (std::uint32_t m = 0; m < caustic.chords; ++m) turn = sum(turn, {twice.sine, F(0) - twice.cosine});
    }
    const Turn<F> at = unit_of(s * frame.inverse_distance);
    return sum(turn, {F(0) - at.sine, at.cosine});
}

template <class V>
ORRERY_INLINE CausticSample<V> sample_caustic(const Caustic<RealOf<V>>& caustic, const BallFrame<V>& frame,
                                              const Floats<V>& u, const Floats<V>& v, const Floats<V>& w) {
    using F = Floats<V>;
    Choosing<F> which{u};
    F s(0), rate(0);
    each_interval<V>(caustic, frame, [&](const Interval<F>& first, const Interval<F>& second) ORRERY_INLINE_LAMBDA {
        const F weight = first.rate * (first.to - first.from);
        const F both = weight + second.rate * (second.to - second.from);
        const auto taken = which.takes(both);
        const auto from_first = which.number * both < weight;
        const F begin = choose(from_first, first.from, second.from), end = choose(from_first, first.to, second.to);
        const F at = mul_add(end - begin, v, begin);
        const auto density = [&](const Interval<F>& i) { return choose(at >= i.from && at < i.to, i.rate, F(0)); };
        s = choose(taken, at, s);
        rate = choose(taken, density(first) + density(second), rate);
    });
    const Turn<F> turn = turn_between(caustic, frame, s);
    const auto azimuths = azimuths_at<V>(caustic, frame, turn, s);
    const F range = azimuths.first + azimuths.second;
    const F t = range * mul_sub(w, F(2), F(1));
    const F beyond = magnitude(t) - azimuths.first;
    const F half(static_cast<RealOf<V>>(0.5)), turns(static_cast<RealOf<V>>(0.5 * std::numbers::inv_pi));
    const F phi = choose(beyond <= F(0), t * turns, half + choose(t > F(0), beyond, F(0) - beyond) * turns);
    const auto e = sincos_turns<V>(choose(phi < F(0), phi + F(1), phi));
    const F sine = s * frame.inverse_distance;
    const F cosine = root(max(neg_mul_add(sine, sine, F(1)), F(0)));
    const Vec3<F> aside = cross(frame.axis, frame.towards);
    const Vec3<F> around = along(frame.towards * e.cos, e.sin, aside);
    const F pdf = caustic_density<V>(frame, s, rate / which.total, azimuths);
    return {unit(along(frame.axis * cosine, sine, around)), s, pdf, range > F(0) && s > F(0) && pdf > F(0)};
}

/// Density with which sample_caustic takes `direction`, unit length; 0 where it never does.
template <class V>
ORRERY_INLINE Floats<V> caustic_pdf(const Caustic<RealOf<V>>& caustic, const BallFrame<V>& frame,
                                    const Vec3Of<V>& direction) {
    using F = Floats<V>;
    const Vec3<F> aside = cross(frame.axis, direction);
    const F sine = root(dot(aside, aside));
    const F s = sine * frame.distance;
    F total(0), rate(0);
    each_interval<V>(caustic, frame, [&](const Interval<F>& first, const Interval<F>& second) ORRERY_INLINE_LAMBDA {
        for (const Interval<F>& i : {first, second}) {
            total = mul_add(i.rate, i.to - i.from, total);
            rate = rate + choose(s >= i.from && s < i.to, i.rate, F(0));
        }
    });
    const auto azimuths = azimuths_at<V>(caustic, frame, turn_between(caustic, frame, s), s);
    // 1 -+ cos phi, of which the smaller one from the sine keeps its digits.
    const F cos_phi = dot(direction, frame.towards) / sine;
    const F sin_phi = dot(direction, cross(frame.axis, frame.towards)) / sine;
    const F greater = F(1) + magnitude(cos_phi), smaller = sin_phi * sin_phi / greater;
    const auto ahead = cos_phi > F(0);
    const F u = choose(ahead, smaller, greater), u_other = choose(ahead, greater, smaller);
    const auto reaches =
        (u <= azimuths.u_first && azimuths.first > F(0)) || (u_other <= azimuths.u_second && azimuths.second > F(0));
    return choose(frame.outside && rate > F(0) && s > F(0) && reaches,
                  caustic_density<V>(frame, s, rate / total, azimuths), F(0));
}

}  // namespace orrery::kernels
