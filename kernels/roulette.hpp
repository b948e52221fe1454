// Stage `roulette`: kill, weigh, compact the survivors to the front.
#pragma once

#include "kernels/lanes/compress.hpp"
#include "kernels/vertex.hpp"

namespace orrery::kernels {

/// Compacts the runs of `rays`, in order, to its front and returns how many rays survive. Dead rays (no throughput) go
/// always; with `play`, a ray survives with probability q = min(1, max component of its throughput over
/// RayQueue::roulette_scale) and is divided by q. In place: a survivor never moves back.
template <class V>
std::uint32_t roulette(const Slots<V>& slots, std::uint32_t seed, std::uint32_t bounce, bool play, const Runs& runs,
                       const Rays<V>& rays) {
    using F = Floats<V>;
    const RandomKey key{seed, Dimension::roulette, 0};
    std::uint32_t size = 0;
    for (const Range& run : runs.run) {
        if (play) draw<V, 1>(slots, rays, run, key, bounce);
        for (std::uint32_t n = 0; n < run.count; n += V::count) {
            const std::uint32_t i = run.begin + n;
            const auto in_run = first_lanes<V>(run.count - n);
            const auto throughput = load3<V>(rays.tr + i, rays.tg + i, rays.tb + i);
            const F carried = max(throughput.x, max(throughput.y, throughput.z));
            auto alive = in_run && !carries_nothing(throughput);
            if (play && any(alive)) {
                const F scale = rays.roulette_scale != nullptr ? load<F>(rays.roulette_scale + i) : F(1);
                const F q = min(carried / scale, F(1));
                const F u = random_for<V, 1>(slots, rays, i, key, bounce).x;
                // What is no number lives on, whichever channel it is in.
                const F sum = throughput.x + throughput.y + throughput.z;
                alive = alive && (u < q || !(sum == sum));
                save3<V>(rays.tr + i, rays.tg + i, rays.tb + i, throughput * (F(1) / q));
            }
            const std::uint32_t chosen = bits(alive);
            if (chosen == 0) continue;
            move_record<V>(rays, i, rays, size, chosen);
            size += static_cast<std::uint32_t>(std::popcount(chosen));
        }
    }
    return size;
}

}  // namespace orrery::kernels
