// Stage `guide`: some of the rays that leave diffuse vertices are sent to where lamps light diffuse balls brightly.
//
// A lamp close to a ball lights a small part of it, its spot, and that may be most of the light that surfaces send each
// other. Directions are drawn from a mixture of the cosine lobe and of points on such balls: from the lamp's centre a
// direction, uniform within the cone the ball subtends, and the point where it meets the ball first. Those points are
// spread as the irradiance of a small lamp. Whether anything stands between is not asked, so that their density seen
// from the vertex is known: each crossing y of the direction with the ball that faces the lamp adds
//     cos_g / (d^2 2 pi c) t^2 / cos_y,
// cos_g and cos_y being the cosines at y towards the lamp and the vertex, d and t the distances to them, and
// c = 1 - cos(half angle of the cone). The ray carries on cos / pi over the density of the mixture, 2 at most.
//
// Roulette is played as if the ray were not guided: one that goes to a bright spot carries little and brings much.
//
// What weighs such a ray against light samples (RayQueue::pdf) stays the cosine lobe's density: weights of one path
// that add up to one leave its expectation as it is, whatever they are.
#pragma once

#include "kernels/sampling.hpp"
#include "kernels/stages.hpp"
#include "kernels/vertex.hpp"

namespace orrery::kernels {

/// Of all directions from a vertex, this part at most is drawn towards spots.
inline constexpr double most_guided = 0.5;

/// What the spots are to a vector of vertices. Divisions and roots are what guiding takes its time for.
template <class F>
struct SpotWeights {
    F of[most_spots];
    F sum;    ///< of these
    F light;  ///< what they send to the vertex, about, in the unit of GuideTable::brightness
};

/// Which spots a vertex outside their balls is guided to: weights are the light that they send it, about, times the
/// square of how sharp they look from there, since the cosine lobe finds broad ones as well.
template <class V>
ORRERY_INLINE SpotWeights<Floats<V>> spot_weights(const GuideTable<RealOf<V>>& table, const Vec3Of<V>& p,
                                                  const Vec3Of<V>& normal, const Words<V>& sphere) {
    using F = Floats<V>;
    const F zero(0), one(1);
    SpotWeights<F> to;
    to.sum = to.light = zero;
    for (std::uint32_t k = 0; k < table.count; ++k) {
        // To the point of the ball nearest to the lamp, in widths of the spot.
        const Vec3<F> up{F(table.nx[k]), F(table.ny[k]), F(table.nz[k])};
        const Vec3<F> nearest{F(table.px[k]), F(table.py[k]), F(table.pz[k])};
        const Vec3<F> v = (nearest - p) * F(table.inverse_width[k]);
        const F distance2 = dot(v, v), wide = root(distance2) + one, four = distance2 + F(4);
        const F at_vertex = max(dot(v, normal) + one, zero), at_spot = max(one - dot(v, up), zero);
        const F fall = wide * wide * (distance2 + one), inverse = one / (fall * four);
        const F light = F(table.brightness[k]) * at_vertex * at_spot * (four * inverse);
        const F sharpness = distance2 * fall * inverse;
        const F weight = light * sharpness * sharpness;
        const Vec3<F> to_centre =
            (Vec3<F>{F(table.cx[k]), F(table.cy[k]), F(table.cz[k])} - p) * F(table.inverse_radius[k]);
        const auto counts =
            weight > zero && dot(to_centre, to_centre) > one && !words_equal(sphere, Words<V>(table.ball[k]));
        to.of[k] = choose(counts, weight, zero);
        to.light = to.light + choose(counts, light, zero);
    }
    // What is drawn to less often than once in two thousand times is left to the cosine lobe: it would hardly pay.
    for (std::uint32_t k = 0; k < table.count; ++k) {
        to.of[k] = choose(to.of[k] > to.light * F(0x1p-10f), to.of[k], zero);
        to.sum = to.sum + to.of[k];
    }
    return to;
}

/// A direction from p to a point of the ball of a spot.
template <class F>
struct SpotSample {
    Vec3<F> direction;
    F half;  ///< of the chord that the ball cuts out of it, in radii
};

template <class V>
ORRERY_INLINE SpotSample<Floats<V>> sample_spot(const GuideTable<RealOf<V>>& table, const Words<V>& which,
                                                const Vec3Of<V>& p, const Floats<V>& u, const Floats<V>& v) {
    using F = Floats<V>;
    const auto of = [&](const auto* column) ORRERY_INLINE_LAMBDA { return lookup<F>(column, which, table.count); };
    const F radius = of(table.radius), gap = of(table.gap), distance = radius + gap;
    const Vec3<F> nearest{of(table.px), of(table.py), of(table.pz)};
    const Vec3<F> up{of(table.nx), of(table.ny), of(table.nz)};
    const F below = u * of(table.cone), sin2 = below * (F(2) - below), cosine = F(1) - below;
    const F sine = root(max(sin2, F(0)));
    const auto aside = in_frame(up * F(-1), F(0), F(1), sincos_turns<V>(v));
    const F disc = radius * radius - distance * distance * sin2;
    const F t = gap * (radius + distance) / mul_add(distance, cosine, root(max(disc, F(0))));
    // From the point nearest to the lamp, aside and down: no digits are lost to a lamp far away.
    const F aside_by = t * sine, off_axis = aside_by * of(table.inverse_radius), off2 = off_axis * off_axis;
    const F height = root(max(F(1) - off2, F(0)));
    const Vec3<F> to_point = along(along(nearest - p, aside_by, aside), F(0) - radius * off2 / (height + F(1)), up);
    const auto direction = unit(to_point);
    return {direction, magnitude(dot(aside * off_axis + up * height, direction))};
}

/// Density, per solid angle, of `direction` from p among those to points of spot k's ball. Where the direction was
/// drawn to that very ball, half of its chord is `known`: the density has no bound at the ball's outline, where many
/// are drawn and a chord from the direction has no digits.
template <class V>
ORRERY_INLINE Floats<V> spot_pdf(const GuideTable<RealOf<V>>& table, std::uint32_t k, const Vec3Of<V>& p,
                                 const Vec3Of<V>& direction, const Mask<V>& drawn, const Floats<V>& known) {
    using F = Floats<V>;
    const F zero(0), sine(table.sine[k]), gap_share(table.gap_share[k]);
    const Vec3<F> up{F(table.nx[k]), F(table.ny[k]), F(table.nz[k])};
    // In radii of the ball: no product leaves the range of numbers.
    const Vec3<F> to = (Vec3<F>{F(table.cx[k]), F(table.cy[k]), F(table.cz[k])} - p) * F(table.inverse_radius[k]);
    const F b = dot(to, direction);
    const Vec3<F> off = back_along(to, b, direction);
    const F disc = neg_mul_add(off.x, off.x, neg_mul_add(off.y, off.y, neg_mul_add(off.z, off.z, F(1))));
    const F half = choose(drawn, known, root(max(disc, zero)));
    F sum(0);
    for (const int side : {-1, 1}) {
        const F ahead = side < 0 ? F(0) - half : half, t = b + ahead;
        const Vec3<F> normal = direction * ahead - off;
        // Over the distance of the two centres.
        const Vec3<F> to_lamp = along((up - normal) * sine, gap_share, up);
        const F facing = dot(to_lamp, normal);
        const auto counts = min(min(t, facing), half) > zero;
        if (!any(counts)) continue;
        const F distance2 = dot(to_lamp, to_lamp);
        sum = sum + choose(counts, facing * t * t / (distance2 * root(distance2) * half), zero);
    }
    return sum * F(table.scale[k]);
}

/// Redraws the directions of a run of diffuse vertices, by the random numbers that they were scattered with.
template <class V>
void guide(const GuideContext<RealOf<V>>& context, Range run, const Rays<V>& rays) {
    using Real = RealOf<V>;
    using F = Floats<V>;
    using U = Words<V>;
    const auto& table = context.guide;
    const RandomKey key{context.seed, Dimension::scattering, 0};
    const F zero(0), one(1);
    draw<V, 2>(context.slots, rays, run, key, context.bounce);
    for (std::uint32_t n = 0; n < run.count; n += V::count) {
        const std::uint32_t i = run.begin + n;
        const auto in_run = first_lanes<V>(run.count - n);
        const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i);
        const U departed = choose(in_run, load<U>(rays.departed + i), U(0u));
        const auto p = load3<V>(rays.ox + i, rays.oy + i, rays.oz + i);
        const auto normal = departed_normal<V>(context.spheres, p, departed);
        const auto weights = spot_weights<V>(table, p, normal, departed & U(no_sphere));
        const auto chosen = in_run && weights.light > zero && !carries_nothing(throughput);
        if (!any(chosen)) continue;
        const auto random = random_for<V, 2>(context.slots, rays, i, key, context.bounce);
        const F rate = F(static_cast<Real>(most_guided)) / weights.light, guided = rate * weights.sum;
        // Both choices leave a number that is uniform again.
        const F of_spots = random.x * weights.light * F(static_cast<Real>(1 / most_guided));
        F before(0), passed(0), width(1);
        U which(0u), ball(0u);
        for (std::uint32_t k = 0; k < table.count; ++k) {
            const auto reached = weights.of[k] > zero && of_spots >= before;
            which = choose(reached, U(k), which), ball = choose(reached, U(table.ball[k]), ball);
            passed = choose(reached, before, passed), width = choose(reached, weights.of[k], width);
            before = before + weights.of[k];
        }
        const auto to_spot = of_spots < weights.sum;
        const F number = choose(to_spot, of_spots - passed, random.x - guided) / choose(to_spot, width, one - guided);
        const F u = min(max(number, zero), one);
        const auto by_cosine = sample_cosine<V>(normal, u, random.y);
        const auto at_spot = sample_spot<V>(table, which, p, u, random.y);
        const auto direction = choose(to_spot, at_spot.direction, by_cosine.direction);
        const F cosine = choose(to_spot, dot(direction, normal), by_cosine.cosine);
        F density(0);
        for (std::uint32_t k = 0; k < table.count; ++k) {
            const auto counts = weights.of[k] > zero;
            if (!any(counts)) continue;
            const auto drawn = to_spot && words_equal(ball, U(table.ball[k]));
            const F pdf = spot_pdf<V>(table, k, p, direction, drawn, at_spot.half);
            density = density + choose(counts, weights.of[k] * pdf, zero);
        }
        // Both over the cosine lobe's, all but the cosine.
        const F spread = F(static_cast<Real>(std::numbers::pi)) * rate * density;
        const F factor = choose(cosine > zero, cosine / mul_add(one - guided, cosine, spread), zero);
        save3<V>(rays.dx + i, rays.dy + i, rays.dz + i,
                 choose(chosen, direction, load3<V>(rays.dx + i, rays.dy + i, rays.dz + i)));
        save3<V>(rays.tr + i, rays.tg + i, rays.tb + i, choose(chosen, throughput * factor, throughput));
        if (rays.roulette_scale != nullptr) {
            const F scale = load<F>(rays.roulette_scale + i);
            save(rays.roulette_scale + i, choose(chosen && factor > zero, scale * factor, scale));
        }
        if (rays.pdf != nullptr && context.competing_pdf)
            save(rays.pdf + i,
                 choose(chosen, max(cosine, zero) * F(static_cast<Real>(std::numbers::inv_pi)), load<F>(rays.pdf + i)));
    }
}

}  // namespace orrery::kernels
