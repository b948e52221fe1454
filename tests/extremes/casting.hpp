// The kernels' two questions about a ray, asked one ray at a time of every kind of arithmetic.
#pragma once

#include "dice.hpp"
#include "modes.hpp"

namespace orrery::extremes {

template <class Real>
struct Ray {
    kernels::Vec3<Real> origin, direction;
    Real t_min = 0;
    Real t_max = std::numeric_limits<Real>::infinity();
    std::uint32_t left = kernels::no_sphere;  ///< with inside_bit; only where t_min is 0
};

template <class Real>
struct Hit {
    Real t;
    std::uint32_t id;  ///< with inside_bit; no_sphere where nothing was hit

    bool any() const { return id != kernels::no_sphere; }
    bool inside() const { return any() && (id & kernels::inside_bit) != 0; }
    std::uint32_t sphere() const { return id & kernels::no_sphere; }
};

/// Start: kernels::FromOrigin for the wavefront's rays, which begin at their origins; Real for segments.
template <class V, class Start>
auto start_of(typename V::Real t_min) {
    if constexpr (std::is_same_v<Start, kernels::FromOrigin>) {
        return kernels::FromOrigin{};
    } else {
        return typename V::F(t_min);
    }
}

template <class V, class Start>
Hit<typename V::Real> cast(const kernels::SphereTable<typename V::Real>& spheres, const Ray<typename V::Real>& ray) {
    using F = typename V::F;
    using U = typename V::U;
    using Word = typename V::Word;
    const auto best = kernels::closest_hit<V>(spheres, kernels::AllSpheres{spheres.count}, broadcast<V>(ray.origin),
                                              broadcast<V>(ray.direction), U(Word{ray.left}),
                                              start_of<V, Start>(ray.t_min), F(ray.t_max));
    return {first_lane(F(best.num / best.den)), static_cast<std::uint32_t>(first_lane(best.id))};
}

template <class V, class Start>
bool occluded(const kernels::SphereTable<typename V::Real>& spheres, const Ray<typename V::Real>& ray) {
    using F = typename V::F;
    using U = typename V::U;
    using Word = typename V::Word;
    using kernels::any;
    return any(kernels::any_hit<V>(spheres, kernels::AllSpheres{spheres.count}, broadcast<V>(ray.origin),
                                   broadcast<V>(ray.direction), U(Word{ray.left}), start_of<V, Start>(ray.t_min),
                                   F(1) / F(ray.t_max), kernels::no_sphere, typename V::M(true)));
}

}  // namespace orrery::extremes
