// Stage `shade`, second step: hits into one run per way of scattering, misses and dead rays left behind.
//
// A stable counting sort. Records move by compress in register, which costs two operations per field and kind present
// in a vector; sorting indices and gathering the records later costs a gather per field, five times that.
#pragma once

#include "kernels/lanes/compress.hpp"
#include "kernels/queues.hpp"

namespace orrery::kernels {

/// Lanes that hit something and carry anything, and the surface word of what they hit (0 elsewhere).
template <class V>
struct LiveHits {
    Mask<V> live;
    Mask<V> met;  ///< hit something, dead or alive
    Words<V> surface;
};

template <class V>
ORRERY_INLINE LiveHits<V> live_hits(const Spheres<V>& spheres, const Rays<V>& rays, const Hits<V>& hits,
                                    std::uint32_t i, std::uint32_t count) {
    using U = Words<V>;
    const U hit = load<U>(hits.id + i);
    const auto met = first_lanes<V>(count - i) && !words_equal(hit, U(no_sphere));
    const auto live = met && !carries_nothing(load3<V>(rays.tr + i, rays.tg + i, rays.tb + i));
    return {live, met, lookup<U>(spheres.surface, choose(live, hit & U(no_sphere), U(0u)), spheres.count)};
}

template <class V>
ORRERY_INLINE std::uint32_t lanes_of_kind(const LiveHits<V>& hits, std::uint32_t kind) {
    using U = Words<V>;
    const U of = (hits.surface >> surface_material_bits) & U(surface_kind_mask);
    return bits(hits.live && words_equal(of, U(kind)));
}

/// Where nothing but one kind was hit, sorting would copy the queue: unless more than an eighth of it is misses, moving
/// the rest costs more than to drag them along.
ORRERY_INLINE bool is_sorted(const Runs& runs, std::uint32_t count) {
    std::uint32_t present = 0, hits = 0;
    for (const Range& run : runs.run) {
        present += run.count != 0 ? 1u : 0u;
        hits += run.count;
    }
    return present == 0 || (present == 1 && hits >= count - count / 8);
}

/// Where nothing moved the queues are one run as they are, misses among it, as in a scene that has one way of
/// scattering only. `kinds` has bit k set where the plan knows kind k; no other is looked for.
template <class V>
Runs sort_by_scattering(const Spheres<V>& spheres, std::uint32_t kinds, const Rays<V>& rays, const Hits<V>& hits,
                        std::uint32_t count, const Rays<V>& sorted_rays, const Hits<V>& sorted_hits) {
    Runs runs;
    std::uint32_t dead = 0;  // they may have hit anything, also what no kernel of the run knows
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto hit = live_hits<V>(spheres, rays, hits, i, count);
        dead |= bits(hit.met) ^ bits(hit.live);
        for (std::uint32_t rest = kinds; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
            runs.run[k].count += static_cast<std::uint32_t>(std::popcount(lanes_of_kind(hit, k)));
        }
    }
    if (dead == 0 && is_sorted(runs, count)) {
        for (Range& run : runs.run)
            if (run.count != 0) run = {0, count};
        return runs;
    }
    runs.moved = true;
    std::uint32_t to[scattering_count];
    std::uint32_t end = 0;
    for (std::uint32_t k = 0; k < scattering_count; ++k) {
        to[k] = runs.run[k].begin = end;
        end += padded_run(runs.run[k].count);
    }
    for (std::uint32_t i = 0; i < count; i += V::count) {
        const auto hit = live_hits<V>(spheres, rays, hits, i, count);
        for (std::uint32_t rest = kinds; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::uint32_t>(std::countr_zero(rest));
            const std::uint32_t chosen = lanes_of_kind(hit, k);
            if (chosen == 0) continue;
            move_record<V>(rays, i, sorted_rays, to[k], chosen);
            move_record<V>(hits, i, sorted_hits, to[k], chosen);
            to[k] += static_cast<std::uint32_t>(std::popcount(chosen));
        }
    }
    return runs;
}

}  // namespace orrery::kernels
