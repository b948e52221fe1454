// Fills the table of stages for one type of lanes; each file in isa/ does so once, with its own compiler flags.
#pragma once

#include "kernels/generate.hpp"
#include "kernels/roulette.hpp"
#include "kernels/shadow.hpp"
#include "kernels/sort.hpp"
#include "kernels/stages.hpp"
#include "kernels/tree_stages.hpp"
#include "kernels/whitted.hpp"

namespace orrery::kernels {

template <class V>
constexpr Stages<typename V::Real> make_stages(Isa isa) {
    using enum Scattering;
    using enum LightStrategy;
    Stages<typename V::Real> s{};
    s.isa = isa;
    s.lanes = V::count;
    s.generate_pinhole = generate<V, false>;
    s.generate_lens = generate<V, true>;
    s.intersect = intersect<V>;
    s.intersect_tree = intersect_tree<V>;
    s.emission = emission<V>;
    s.sort_by_scattering = sort_by_scattering<V>;
    s.scatter[0] = scatter<V, diffuse>;
    s.scatter[1] = scatter<V, specular>;
    s.scatter[2] = scatter<V, glossy>;
    s.scatter[3] = scatter<V, dielectric>;
    s.scatter[4] = scatter<V, translucent>;
    s.connect_point[0] = connect_point<V, Response::diffuse>;
    s.connect_point[1] = connect_point<V, Response::glossy>;
    s.connect_area[0][0] = connect_area<V, Response::diffuse, area>;
    s.connect_area[0][1] = connect_area<V, Response::glossy, area>;
    s.connect_area[1][0] = connect_area<V, Response::diffuse, cone>;
    s.connect_area[1][1] = connect_area<V, Response::glossy, cone>;
    s.shadow = shadow<V>;
    s.shadow_tree = shadow_tree<V>;
    s.roulette = roulette<V>;
    s.expire = expire<V>;
    s.branch = branch<V>;
    s.descend = descend<V>;
    s.resume = resume<V>;
    s.intersects = intersects_any_table<V>;
    s.is_occluded = is_occluded_any_table<V>;
    return s;
}

}  // namespace orrery::kernels
