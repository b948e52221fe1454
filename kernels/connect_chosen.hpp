// Stage `shade`, last step, where a vertex samples one of several lights: the vertices of a run, each towards the light
// that its random number chooses -> shadow queue.
#pragma once

#include "kernels/connect.hpp"

namespace orrery::kernels {

/// The light that the numbers z and w in [0, 1) choose. Exact: the cell is the top bits of z, and w is compared with a
/// multiple of its last place.
template <class V>
ORRERY_INLINE typename V::U choose_light(const LightTable<typename V::Real>& lights, const typename V::F& z,
                                         const typename V::F& w) {
    using F = typename V::F;
    using U = typename V::U;
    const U cell = truncate_to_word(z * F(static_cast<typename V::Real>(lights.cells)));
    const auto own = w < lookup<F>(lights.share, cell, lights.cells);
    return choose(own, cell, lookup<U>(lights.other, cell, lights.cells));
}

template <class V>
struct ChosenArrival : Arrival<V> {
    typename V::U light;
};

/// Light samples from the chosen light, as PointSampler and AreaSampler take them, over the probability of the choice.
template <class V, Response response, LightStrategy strategy>
struct ChosenSampler {
    static constexpr bool has_targets = true;
    const ConnectContext<typename V::Real>& context;
    const LightTable<typename V::Real>& lights;
    const LobeQueue<typename V::Real>& lobes;

    ORRERY_INLINE ChosenArrival<V> operator()(const RayQueue<typename V::Real>& rays,
                                              const LitVertex<V>& vertex) const {
        using F = typename V::F;
        using U = typename V::U;
        const RandomKey key{context.seed, Dimension::light, 0};
        const auto random = random_for<V, 4>(context.slots, rays, vertex.i, key, context.bounce, vertex.slot);
        const U light = choose_light<V>(lights, random.z, random.w);
        const auto centre = lookup3<V>(lights.px, lights.py, lights.pz, light, lights.count);
        const F radius = lookup<F>(lights.radius, light, lights.count);

        const Vec3<F> to = centre - vertex.position;
        const F distance2 = dot(to, to);
        const F inverse_distance = F(1) / root(distance2);
        LightSample<V> sample{to * inverse_distance, inverse_distance, inverse_distance * inverse_distance,
                              distance2 > F(0)};
        const auto has_area = radius > F(0);
        if (any(has_area)) {
            LightSample<V> on;
            sample_sphere<V, strategy>(vertex, {centre, radius, radius * radius},
                                       lookup<U>(lights.sphere, light, lights.count), random, on);
            sample.direction = choose(has_area, on.direction, sample.direction);
            sample.inverse_distance = choose(has_area, on.inverse_distance, sample.inverse_distance);
            sample.inverse_pdf = choose(has_area, on.inverse_pdf, sample.inverse_pdf);
            sample.valid = (has_area && on.valid) || (!has_area && sample.valid);
        }
        const F pdf =
            response_pdf<V, response>(context, lobes, vertex.i, vertex.sphere, vertex.normal, sample.direction);
        F ratio = pdf * sample.inverse_pdf * lookup<F>(lights.inverse_probability, light, lights.count);
        if (context.competing) ratio = choose(has_area, shared_ratio(ratio), ratio);
        return {{sample.direction, sample.inverse_distance, ratio, sample.valid && !(ratio <= F(0))}, light};
    }
    ORRERY_INLINE Vec3<typename V::F> colour(const ChosenArrival<V>& of) const {
        return lookup3<V>(lights.r, lights.g, lights.b, of.light, lights.count);
    }
    ORRERY_INLINE typename V::U target(const ChosenArrival<V>& of) const {
        return lookup<typename V::U>(lights.sphere, of.light, lights.count);
    }
};

template <class V, Response response, LightStrategy strategy>
std::uint32_t connect_chosen(const ConnectContext<typename V::Real>& context,
                             const LightTable<typename V::Real>& lights, Range run,
                             const RayQueue<typename V::Real>& rays, const LobeQueue<typename V::Real>& lobes,
                             const ShadowQueue<typename V::Real>& queue) {
    draw<V, 4>(context.slots, rays, run, {context.seed, Dimension::light, 0}, context.bounce);
    return connect_run<V>(context, run, rays, ChosenSampler<V, response, strategy>{context, lights, lobes}, queue);
}

}  // namespace orrery::kernels
