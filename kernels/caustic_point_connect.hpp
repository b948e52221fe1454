// Stage `caustic` towards point lights: the vertices of a run -> shadow queue, which then walks over the ball.
//
// A vertex that asks, asks one ball, chosen at random by what may come of it. A point can only be reached by the few
// directions that lead there exactly: all of them are found, so that the vertex receives what a lamp so small would
// send, over the probability of having asked that ball. Nothing else finds that light.
#pragma once

#include "kernels/caustic_connect.hpp"
#include "kernels/caustic_point.hpp"

namespace orrery::kernels {

/// What a point sends over the spheres within `reach` of `centre`, about, in no unit: in proportion to the solid angle
/// that they take and to the height of the highest above the horizon. 0 only where all are below it.
template <class V>
ORRERY_INLINE Floats<V> promise(const Vec3Of<V>& p, const Vec3Of<V>& normal, const Vec3Of<V>& centre,
                                const Floats<V>& reach, const Floats<V>& area) {
    using F = Floats<V>;
    const Vec3<F> to = centre - p;
    const F distance2 = max(dot(to, to), reach * reach);
    const F height = max(dot(to, normal) + reach, F(0));
    return area * height / (distance2 * root(distance2));
}

/// One of the balls for each vertex: its sphere, and how probable the choice and the asking of it are, 0 where it has
/// nothing to send.
template <class V>
struct AskedBall {
    Words<V> sphere;
    Floats<V> chosen, asked;
};

/// `number(k)` is the vertex's k-th random number. Probabilities end at least_share, far above the step of such
/// numbers: what is improbable must not come out more often than that.
template <class V, class Number>
ORRERY_INLINE AskedBall<V> choose_ball(const SpheresOverPoints<RealOf<V>>& of, const Floats<V>& rate,
                                       const Vec3Of<V>& p, const Vec3Of<V>& normal, const Number& number) {
    using F = Floats<V>;
    using U = Words<V>;
    constexpr RealOf<V> least_share = RealOf<V>(0x1p-8);
    const std::uint32_t nodes = 2u << of.levels;
    const auto promise_of = [&](const U& node) ORRERY_INLINE_LAMBDA {
        return promise<V>(p, normal, lookup3<V>(of.cx, of.cy, of.cz, node, nodes), lookup<F>(of.reach, node, nodes),
                          lookup<F>(of.area, node, nodes));
    };
    U node(1u);
    F chosen(1);
    for (std::uint32_t level = 0; level < of.levels; ++level) {
        const U left = node + node, right = left + U(1u);
        const F of_left = promise_of(left), of_right = promise_of(right), sum = of_left + of_right;
        const F share = min(max(of_left / sum, F(least_share)), F(1 - least_share));
        const F left_share = choose(min(of_left, of_right) > F(0), share, choose(of_left > F(0), F(1), F(0)));
        const auto takes_left = number(level) < left_share;
        node = choose(takes_left, left, right);
        chosen = chosen * choose(takes_left, left_share, F(1) - left_share);
    }
    const U sphere = lookup<U>(of.sphere, node - U(1u << of.levels), 1u << of.levels);
    const F sends = promise_of(node);
    const F asked = max(min(rate * sends / chosen, F(1)), F(least_share));
    return {sphere, chosen, choose(sends > F(0), asked, F(0))};
}

/// Chooses the vertices of a run that ask a ball, and which. Returns how many.
template <class V, Response response>
std::uint32_t pick_point_caustics(const CausticContext<RealOf<V>>& context, Range run, const Rays<V>& rays,
                                  const Picks<V>& picks) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& spheres = context.spheres;
    const auto& balls = context.caustics.over_points;
    const F rate(balls.rate * rough_scale<response>(caustic_scale(context.caustics, context.bounce)));
    const bool sobol = context.slots.sobol.x != nullptr;
    std::uint32_t picked = 0;
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto live =
            first_lanes<V>(run.count - n) && !carries_nothing(load3<V>(rays.tr + i, rays.tg + i, rays.tb + i));
        if (!any(live)) continue;
        const auto p = load3<V>(rays.ox + i, rays.oy + i, rays.oz + i);
        const auto normal = departed_normal<V>(spheres, p, choose(live, load<U>(rays.departed + i), U(0u)));
        RandomNumbers<F> block{};
        const auto number = [&](std::uint32_t k) ORRERY_INLINE_LAMBDA {
            if (k % 4 == 0) {
                const RandomKey key{context.seed, Dimension::point_caustic, k / 4};
                block = random_now<V>(sobol, key, load<U>(rays.pixel + i), load<U>(rays.sample + i), U(context.bounce));
            }
            return k % 4 == 0 ? block.x : k % 4 == 1 ? block.y : k % 4 == 2 ? block.z : block.w;
        };
        const auto ball = choose_ball<V>(balls, rate, p, normal, number);
        const auto apart = p - lookup3<V>(spheres.cx, spheres.cy, spheres.cz, ball.sphere, spheres.count);
        const auto outside = power_of_point(apart, lookup<F>(spheres.radius2, ball.sphere, spheres.count)) > F(0);
        const std::uint32_t chosen = bits(live && outside && number(balls.levels) < ball.asked);
        if (chosen == 0) continue;
        compress_store<V>(picks.place + picked, consecutive<V>(i), chosen);
        compress_store<V>(picks.caustic + picked, ball.sphere, chosen);
        compress_store<V>(picks.probability + picked, ball.chosen * ball.asked, chosen);
        picked += static_cast<std::uint32_t>(std::popcount(chosen));
    }
    return picked;
}

