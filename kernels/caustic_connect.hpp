// Stage `caustic`: the vertices of a run -> shadow queue, which then walks over the ball, segment by segment.
//
// A sample is made in two steps. Few vertices pick a ball's caustic, by a probability that says how much may come of
// it; those that do look for the lamp in the ball. What arrives is known before anything is traced: the sample's
// direction fixes all angles at the ball. What is left to find out is whether anything is in the way.
#pragma once

#include "kernels/caustic.hpp"
#include "kernels/connect.hpp"

namespace orrery::kernels {

/// Fresnel's share of all events at a ball, for impact parameter s: the same angle each time.
template <class V>
ORRERY_INLINE Floats<V> share_of_events(const Caustic<RealOf<V>>& caustic, const Floats<V>& s) {
    using F = Floats<V>;
    if (caustic.mirror) return F(1);
    const F sine = s * F(1 / caustic.radius);
    const F cosine = root(max((F(1) - sine) * (F(1) + sine), F(0)));
    const F reflected = interface_at<V>(cosine, F(caustic.eta)).reflectance;
    if (caustic.chords == 0) return reflected;
    const F through = (F(1) - reflected) * (F(1) - reflected);
    return caustic.chords == 1 ? through : through * reflected;
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

/// What carried powers to the vertex's bounce.
template <class Real>
ORRERY_INLINE Real caustic_scale(const CausticTable<Real>& caustics, std::uint32_t bounce) {
    Real scale = 1;
    for (std::uint32_t b = 0; b < bounce && scale > Real(1e-6); ++b) scale *= caustics.carried;
    return scale;
}

/// Rough vertices see a ball through their lobe, sharper than a diffuse one.
template <Response response, class Real>
ORRERY_INLINE Real rough_scale(Real scale) {
    return response == Response::glossy ? 4 * scale : scale;
}

template <class V>
struct CausticVertex {
    Vec3Of<V> position, normal;
    Words<V> departed, sphere;
};
template <class V>
ORRERY_INLINE CausticVertex<V> caustic_vertex(const Spheres<V>& spheres, const Vec3Of<V>& p, const Words<V>& departed) {
    using F = Floats<V>;
    using U = Words<V>;
    const U id = departed & U(no_sphere);
    const auto centre = lookup3<V>(spheres.cx, spheres.cy, spheres.cz, id, spheres.count);
    const Vec3<F> outward = (p - centre) * lookup<F>(spheres.inverse_radius, id, spheres.count);
    return {p, choose(words_equal(departed, id), outward, outward * F(-1)), departed, id};
}

/// Chooses the vertices of a run that sample a caustic of the group, and which one. Returns how many.
template <class V, Response response>
std::uint32_t pick_caustics(const CausticContext<RealOf<V>>& context, std::uint32_t group, Range run,
                            const Rays<V>& rays, const Picks<V>& picks) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& of = context.caustics.group[group];
    const auto* const members = context.caustics.entries + of.first;
    const F rate(of.rate * rough_scale<response>(caustic_scale(context.caustics, context.bounce)));
    const RandomKey key{context.seed, Dimension::caustic, group};
    draw<V, 4>(context.slots, rays, run, key, context.bounce);
    std::uint32_t picked = 0;
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto in_run = first_lanes<V>(run.count - n);
        const auto v = caustic_vertex<V>(context.spheres, load3<V>(rays.ox + i, rays.oy + i, rays.oz + i),
                                         choose(in_run, load<U>(rays.departed + i), U(0u)));
        const F q = caustic_probability<V>(*members, rate, v.position, v.normal, v.sphere);
        if (!any(q > F(0))) continue;
        const F x = random_for<V, 4>(context.slots, rays, i, key, context.bounce).x;
        const auto dead = carries_nothing(load3<V>(rays.tr + i, rays.tg + i, rays.tb + i));
        const std::uint32_t chosen = bits(x < q && in_run && !dead);
        if (chosen == 0) continue;
        U which(of.first);
        RealOf<V> below = 0;
        for (std::uint32_t m = 0; m + 1 < of.count; ++m) {
            below += members[m].share;
            which = choose(x < q * F(below), which, U(of.first + m + 1));
        }
        compress_store<V>(picks.place + picked, consecutive<V>(i), chosen);
        compress_store<V>(picks.caustic + picked, which, chosen);
        compress_store<V>(picks.probability + picked, q, chosen);
        picked += static_cast<std::uint32_t>(std::popcount(chosen));
    }
    return picked;
}

