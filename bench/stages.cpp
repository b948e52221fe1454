// Each stage alone, on queues of real renders.
#include <fmt/format.h>

#include "bench/benchmarks.hpp"
#include "bench/timing.hpp"
#include "bench/worlds.hpp"

namespace orrery::bench {

namespace {

void run_stage(benchmark::State& state, World& world, const std::string& stage, std::uint32_t bounce, Isa isa) {
    const auto calls = world.recording().of(stage, bounce);
    const auto& stages = kernels::stages_for(isa);
    Workspace& space = world.workspace();
    if (const std::string& fault = world.fault(stage, bounce, isa); !fault.empty()) return fail(state, fault);
    std::vector<Piece> pieces;
    double rays = 0, bytes = 0;
    for (const StageCall* call : calls) {
        pieces.push_back({[call, &space] { call->before.restore(space.work); },
                          [call, &space, &stages] { call->run(stages, space.work); }});
        rays += call->rays;
        bytes += static_cast<double>(call->rays) * call->bytes;
    }
    time_passes(state, pieces, rays);
    state.counters["bytes/ray"] = bytes / rays;
    state.counters["spheres"] = world.plan().tables().spheres.count;
    state.counters["wave"] = world.recording().wave_size;
    state.SetLabel(fmt::format("{} float wave={} spheres={}", isa_name(isa), world.recording().wave_size,
                               world.plan().tables().spheres.count));
}

}  // namespace

void register_stages(const Options& options, Worlds& worlds) {
    for (World& world : worlds.files())
        for (const auto& [stage, bounce] : world.recording().kinds())
            for (const Isa isa : options.isas)
                benchmark::RegisterBenchmark(
                    fmt::format("stage/{}/{}@{}/{}", world.name(), stage, bounce, isa_name(isa)).c_str(),
                    [&world, stage = stage, bounce = bounce, isa](benchmark::State& state) {
                        run_stage(state, world, stage, bounce, isa);
                    })
                    ->UseManualTime();
}

}  // namespace orrery::bench
