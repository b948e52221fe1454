// Fills the table of stages for one type of lanes; each file in isa/ does so once, with its own compiler flags.
#pragma once

#include "kernels/generate.hpp"
#include "kernels/roulette.hpp"
#include "kernels/shadow.hpp"
#include "kernels/sort.hpp"
#include "kernels/stages.hpp"
#include "kernels/tree_stages.hpp"
#include "kernels/twin_lanes.hpp"
#include "kernels/whitted.hpp"

namespace orrery::kernels {

/// V: one vector. W: what the stages with long chains of dependent operations work on. S: what loops over spheres do;
/// two vectors of rays and their closest hits fit AVX-512's 32 registers, not AVX2's 16.
template <class V, class W = TwinLanes<V>, class S = W>
constexpr Stages<typename V::Real> make_stages(Isa isa) {
    using enum Scattering;
    using enum LightStrategy;
    Stages<typename V::Real> s{};
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
    s.scatter[0] = scatter<W, diffuse>;
    s.scatter[1] = scatter<W, specular>;
    s.scatter[2] = scatter<W, glossy>;
    s.scatter[3] = scatter<W, dielectric>;
    s.scatter[4] = scatter<W, translucent>;
    s.connect_point[0] = connect_point<W, Response::diffuse>;
    s.connect_point[1] = connect_point<W, Response::glossy>;
    s.connect_area[0][0] = connect_area<W, Response::diffuse, area>;
    s.connect_area[0][1] = connect_area<W, Response::glossy, area>;
    s.connect_area[1][0] = connect_area<W, Response::diffuse, cone>;
    s.connect_area[1][1] = connect_area<W, Response::glossy, cone>;
    s.connect_chosen[0][0] = connect_chosen<W, Response::diffuse, area>;
    s.connect_chosen[0][1] = connect_chosen<W, Response::glossy, area>;
    s.connect_chosen[1][0] = connect_chosen<W, Response::diffuse, cone>;
    s.connect_chosen[1][1] = connect_chosen<W, Response::glossy, cone>;
    s.shadow = shadow<S>;
    s.shadow_coherent = shadow_coherent<S>;
    s.shadow_tree = shadow_tree<V>;
    s.roulette = roulette<W>;
    s.expire = expire<V>;
    s.branch = branch<V>;
    s.descend = descend<V>;
    s.resume = resume<V>;
    s.intersects = intersects_any_table<V>;
    s.is_occluded = is_occluded_any_table<V>;
    return s;
}

}  // namespace orrery::kernels
