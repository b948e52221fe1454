// Fills the table of stages for one type of lanes; each file in isa/ does so once, with its own compiler flags.
#pragma once

#include <utility>

#include "kernels/caustic_connect.hpp"
#include "kernels/caustic_emission.hpp"
#include "kernels/caustic_point_connect.hpp"
#include "kernels/connect.hpp"
#include "kernels/emission.hpp"
#include "kernels/exact.hpp"
#include "kernels/generate.hpp"
#include "kernels/guide.hpp"
#include "kernels/roulette.hpp"
#include "kernels/segment.hpp"
#include "kernels/sort.hpp"
#include "kernels/whitted.hpp"

namespace orrery::kernels {

/// V: one vector. W: what the stages with long chains of dependent operations work on. S: what loops over spheres do;
/// two vectors of rays and their closest hits fit AVX-512's 32 registers, not AVX2's 16 (SSE2 takes two all the same).
template <class V, class W = TwinLanes<V>, class S = W>
constexpr Stages<RealOf<V>> make_stages(Isa isa) {
    Stages<RealOf<V>> s{};
    s.isa = isa;
    s.lanes = V::count;
    s.step = W::count;
    s.sphere_step = S::count;
    s.generate_pinhole = generate<W, false>;
    s.generate_lens = generate<W, true>;
    s.intersect = intersect<S>;
    s.intersect_coherent = intersect_coherent<S>;
    s.intersect_tree = intersect_tree<V>;
    s.emission = emission<W>;
    s.sort_by_scattering = sort_by_scattering<V>;
    [&]<std::uint32_t... k>(std::integer_sequence<std::uint32_t, k...>) {
        ((s.scatter[k] = scatter<W, static_cast<Scattering>(k)>), ...);
    }
    (std::make_integer_sequence<std::uint32_t, scattering_count>{});
    s.connect[0] = connect<W, Response::diffuse>;
    s.connect[1] = connect<W, Response::glossy>;
    s.exact = exact<S>;
    s.shadow = shadow<S>;
    s.shadow_coherent = shadow_coherent<S>;
    s.shadow_tree = shadow_tree<V>;
    s.caustic_emission = caustic_emission<V>;
    s.weigh_shadows = weigh_shadows<V>;
    s.pick_caustics[0] = pick_caustics<V, Response::diffuse>;
    s.pick_caustics[1] = pick_caustics<V, Response::glossy>;
    s.connect_caustic[0] = connect_caustic<V, Response::diffuse>;
    s.connect_caustic[1] = connect_caustic<V, Response::glossy>;
    s.unblocked = unblocked<S>;
    s.unblocked_coherent = unblocked_coherent<S>;
    s.unblocked_tree = unblocked_tree<V>;
    s.pick_point_caustics[0] = pick_point_caustics<W, Response::diffuse>;
    s.pick_point_caustics[1] = pick_point_caustics<W, Response::glossy>;
    s.connect_point_caustic[0] = connect_point_caustic<W, Response::diffuse>;
    s.connect_point_caustic[1] = connect_point_caustic<W, Response::glossy>;
    s.follow_point_caustic = follow_point_caustic<W>;
    s.follow_caustic = follow_caustic<W>;
    s.follow_lobe = follow_lobe<W>;
    s.guide = guide<V>;
    s.roulette = roulette<W>;
    s.expire = expire<V>;
    s.branch = branch<V>;
    s.resume = resume<V>;
    s.intersects = intersects_columns<V>;
    s.is_occluded = is_occluded_columns<V>;
    return s;
}

}  // namespace orrery::kernels
