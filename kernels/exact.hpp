// Stage `shade`, direct lighting in closed form: what diffuse vertices get of a spherical light -> radiance, without a
// ray. Vertices to which the light's visible part is more than a cap less another cap are put aside for `connect`.
//
// Seen from the vertex the light is a cap of directions. Every sphere that may stand before it is another, and so are
// the directions below the horizon. If nothing overlaps the light's cap, one of these covers it, or one takes a part of
// it away, the light's share of the hemisphere is known (form_factor.hpp).
#pragma once

#include "kernels/form_factor.hpp"
#include "kernels/packets.hpp"
#include "kernels/radiance.hpp"
#include "kernels/stages.hpp"
#include "kernels/vertex.hpp"

namespace orrery::kernels {

/// How the spheres of a table, no more than SomeSpheres::capacity, lie to a light, as bits.
template <class Real>
struct Occluders {
    std::uint64_t apart = 0;     ///< neither meets the other
    std::uint64_t around = 0;    ///< the light is within it
    std::uint64_t crossing = 0;  ///< they intersect; bits of those within the light are in none of the three
    /// Of those apart: towards the light, and how far before its centre a point is just as far from both surfaces.
    Vec3<Real> towards[SomeSpheres::capacity];
    Real middle[SomeSpheres::capacity];
};

/// In double, as radii may be large against the gaps between spheres.
template <class V>
ORRERY_INLINE void find_occluders(const Spheres<V>& spheres, std::uint32_t light, Occluders<RealOf<V>>& out) {
    using Real = RealOf<V>;
    const auto at = [&](std::uint32_t k) ORRERY_INLINE_LAMBDA {
        return Vec3<double>{spheres.cx[k], spheres.cy[k], spheres.cz[k]};
    };
    const double light_radius = spheres.radius[light];
    for (std::uint32_t k = 0; k < spheres.count; ++k) {
        if (k == light) continue;
        const std::uint64_t bit = std::uint64_t{1} << k;
        const double radius = spheres.radius[k];
        const Vec3<double> to = at(light) - at(k);
        const double distance = root(dot(to, to));
        if (distance >= radius + light_radius) {
            out.apart |= bit;
            const double inverse = 1 / distance;
            out.towards[k] = {Real(to.x * inverse), Real(to.y * inverse), Real(to.z * inverse)};
            out.middle[k] = Real((distance - radius + light_radius) / 2);
        } else if (distance + light_radius <= radius) {
            out.around |= bit;
        } else if (!(distance + radius <= light_radius)) {
            out.crossing |= bit;
        }
    }
}

/// A light as vertices see it.
template <class V>
struct LightView {
    Vec3Of<V> axis;  ///< unit length, to its centre
    Floats<V> distance;
    Floats<V> power;   ///< of the vertex: > 0 outside the light
    Floats<V> sine;    ///< of the half angle it subtends
    Floats<V> facing;  ///< cosine of axis and normal
};

/// Diffuse vertices that a light may shine on.
template <class V>
struct ShoneOn {
    Vec3Of<V> position, normal;  ///< unit length, on the side the vertex scatters into
    Words<V> id;                 ///< sphere without side
    Mask<V> inward;
};

/// `read(column)`: what the rays' column says of the vertices; of some sphere where they are dead.
template <class V, class Read>
ORRERY_INLINE ShoneOn<V> shone_on(const Spheres<V>& spheres, const Rays<V>& rays, const Mask<V>& live,
                                  const Read& read) {
    using F = Floats<V>;
    using U = Words<V>;
    const U departed = choose(live, read(rays.departed), U(0u));
    const U id = departed & U(no_sphere);
    const Vec3<F> position{read(rays.ox), read(rays.oy), read(rays.oz)};
    return {position, departed_normal<V>(spheres, position, departed), id, !words_equal(departed, id)};
}

template <class V>
ORRERY_INLINE LightView<V> view_of(const Sphere<Floats<V>>& light, const ShoneOn<V>& vertex) {
    using F = Floats<V>;
    const Vec3<F> to = light.centre - vertex.position;
    const F distance2 = dot(to, to), inverse = F(1) / root(distance2);
    const Vec3<F> axis = to * inverse;
    return {axis, distance2 * inverse, power_of_point(to, light.radius2), light.radius * inverse,
            dot(axis, vertex.normal)};
}

/// What is known of a vector of vertices, sphere by sphere.
template <class V>
struct Obstruction {
    Mask<V> covered;  ///< nothing of the light is seen
    Mask<V> unknown;  ///< more than one sphere takes a part of it away, or how much is not known
    Mask<V> partly;   ///< a sphere takes a part of it away
    Words<V> by;      ///< that sphere
};

/// Adds what sphere k does to the view of the light.
template <class V>
ORRERY_INLINE void obstruct(const Spheres<V>& spheres, const Occluders<RealOf<V>>& occluders, std::uint32_t k,
                            const LightView<V>& light, const ShoneOn<V>& vertex, Obstruction<V>& all) {
    using F = Floats<V>;
    using U = Words<V>;
    const auto sphere = broadcast_sphere<V>(spheres, k);
    const Vec3<F> to = sphere.centre - vertex.position;
    const auto own = words_equal(vertex.id, U(k));
    // The vertex scatters into it or lies inside.
    const auto within = (own && vertex.inward) || (!own && power_of_point(to, sphere.radius2) <= F(0));
    const std::uint64_t bit = std::uint64_t{1} << k;
    if ((occluders.around & bit) != 0) {
        all.covered = all.covered || !within;
        return;
    }
    // Whether its cap overlaps the light's, and holds it: along the axis and square of the distance from it. With the
    // angle g between the axes and half angles s and t, cos g > cos(s + t) and cos g >= cos(t - s), multiplied by the
    // distance, squared, and with the squares of the distance taken out of both sides, which would cancel.
    const F ahead = dot(to, light.axis);
    const Vec3<F> across = back_along(to, ahead, light.axis);
    const F apart = neg_mul_add(light.sine, light.sine, F(1)) * dot(across, across);
    const F widened = sphere.radius * light.sine, shift = ahead * light.sine, sum = sphere.radius + shift;
    auto overlaps = !own && ahead + widened > F(0) && sum * sum > apart;
    if ((occluders.crossing & bit) != 0) {
        all.unknown = all.unknown || within || overlaps;
        return;
    }
    const auto& towards = occluders.towards[k];
    const F before = light.distance * dot(light.axis, Vec3<F>{F(towards.x), F(towards.y), F(towards.z)});
    overlaps = overlaps && before > F(occluders.middle[k]);
    // Most spheres are in nobody's way.
    if (!any(within || overlaps)) return;
    const F difference = sphere.radius - shift;
    const auto holds = overlaps && min(ahead - widened, difference) > F(0) && difference * difference >= apart;
    all.covered = all.covered || within || holds;
    all.unknown = all.unknown || (overlaps && all.partly);
    all.by = choose(overlaps, U(k), all.by);
    all.partly = all.partly || overlaps;
}

/// In place of a sphere: what is below the horizon takes a part of the light away.
inline constexpr std::uint32_t horizon = no_sphere;

/// Vertices of a packet of which something takes a part of the light away.
template <class Real>
struct PartlyLit {
    WordOf<Real> place[packet_size + widest];  ///< in the ray queue
    WordOf<Real> by[packet_size + widest];     ///< sphere or horizon
    std::uint32_t count = 0;
};

/// Adds what they get.
template <class V>
ORRERY_INLINE void add_partly_lit(const ConnectContext<RealOf<V>>& context, const Sphere<Floats<V>>& source,
                                  const Vec3Of<V>& colour, const Rays<V>& rays, const PartlyLit<RealOf<V>>& list) {
    using F = Floats<V>;
    using U = Words<V>;
    const F zero(0), one(1);
    for (std::uint32_t n = 0; n < list.count; n += V::count) {
        const auto live = first_lanes<V>(list.count - n);
        const U place = choose(live, load<U>(list.place + n), U(0u));
        const auto read = [&]<class Column>(const Column* column) ORRERY_INLINE_LAMBDA {
            return gather<std::conditional_t<std::is_floating_point_v<Column>, F, U>>(column, place);
        };
        const auto vertex = shone_on<V>(context.spheres, rays, live, read);
        const auto light = view_of<V>(source, vertex);
        const U by = choose(live, load<U>(list.by + n), U(horizon));
        const auto clipped = words_equal(by, U(horizon));
        const auto sphere = gather_sphere<V>(context.spheres, choose(clipped, U(0u), by));
        const Vec3<F> to = sphere.centre - vertex.position;
        const F inverse = one / root(dot(to, to));
        const Vec3<F> axis = choose(clipped, vertex.normal * F(-1), to * inverse);
        const F tangent = root(max(power_of_point(to, sphere.radius2), zero));
        const Cap<F> whole{light.sine, root(max(light.power, zero)) / light.distance, light.facing};
        const Cap<F> hidden{choose(clipped, one, sphere.radius * inverse), choose(clipped, zero, tangent * inverse),
                            dot(axis, vertex.normal)};
        const Vec3<F> across = cross(light.axis, axis);
        const F share = form_factor_outside<V>(whole, hidden, root(dot(across, across)), dot(light.axis, axis));
        const Vec3<F> throughput{read(rays.tr), read(rays.tg), read(rays.tb)};
        add_radiance<V>(context.slots, read(rays.slot), throughput * (colour * share), live);
    }
}

/// What may stand between the light and the vertices of a packet, rays i.. of a queue.
template <class V>
ORRERY_INLINE SomeSpheres between(const Spheres<V>& spheres, const Rays<V>& rays, std::uint32_t i, std::uint32_t count,
                                  const Sphere<RealOf<V>>& light) {
    using Real = RealOf<V>;
    if (count < V::count) return every(spheres.count);
    const auto box = box_of<V, 3>({rays.ox + i, rays.oy + i, rays.oz + i}, count);
    const Vec3<Real> centre{box.middle[0], box.middle[1], box.middle[2]}, to = light.centre - centre;
    const Real distance = root(dot(to, to));
    if (!(distance > light.radius)) return every(spheres.count);
    const Real spread = box.radius(0), widening = max((light.radius - spread) / distance, Real(0));
    return candidates<V>(spheres, Packet<Real>{centre, to * (Real(1) / distance), spread, widening, distance});
}

/// Adds what the vertices of a run get of area light `light` where that is known in closed form; moves the others to
/// `aside` and returns how many they are. The table has SomeSpheres::capacity spheres at most.
template <class V>
std::uint32_t exact(const ConnectContext<RealOf<V>>& context, std::uint32_t light, Range run, const Rays<V>& rays,
                    const Rays<V>& aside) {
    using F = Floats<V>;
    using U = Words<V>;
    using Real = RealOf<V>;
    const auto& spheres = context.spheres;
    const auto& lights = context.lights;
    const auto emitter = static_cast<std::uint32_t>(lights.sphere[light]);
    const Sphere<Real> ball{{spheres.cx[emitter], spheres.cy[emitter], spheres.cz[emitter]},
                            spheres.radius[emitter],
                            spheres.radius2[emitter]};
    const Sphere<F> source = broadcast_sphere<V>(spheres, emitter);
    const Vec3<F> colour{F(lights.r[light]), F(lights.g[light]), F(lights.b[light])};
    Occluders<Real> occluders;
    find_occluders<V>(spheres, emitter, occluders);
    const std::uint64_t possible = occluders.apart | occluders.around | occluders.crossing;
    PartlyLit<Real> partly;
    std::uint32_t size = 0;
    for (std::uint32_t packet = 0; packet < run.count; packet += packet_size) {
        const std::uint32_t end = run.count - packet < packet_size ? run.count : packet + packet_size;
        // A sphere around the light hides it from all that is outside, wherever that is.
        const std::uint64_t may = between<V>(spheres, rays, run.begin + packet, end - packet, ball).bits;
        const SomeSpheres among{possible & (may | occluders.around)};
        partly.count = 0;
        for (std::uint32_t n = packet; n < end; n += V::count) {
            const std::uint32_t i = run.begin + n;
            const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i);
            const auto live = first_lanes<V>(end - n) && !carries_nothing(throughput);
            const auto read = [&]<class Column>(const Column* column) ORRERY_INLINE_LAMBDA {
                return load<std::conditional_t<std::is_floating_point_v<Column>, F, U>>(column + i);
            };
            const auto vertex = shone_on<V>(spheres, rays, live, read);
            const auto view = view_of<V>(source, vertex);
            const auto own = words_equal(vertex.id, U(emitter));
            const auto inside = live && ((own && vertex.inward) || (!own && !(view.power > F(0))));
            const auto clipped = view.facing < view.sine;
            const auto none = live && !live;
            Obstruction<V> seen{own || !live || view.facing + view.sine <= F(0), none, none, U(horizon)};
            if (!any(inside || !seen.covered)) continue;
            among.each([&](std::uint32_t k) ORRERY_INLINE_LAMBDA {
                obstruct<V>(spheres, occluders, k, view, vertex, seen);
                return false;
            });
            const auto unknown = inside || (!seen.covered && (seen.unknown || (clipped && seen.partly)));
            const auto known = !seen.covered && !unknown;
            const auto open = known && !seen.partly && !clipped;
            const F share = view.sine * view.sine * view.facing;
            if (any(open)) add_radiance<V>(context.slots, read(rays.slot), throughput * (colour * share), open);
            if (const std::uint32_t part = bits(known && (seen.partly || clipped)); part != 0) {
                compress_store<V>(partly.place + partly.count, consecutive<V>(i), part);
                compress_store<V>(partly.by + partly.count, seen.by, part);
                partly.count += static_cast<std::uint32_t>(std::popcount(part));
            }
            if (const std::uint32_t rest = bits(unknown); rest != 0) {
                move_record<V>(rays, i, aside, size, rest);
                size += static_cast<std::uint32_t>(std::popcount(rest));
            }
        }
        add_partly_lit<V>(context, source, colour, rays, partly);
    }
    return size;
}

}  // namespace orrery::kernels