/// Calls append(lanes that have one, direction, one over the distance to the ball, cosine of incidence there, solid
/// angle per area at the point) for every path from p to the point by so many chords within the ball.
template <class V, class Append>
ORRERY_INLINE void paths_over_ball(const Sphere<Floats<V>>& ball, const Floats<V>& eta, std::uint32_t chords,
                                   const Vec3Of<V>& p, const Vec3Of<V>& point, const Mask<V>& among,
                                   const Append& append) {
    using F = Floats<V>;
    using Real = RealOf<V>;
    const Vec3<F> to = ball.centre - p, w = point - ball.centre;
    const F inverse = F(1) / root(dot(to, to)), distance = dot(to, to) * inverse;
    const F e2 = dot(w, w), inverse_e = F(1) / root(e2);
    const Vec3<F> axis = to * inverse;
    const F on_axis = dot(w, axis);
    // Twice, as what rounding leaves along the axis may be much of what is left.
    const Vec3<F> once = back_along(w, on_axis, axis), off = back_along(once, dot(once, axis), axis);
    // On the axis all azimuths are alike.
    const F across = root(dot(off, off)), least = F(4 * std::numeric_limits<Real>::epsilon()) * e2 * inverse_e;
    const Vec3<F> towards = choose(across > least, off * (F(1) / across), basis_around(axis).s);
    const F power = power_of_point(to, ball.radius2), point_power = power_of_point(w, ball.radius2);
    const auto outside = among && min(power, point_power) > F(0);
    if (!any(outside)) return;

    const F bends = chords > 0 ? eta : F(1);
    const auto dense = bends >= F(1);
    const F c = min(bends, F(1)), other = choose(dense, F(1) / bends, bends);
    const F rest = (F(1) - c) * (F(1) + c);
    const F a = ball.radius * inverse, b = ball.radius * inverse_e;
    const PointPaths<V> paths{chords,
                              dense,
                              {other, (F(1) - other) * (F(1) + other)},
                              {a * c, mul_add(a * a, rest, power * inverse * inverse)},
                              {b * c, mul_add(b * b, rest, point_power * inverse_e * inverse_e)},
                              {max(across, least) * inverse_e, F(0) - on_axis * inverse_e}};
    each_point_path<V>(
        paths, outside, [&](const Mask<V>& some, int side, const PointPath<V>& path) ORRERY_INLINE_LAMBDA {
            const F aside = side < 0 ? F(0) - path.from_axis.sin : path.from_axis.sin;
            const Vec3<F> direction = unit(along(axis * path.from_axis.cos, aside, towards));
            const F to_ball = mul_add(distance, path.from_axis.cos, ball.radius * path.incidence) / power;
            append(some, direction, to_ball, path.incidence, path.spread * inverse_e * inverse_e);
        });
}

/// What a shadow ray's or a vertex's light is, where vertices choose theirs: what `connect` draws for the same vertex.
template <class V>
ORRERY_INLINE Words<V> chosen_again(const CausticContext<RealOf<V>>& context, const Words<V>& pixel,
                                    const Words<V>& sample) {
    const auto random = random_now<V>(context.slots.sobol.x != nullptr, RandomKey{context.seed, Dimension::light, 0},
                                      pixel, sample, Words<V>(context.bounce));
    return choose_light<V>(context.lights, random.z, random.w);
}

