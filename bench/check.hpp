// Whether a stage computed what the scalar stage computes from the same queue.
#pragma once

#include <string>
#include <vector>

#include "bench/recorder.hpp"

namespace orrery::bench {

/// Two wave storages for a plan, so that a stage's result can be compared with the scalar stage's.
struct Workspace {
    Workspace(const Plan& plan, std::uint32_t wave_size)
        : work(plan.needs(), plan.settings().depth, wave_size),
          expected(plan.needs(), plan.settings().depth, wave_size) {}
    WaveStorage<float> work, expected;
};

/// Runs the calls once with `stages` and once with the scalar ones. Instruction sets with fused multiply-add must give
/// the same bytes. SSE2 has none: its numbers may differ by 1e-3 (relative, absolute below 1), and by more in one
/// record of 200 and three besides, where a rounding turned a grazing hit or a random choice, or a density is near its
/// singularity. Returns what is wrong, empty if nothing is.
std::string fault_of(const std::vector<const StageCall*>& calls, const kernels::Stages<float>& stages,
                     Workspace& workspace);

}  // namespace orrery::bench
