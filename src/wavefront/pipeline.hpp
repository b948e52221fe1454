// The stages as a plan runs them: which entries of their table, chosen once, and every call with what there is to tell
// of it.
#pragma once

#include <functional>
#include <vector>

#include "kernels/stages.hpp"
#include "wavefront/profile.hpp"
#include "wavefront/wave_storage.hpp"

namespace orrery {

/// A clock to time stages by: a call takes microseconds, and reading the system's clock twice took 2 % of a render.
/// This one is the processor's counter, in ticks of a constant length.
std::uint64_t tick_count();

/// A StageCost before ticks are known as seconds.
struct StageTicks {
    std::uint64_t ticks = 0, rays = 0, lanes = 0, filled = 0, bytes = 0;
};
using TicksByBounce = std::array<std::array<StageTicks, stage_names.size()>, profile_bounces>;
/// What they say at so many seconds a tick; `others` is left to the caller.
Profile profile_of(const TicksByBounce& ticks, double seconds_per_tick);

/// Queues of a WaveStorage, as bits.
enum Parts : std::uint32_t {
    slot_part = 1,      ///< pixel, sample, plane: what identifies the slots
    radiance_part = 2,  ///< what the slots gathered
    ray_part = 4,
    hit_part = 8,
    lobe_part = 16,
    shadow_part = 32,
    sorted_part = 64,  ///< sorted rays and hits
    aside_part = 128,  ///< rays that light samples are drawn for
    chain_part = 256,  ///< what the slots' paths did at smooth spheres
    pick_part = 512,
};

/// A stage, as those see it who count and record what it does.
struct StageInfo {
    const char* name;
    Stage counted;                ///< in the profile
    std::uint32_t reads, writes;  ///< Parts; writes none: its calls cannot be repeated
    bool again = false;           ///< sees rays that another stage counted there has counted
};

/// One call of a stage.
struct StageCall {
    StageInfo stage;
    std::uint32_t bounce = 0;
    kernels::Range records{};                   ///< it runs over
    std::uint32_t bytes = 0;                    ///< of the queues' columns, read and written per record
    std::uint32_t lanes = 0;                    ///< per step of the kernel; 0: its vectors hold no rays
    const char* detail = "";                    ///< which of the kernels of that name
    std::uint32_t moved_bytes = 0;              ///< further ones where the records are moved to other queues
    std::uint32_t target = kernels::no_sphere;  ///< what all shadow rays end on
};

/// Makes a call on some queues by the stages of some instruction set; returns which records of `writes` that left.
template <class Real>
using StageRun = std::function<kernels::Runs(const kernels::Stages<Real>&, WaveStorage<Real>&)>;
/// What makes calls in place of the wave. The run outlives the wave, but not the plan.
template <class Real>
using StageObserver = std::function<kernels::Runs(const StageCall&, const StageRun<Real>&)>;

/// What a plan runs, decided once.
template <class Real>
struct Pipeline {
    using Table = kernels::Stages<Real>;
    Pipeline(const Plan& plan, const Table& stages);

    typename Table::Generate Table::*generate;
    typename Table::Intersect Table::*intersect;
    typename Table::Shadow Table::*shadow;
    typename Table::Unblocked Table::*unblocked;
    std::uint32_t sphere_step;  ///< rays that intersect and shadow take at a time; 0: their vectors hold spheres
    kernels::LightStrategy strategy;
    bool emission;                           ///< rays may run into light
    std::vector<kernels::Scattering> kinds;  ///< ways of scattering there are
    std::vector<kernels::Scattering> lit;    ///< those whose vertices sample lights
    std::uint32_t roulette_from;             ///< the first bounce at which it is played; the largest number: never
};

}  // namespace orrery