/// Finds the paths of picked vertices over their balls, by so many chords. Returns the number of shadow rays,
/// 2 chords + 1 per vertex at most: first segments, which end on the queue's target, with the radiance that arrives if
/// nothing blocks what follows. `light` as in `connect`.
template <class V, Response response>
std::uint32_t connect_point_caustic(const CausticContext<RealOf<V>>& context, std::uint32_t chords, std::uint32_t light,
                                    Range picked, const Rays<V>& rays, const Lobes<V>& lobes, const Picks<V>& picks,
                                    const Shadows<V>& queue) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& spheres = context.spheres;
    const auto& materials = context.materials;
    const auto& lights = context.lights;
    std::uint32_t size = 0;
    for (std::uint32_t n = 0; n < picked.count; n += V::count) {
        const std::uint32_t k = picked.begin + n;
        auto live = first_lanes<V>(picked.count - n);
        const U i = choose(live, load<U>(picks.place + k), U(0u)),
                ball = choose(live, load<U>(picks.caustic + k), U(0u));
        const auto at = [&](const auto* column) { return gather<F>(column, i); };
        const U departed = choose(live, gather<U>(rays.departed, i), U(0u));
        const Vec3<F> p{at(rays.ox), at(rays.oy), at(rays.oz)};
        const auto normal = departed_normal<V>(spheres, p, departed);

        const U surface = lookup<U>(spheres.surface, ball, spheres.count),
                material = surface & U(surface_material_mask);
        const auto mirror = words_equal(surface >> surface_material_bits & U(surface_kind_mask),
                                        U(static_cast<std::uint32_t>(Scattering::specular)));
        if (chords > 0) live = live && !mirror;
        U chosen(light);
        F weight = F(1) / load<F>(picks.probability + k);
        if (light == chosen_light) {
            chosen = chosen_again<V>(context, gather<U>(rays.pixel, i), gather<U>(rays.sample, i));
            live = live && lookup<F>(lights.radius, chosen, lights.count) <= F(0);
            weight = weight * lookup<F>(lights.inverse_probability, chosen, lights.count);
        }
        if (!any(live)) continue;
        const F eta = lookup<F>(materials.eta, material, materials.count);
        Vec3<F> carried = Vec3<F>{at(rays.tr), at(rays.tg), at(rays.tb)} *
                          lookup3<V>(lights.r, lights.g, lights.b, chosen, lights.count) * weight;
        if (chords != 1)
            carried =
                carried * lookup3<V>(materials.rho_r, materials.rho_g, materials.rho_b, material, materials.count);
        if (chords > 0) {
            const auto tau = lookup3<V>(materials.tau_r, materials.tau_g, materials.tau_b, material, materials.count);
            carried = carried * (tau * tau);
        }
        paths_over_ball<V>(gather_sphere<V>(spheres, ball), eta, chords, p,
                           lookup3<V>(lights.px, lights.py, lights.pz, chosen, lights.count), live,
                           [&](const Mask<V>& some, const Vec3<F>& direction, const F& inverse_t, const F& incidence,
                               const F& spread) ORRERY_INLINE_LAMBDA {
                               const F pdf = response_pdf<V, response>(normal, direction, [&]() ORRERY_INLINE_LAMBDA {
                                   return lobe_about<V>(context, departed & U(no_sphere), normal,
                                                        {at(lobes.x), at(lobes.y), at(lobes.z)});
                               });
                               F share = share_of_events<V>(chords, eta, incidence);
                               if (chords == 0) share = choose(mirror, F(1), share);
                               const F factor = pdf * share * spread;
                               // On a fold it is infinite, for no more vertices than a line has.
                               const std::uint32_t arriving =
                                   bits(some && factor > F(0) && factor < F(std::numeric_limits<RealOf<V>>::max()));
                               if (arriving == 0) return;
                               compress_store<V>(queue.target + size, ball, arriving);
                               size = append_shadow<V>(queue, size, p, direction, inverse_t, carried * factor, departed,
                                                       gather<U>(rays.slot, i), arriving);
                           });
    }
    return size;
}

/// As follow_caustic, over the segments' own targets; after the last event to their light.
template <class V>
void follow_point_caustic(const CausticContext<RealOf<V>>& context, std::uint32_t chords, std::uint32_t light,
                          std::uint32_t event, const Shadows<V>& queue, std::uint32_t count) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto& spheres = context.spheres;
    const auto& lights = context.lights;
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto live = first_lanes<V>(count - i);
        const U ball = choose(live, load<U>(queue.target + i), U(0u));
        const U material = lookup<U>(spheres.surface, ball, spheres.count) & U(surface_material_mask);
        const F eta = lookup<F>(context.materials.eta, material, context.materials.count);
        const auto at = follow_event<V>(gather_sphere<V>(spheres, ball), ball, eta, chords, event, queue, i);
        if (event < chords) continue;
        U which(light);
        if (light == chosen_light) {
            const U slot = choose(live, load<U>(queue.slot + i), U(0u));
            const U sample = gather<U>(context.slots.sample, slot);
            which = chosen_again<V>(context, gather<U>(context.slots.pixel, slot),
                                    context.slots.sobol.x != nullptr ? reversed_bits(sample) : sample);
        }
        const auto to = sample_point<V>(at.position, lookup3<V>(lights.px, lights.py, lights.pz, which, lights.count));
        save3<V>(queue.dx + i, queue.dy + i, queue.dz + i, to.direction);
        save(queue.inverse_t_max + i, to.inverse_distance);
        save(queue.target + i, U(no_sphere));
    }
}

}  // namespace orrery::kernels
