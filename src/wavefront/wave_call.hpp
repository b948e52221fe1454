// How the steps of a wave make their calls.
#pragma once

#include <algorithm>

#include "wavefront/wave.hpp"

namespace orrery {

/// Bytes of a record of the queue, absent fields left out.
template <class Queue>
std::uint32_t record_bytes(const Queue& queue) {
    std::size_t sum = 0;
    Queue::each_field([&](const char*, auto field) { sum += queue.*field != nullptr ? sizeof(*(queue.*field)) : 0; });
    return static_cast<std::uint32_t>(sum);
}

/// Bytes of so many numbers or words.
template <class Real>
constexpr std::uint32_t words(std::uint32_t n) {
    return n * static_cast<std::uint32_t>(sizeof(Real));
}

inline kernels::Runs only(const kernels::Range& run) {
    kernels::Runs runs;
    runs.run[0] = run;
    return runs;
}

/// What builds the context of a stage of caustics on some queues; it outlives the wave. `lights`: a member of the
/// plan's tables.
template <class Real>
auto caustics_on(const Wave<Real>& w, std::uint32_t bounce, const kernels::LightTable<Real>& lights) {
    return [&tables = w.tables, &lights, seed = w.plan.settings().seed, bounce](const WaveStorage<Real>& q) {
        return kernels::CausticContext<Real>{tables.spheres, tables.materials, lights, q.slots, tables.caustics, seed,
                                             bounce};
    };
}
template <class Real>
auto caustics_on(const Wave<Real>& w, std::uint32_t bounce) {
    return caustics_on(w, bounce, w.tables.lights(true));
}

template <class Real>
template <class Make>
kernels::Runs Wave<Real>::call(const StageCall& what, const Make& make) {
    const std::size_t bounce = std::min<std::size_t>(what.bounce, profile_bounces - 1);
    StageTicks& to = counters.ticks[bounce][static_cast<std::size_t>(what.stage.counted)];
    const std::uint32_t rays = what.records.count;
    const std::uint64_t start = tick_count();
    const kernels::Runs left = observer ? observer(what, make) : make(stages, storage);
    to.ticks += tick_count() - start;
    to.rays += what.stage.again ? 0 : rays;
    to.bytes += std::uint64_t{rays} * (what.bytes + (left.moved ? what.moved_bytes : 0));
    if (what.lanes != 0) {
        to.lanes += std::uint64_t{(rays + what.lanes - 1) / what.lanes} * what.lanes;
        to.filled += rays;
    }
    return left;
}

}  // namespace orrery
