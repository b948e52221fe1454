// The linear intersect kernel against what the machine's ports allow its instructions; derived in README.md.
#include <fmt/format.h>

#include <algorithm>

#include "bench/benchmarks.hpp"
#include "bench/machine.hpp"
#include "bench/timing.hpp"

#if defined(__x86_64__)

namespace orrery::bench {

namespace {

/// Operations of the kernel's inner loop on the two vector ports, for one sphere and one vector of rays of which none
/// starts within that sphere. Counted in its disassembly (README.md).
constexpr double slots_per_test = 32.5;

void run_linear(benchmark::State& state, World& world, std::uint32_t bounce) {
    const auto calls = world.recording().of("intersect", bounce);
    const auto& stages = kernels::stages_for(Isa::avx512);
    const auto& spheres = world.plan().tables().spheres;
    Workspace& space = world.workspace();
    if (const auto& fault = world.fault("intersect", bounce, Isa::avx512); !fault.empty()) return fail(state, fault);
    // Turn by turn with multiply-adds that fill both ports, so that whatever else the core is doing slows both.
    std::vector<Piece> pieces;
    double vectors = 0;
    for (const StageCall* call : calls) {
        pieces.push_back({[call, &space] { call->before.restore(space.work); },
                          [call, &space, &stages, &spheres] {
                              // The plain loop: what was recorded may leave spheres out (packets.hpp).
                              stages.intersect(spheres, space.work.rays, call->rays, space.work.hits);
                          }});
        pieces.push_back({[] {}, independent_512});
        vectors += (call->rays + stages.lanes - 1) / stages.lanes;
    }
    const std::vector<double> seconds = time_pieces(state, pieces, TimedBy::processor);
    double kernel = 0, ports = 0;
    for (std::size_t i = 0; i < seconds.size(); i += 2) kernel += seconds[i], ports += seconds[i + 1];
    const double tests = vectors * spheres.count;
    const double slots = static_cast<double>(calls.size()) * independent_operations;
    const double bound = slots / ports / slots_per_test;
    state.counters["Rays/s"] = vectors * stages.lanes / kernel;
    state.counters["tests/us"] = tests / kernel * 1e-6;
    state.counters["bound/us"] = bound * 1e-6;
    state.SetLabel(fmt::format("{:.0f} % of the bound", 100 * tests / kernel / bound));
}

}  // namespace

void register_linear(const Options& options, Worlds& worlds) {
    if (std::find(options.isas.begin(), options.isas.end(), Isa::avx512) == options.isas.end()) return;
    for (World& world : worlds.random()) {
        if (world.name() != "random-8") continue;
        benchmark::RegisterBenchmark(fmt::format("linear/{}/diffuse/avx512", world.name()).c_str(),
                                     [&world](benchmark::State& state) { run_linear(state, world, 1); })
            ->UseManualTime();
    }
}

}  // namespace orrery::bench

#else

namespace orrery::bench {
void register_linear(const Options&, Worlds&) {}
}  // namespace orrery::bench

#endif
