// Stage `caustic`: the vertices of a run -> shadow queue, which then walks over the ball, segment by segment.
//
// A sample is made in two steps. Few vertices pick a ball's caustic, by a probability that says how much may come of
// it; those that do look for the lamp in the ball. What arrives is known before anything is traced: the sample's
// direction fixes all angles at the ball. What is left to find out is whether anything is in the way.
#pragma once

#include "kernels/caustic_sample.hpp"
#include "kernels/connect.hpp"

namespace orrery::kernels {

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

/// Chooses the vertices of a run that sample a caustic, and which. Returns how many.
template <class V, Response response>
std::uint32_t pick_caustics(const CausticContext<RealOf<V>>& context, Range run, const Rays<V>& rays,
                            const Picks<V>& picks) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& caustics = context.caustics;
    const F scale(rough_scale<response>(caustic_scale(caustics, context.bounce)));
    const RandomKey key{context.seed, Dimension::caustic};
    const bool sobol = context.slots.sobol.x != nullptr;
    std::uint32_t picked = 0;
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto in_run = first_lanes<V>(run.count - n);
        const auto p = load3<V>(rays.ox + i, rays.oy + i, rays.oz + i);
        const U departed = choose(in_run, load<U>(rays.departed + i), U(0u));
        const auto demands = caustic_demands<V>(caustics, scale, p, departed_normal<V>(context.spheres, p, departed),
                                                departed & U(no_sphere));
        if (!any(demands.sum > F(0))) continue;
        const F x = random_now<V>(sobol, key, load<U>(rays.pixel + i), load<U>(rays.sample + i), U(context.bounce)).x;
        const auto dead = carries_nothing(load3<V>(rays.tr + i, rays.tg + i, rays.tb + i));
        const F all = demands.all();
        F rest = x * all;
        const std::uint32_t chosen = bits(rest < demands.sum && in_run && !dead);
        if (chosen == 0) continue;
        U which(0u);
        F demand(0);
        auto open = rest < demands.sum;
        for (std::uint32_t g = 0; g < caustics.groups; ++g) {
            const auto& of = caustics.group[g];
            // Where rounding leaves none, the last.
            const auto here = open && demands.of[g] > F(0);
            if (any(here)) {
                demand = choose(here, demands.of[g], demand);
                F bound(0);
                for (std::uint32_t m = 0; m < of.count; ++m) {
                    which = choose(here && rest >= bound, U(of.first + m), which);
                    bound = mul_add(demands.of[g], F(caustics.entries[of.first + m].share), bound);
                }
            }
            open = open && rest >= demands.of[g];
            rest = rest - demands.of[g];
        }
        compress_store<V>(picks.place + picked, consecutive<V>(i), chosen);
        compress_store<V>(picks.caustic + picked, which, chosen);
        compress_store<V>(picks.probability + picked, demand / all, chosen);
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
    const RandomKey key{context.seed, Dimension::caustic};
    const bool sobol = context.slots.sobol.x != nullptr;
    // Those of this caustic, gathered until they fill a vector.
    alignas(64) WordOf<Real> place[2 * V::count] = {};
    alignas(64) Real probability[2 * V::count] = {};
    std::uint32_t waiting = 0, size = 0;
    const auto connect_vector = [&](std::uint32_t count) {
        const auto live = first_lanes<V>(count);
        const U i = choose(live, load<U>(place), U(0u));
        const auto at = [&](const Real* column) { return gather<F>(column, i); };
        const U departed = choose(live, gather<U>(rays.departed, i), U(0u));
        const Vec3<F> p{at(rays.ox), at(rays.oy), at(rays.oz)};
        const auto normal = departed_normal<V>(context.spheres, p, departed);
        const auto random =
            random_now<V>(sobol, key, gather<U>(rays.pixel, i), gather<U>(rays.sample, i), U(context.bounce));
        const auto frame = ball_frame<V>(caustic, p);
        const auto sample = sample_caustic<V>(caustic, frame, random.y, random.z, random.w);
        const F pdf = response_pdf<V, response>(normal, sample.direction, [&]() ORRERY_INLINE_LAMBDA {
            return lobe_about<V>(context, departed & U(no_sphere), normal, {at(lobes.x), at(lobes.y), at(lobes.z)});
        });
        const F often = load<F>(probability) * F(caustic.share);
        const F weight = shared_ratio(pdf * share_of_events<V>(caustic, sample.s) / (often * sample.pdf));
        const Sphere<F> ball{{F(caustic.cx), F(caustic.cy), F(caustic.cz)}, F(caustic.radius), F(caustic.radius2)};
        const auto line = chord(p, sample.direction, ball);
        const std::uint32_t arriving = bits(live && sample.valid && !(weight <= F(0)) && min(line.disc, line.b) > F(0));
        if (arriving == 0) return;
        const Vec3<F> colour{F(caustic.r), F(caustic.g), F(caustic.b)};
        const Vec3<F> throughput{at(rays.tr), at(rays.tg), at(rays.tb)};
        size = append_shadow<V>(queue, size, p, sample.direction, (line.b + root(line.disc)) / line.c,
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

/// Where a segment goes on from a ball that it ends on.
template <class V>
struct BallEvent {
    Vec3Of<V> position, direction;
};

/// Moves the segments i.. of the queue, which end on the sphere `id`, over their event there, the first being 0. Where
/// they stay within the ball, they end on it again.
template <class V>
ORRERY_INLINE BallEvent<V> follow_event(const Sphere<Floats<V>>& ball, const Words<V>& id, const Floats<V>& eta,
                                        std::uint32_t chords, std::uint32_t event, const Shadows<V>& queue,
                                        std::uint32_t i) {
    using F = Floats<V>;
    using U = Words<V>;
    const bool inside = event > 0, leaves = event == chords;
    const bool refracts = chords > 0 && (event == 0 || leaves);
    const auto o = load3<V>(queue.ox + i, queue.oy + i, queue.oz + i);
    const auto d = load3<V>(queue.dx + i, queue.dy + i, queue.dz + i);
    const F t = F(1) / load<F>(queue.inverse_t_max + i);
    const Vec3<F> outward = unit(along(o - ball.centre, t, d));
    const Vec3<F> normal = inside ? outward * F(-1) : outward;
    const F cosine = min(max(F(0) - dot(normal, d), F(0)), F(1));
    const Vec3<F> position = along(ball.centre, ball.radius, outward);
    const Vec3<F> direction = refracts
                                  ? refracted<V>(d, normal, cosine, interface_at<V>(cosine, inside ? F(1) / eta : eta))
                                  : unit(reflected(d, normal, cosine));
    save3<V>(queue.ox + i, queue.oy + i, queue.oz + i, position);
    save3<V>(queue.dx + i, queue.dy + i, queue.dz + i, direction);
    save(queue.departed + i, leaves ? id : id | U(inside_bit));
    if (!leaves) save(queue.inverse_t_max + i, F(1) / inner_far_root(position, direction, ball));
    return {position, direction};
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
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto [position, direction] =
            follow_event<V>(ball, U(caustic.ball), F(caustic.eta), caustic.chords, event, queue, i);
        if (event < caustic.chords) continue;
        const auto line = chord(position, direction, lamp);
        const auto meets = min(line.disc, min(line.b, line.c)) > F(0);
        save(queue.inverse_t_max + i, choose(meets, (line.b + root(max(line.disc, F(0)))) / line.c, F(1)));
        const auto carried = load3<V>(queue.r + i, queue.g + i, queue.b + i);
        save3<V>(queue.r + i, queue.g + i, queue.b + i, choose(meets, carried, Vec3<F>{F(0), F(0), F(0)}));
    }
}

/// Moves every segment of the queue, which ends on a glossy ball, on to the lamp, by a direction of the ball's lobe
/// there that reaches it. Returns how many there are.
template <class V>
std::uint32_t follow_lobe(const CausticContext<RealOf<V>>& context, const Caustic<RealOf<V>>& caustic,
                          std::uint32_t count, const Shadows<V>& queue) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& slots = context.slots;
    const Sphere<F> ball{{F(caustic.cx), F(caustic.cy), F(caustic.cz)}, F(caustic.radius), F(caustic.radius2)};
    const Sphere<F> lamp = broadcast_sphere<V>(context.spheres, caustic.lamp);
    const RandomKey key{context.seed, Dimension::caustic_lobe};
    std::uint32_t size = 0;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto in_queue = first_lanes<V>(count - i);
        const auto o = load3<V>(queue.ox + i, queue.oy + i, queue.oz + i);
        const auto d = load3<V>(queue.dx + i, queue.dy + i, queue.dz + i);
        const Vec3<F> normal = unit(along(o - ball.centre, F(1) / load<F>(queue.inverse_t_max + i), d));
        const F cosine = min(max(F(0) - dot(normal, d), F(0)), F(1));
        const Vec3<F> position = along(ball.centre, ball.radius, normal);
        const U slot = choose(in_queue, load<U>(queue.slot + i), U(0u));
        const U pixel = gather<U>(slots.pixel, slot), sample = gather<U>(slots.sample, slot);
        const auto random = random_now<V>(slots.sobol.x != nullptr, key, pixel, sample, U(context.bounce));
        const auto on = sample_lobe_in_cap<V>(position, lamp, unit(reflected(d, normal, cosine)), normal, cosine,
                                              F(caustic.roughness), random.x, random.y);
        const std::uint32_t reaching = bits(in_queue && on.sample.valid && !(on.factor <= F(0)));
        if (reaching == 0) continue;
        size = append_shadow<V>(queue, size, position, on.sample.direction, on.sample.inverse_distance,
                                load3<V>(queue.r + i, queue.g + i, queue.b + i) * on.factor, U(caustic.ball), slot,
                                reaching);
    }
    return size;
}

}  // namespace orrery::kernels