/// Samples one caustic from the vertices that picked it. Returns the number of shadow rays: first segments, with the
/// radiance that arrives if nothing blocks the chain.
template <class V, Response response>
std::uint32_t connect_caustic(const CausticContext<RealOf<V>>& context, std::uint32_t which, std::uint32_t picked,
                              const Rays<V>& rays, const Lobes<V>& lobes, const Picks<V>& picks,
                              const Shadows<V>& queue) {
    using Real = RealOf<V>;
    using F = Floats<V>;
    using U = Words<V>;
    const auto& caustic = context.caustics.entries[which];
    std::uint32_t group = 0;
    while (which >= context.caustics.group[group].first + context.caustics.group[group].count) ++group;
    const RandomKey key{context.seed, Dimension::caustic, group};
    // Those of this caustic, gathered until they fill a vector.
    alignas(64) WordOf<Real> place[2 * V::count] = {};
    alignas(64) Real probability[2 * V::count] = {};
    std::uint32_t waiting = 0, size = 0;
    const auto connect_vector = [&](std::uint32_t count) {
        const auto live = first_lanes<V>(count);
        const U i = choose(live, load<U>(place), load<U>(picks.place) & U(0u));
        const auto at = [&](const Real* column) { return gather<F>(column, i); };
        const U departed = gather<U>(rays.departed, i);
        const auto v =
            caustic_vertex<V>(context.spheres, {at(rays.ox), at(rays.oy), at(rays.oz)}, choose(live, departed, U(0u)));
        RandomNumbers<F> random;
        if (context.slots.sobol.x != nullptr) {
            random = {F(0), at(context.slots.sobol.y), at(context.slots.sobol.z), at(context.slots.sobol.w)};
        } else {
            random = random_block<V>(key, gather<U>(rays.pixel, i), gather<U>(rays.sample, i), U(context.bounce));
        }
        const auto frame = ball_frame<V>(caustic, v.position);
        const auto sample = sample_caustic<V>(caustic, frame, random.y, random.z, random.w);
        const F cosine = dot(v.normal, sample.direction);
        F pdf = max(cosine, F(0)) * F(static_cast<Real>(std::numbers::inv_pi));
        if constexpr (response == Response::glossy) {
            const U material =
                lookup<U>(context.spheres.surface, v.sphere, context.spheres.count) & U(surface_material_mask);
            const F beta = lookup<F>(context.materials.roughness, material, context.materials.count);
            const Vec3<F> lobe{at(lobes.x), at(lobes.y), at(lobes.z)};
            pdf = glossy_pdf<V>(lobe, max(dot(lobe, v.normal), F(0)), beta, sample.direction, cosine);
        }
        const F often = load<F>(probability) * F(caustic.share);
        const F weight = shared_ratio(pdf * share_of_events<V>(caustic, sample.s) / (often * sample.pdf));
        const Sphere<F> ball{{F(caustic.cx), F(caustic.cy), F(caustic.cz)}, F(caustic.radius), F(caustic.radius2)};
        const auto line = chord(v.position, sample.direction, ball);
        const std::uint32_t arriving = bits(live && sample.valid && !(weight <= F(0)) && min(line.disc, line.b) > F(0));
        if (arriving == 0) return;
        const Vec3<F> colour{F(caustic.r), F(caustic.g), F(caustic.b)};
        const Vec3<F> throughput{at(rays.tr), at(rays.tg), at(rays.tb)};
        size = append_shadow<V>(queue, size, v.position, sample.direction, (line.b + root(line.disc)) / line.c,
                                throughput * (colour * weight), departed, gather<U>(rays.slot, i), arriving);
    };
    for (std::uint32_t n = 0; n < picked; n += V::count) {
        const std::uint32_t chosen =
            bits(first_lanes<V>(picked - n) && words_equal(load<U>(picks.caustic + n), U(which)));
        if (chosen == 0) continue;
        compress_store<V>(place + waiting, load<U>(picks.place + n), chosen);
        compress_store<V>(probability + waiting, load<F>(picks.probability + n), chosen);
        waiting += static_cast<std::uint32_t>(std::popcount(chosen));
        if (waiting < V::count) continue;
        connect_vector(V::count);
        waiting -= V::count;
        save(place, load<U>(place + V::count));
        save(probability, load<F>(probability + V::count));
    }
    if (waiting > 0) connect_vector(waiting);
    return size;
}

/// Moves every segment of the queue, which ends on the ball, over its event there to the next one: within the ball, or
/// from the ball to the lamp. What would miss the lamp, by rounding, carries nothing.
template <class V>
void follow_caustic(const Spheres<V>& spheres, const Caustic<RealOf<V>>& caustic, std::uint32_t event,
                    const Shadows<V>& queue, std::uint32_t count) {
    using F = Floats<V>;
    using U = Words<V>;
    const Sphere<F> ball{{F(caustic.cx), F(caustic.cy), F(caustic.cz)}, F(caustic.radius), F(caustic.radius2)};
    const Sphere<F> lamp = broadcast_sphere<V>(spheres, caustic.lamp);
    const bool inside = event > 0, leaves = event == caustic.chords;
    const bool refracts = caustic.chords > 0 && (event == 0 || leaves);
    const F eta(inside ? 1 / caustic.eta : caustic.eta);
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto o = load3<V>(queue.ox + i, queue.oy + i, queue.oz + i);
        const auto d = load3<V>(queue.dx + i, queue.dy + i, queue.dz + i);
        const F t = F(1) / load<F>(queue.inverse_t_max + i);
        const Vec3<F> outward = unit(along(o - ball.centre, t, d));
        const Vec3<F> normal = inside ? outward * F(-1) : outward;
        const F cosine = min(max(F(0) - dot(normal, d), F(0)), F(1));
        const Vec3<F> position = along(ball.centre, ball.radius, outward);
        const Vec3<F> direction = refracts ? refracted<V>(d, normal, cosine, interface_at<V>(cosine, eta))
                                           : unit(reflected(d, normal, cosine));
        save3<V>(queue.ox + i, queue.oy + i, queue.oz + i, position);
        save3<V>(queue.dx + i, queue.dy + i, queue.dz + i, direction);
        save(queue.departed + i, U(leaves ? caustic.ball : caustic.ball | inside_bit));
        if (!leaves) {
            save(queue.inverse_t_max + i, F(1) / inner_far_root(position, direction, ball));
            continue;
        }
        const auto line = chord(position, direction, lamp);
        const auto meets = min(line.disc, min(line.b, line.c)) > F(0);
        save(queue.inverse_t_max + i, choose(meets, (line.b + root(max(line.disc, F(0)))) / line.c, F(1)));
        const auto carried = load3<V>(queue.r + i, queue.g + i, queue.b + i);
        save3<V>(queue.r + i, queue.g + i, queue.b + i, choose(meets, carried, Vec3<F>{F(0), F(0), F(0)}));
    }
}

}  // namespace orrery::kernels
