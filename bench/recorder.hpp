// Stage calls of real renders, recorded.
//
// A wave lets an observer make the calls of its stages. The recorder is one that notes what they are made with first:
// integrators run as they always do, and know nothing of it.
#pragma once

#include <string>
#include <vector>

#include "bench/snapshot.hpp"
#include "plan/plan.hpp"
#include "wavefront/pipeline.hpp"

namespace orrery::bench {

/// One call of one stage: its input, and how to make it again.
struct StageCall {
    std::string stage;                          ///< "intersect", "scatter glossy", ...
    std::uint32_t bounce = 0;                   ///< how many times the wave's rays have scattered
    std::uint32_t rays = 0;                     ///< records the stage runs over
    std::uint32_t bytes = 0;                    ///< read and written per record, as the profile counts them
    std::uint32_t results = 0;                  ///< Parts that hold what it computed
    std::uint32_t slots = 0;                    ///< of the wave
    std::uint32_t target = kernels::no_sphere;  ///< shadow: what all rays end on
    Snapshot before;
    /// Runs the stage of `stages` on the restored queues; returns the records of `results` that it left.
    StageRun<float> run;
};

struct Recording {
    std::uint32_t wave_size = 0;
    std::vector<StageCall> calls;

    /// The calls of a stage at a bounce.
    std::vector<const StageCall*> of(const std::string& stage, std::uint32_t bounce) const;
    /// (stage, bounce) of all calls, in the order they were first made.
    std::vector<std::pair<std::string, std::uint32_t>> kinds() const;
};

/// Renders `waves` waves, spread over the image, and records the stages at bounces 0, 1 and 3.
Recording record(const Plan& plan, std::uint32_t waves);

}  // namespace orrery::bench
