#include "bench/peers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/benchmarks.hpp"
#include "bench/timing.hpp"

namespace orrery::bench {

namespace {

constexpr PeerQueue peer_queues[] = {{"primary", "intersect", 0}, {"diffuse", "intersect", 1}, {"shadow", "shadow", 0}};

void run_ours(benchmark::State& state, World& world, const PeerQueue& queue, Isa isa) {
    const auto calls = world.recording().of(queue.stage, queue.bounce);
    const auto& stages = kernels::stages_for(isa);
    Workspace& space = world.workspace();
    if (const std::string& fault = world.fault(queue.stage, queue.bounce, isa); !fault.empty())
        return fail(state, fault);
    std::vector<Piece> pieces;
    double rays = 0;
    for (const StageCall* call : calls) {
        pieces.push_back({[call, &space] { call->before.restore(space.work); },
                          [call, &space, &stages] { call->run(stages, space.work); }});
        rays += call->rays;
    }
    time_passes(state, pieces, rays);
    describe_peer(state, world, isa_name(isa));
}

}  // namespace

std::vector<PeerHit> our_answers(const StageCall& call, Workspace& space) {
    const auto& stages = kernels::stages_for(best_isa());
    WaveStorage<float>& wave = space.work;
    call.before.restore(wave);
    std::vector<PeerHit> answers;
    if (call.stage == "intersect") {
        call.run(stages, wave);
        for (std::uint32_t i = 0; i < call.rays; ++i)
            answers.push_back({wave.hits.id[i] & kernels::no_sphere, wave.hits.t[i]});
        return answers;
    }
    // Shadow rays have one answer only: their radiance arrives. Slots occur once in a queue.
    std::fill_n(wave.slots.radiance, std::size_t{4} * call.slots, 0.0f);
    std::fill_n(wave.shadows.r, call.rays, 1.0f);
    call.run(stages, wave);
    for (std::uint32_t i = 0; i < call.rays; ++i) {
        const bool lit = wave.slots.radiance[std::size_t{4} * wave.shadows.slot[i]] > 0;
        answers.push_back({lit ? kernels::no_sphere : 0u, 0});
    }
    return answers;
}

void describe_peer(benchmark::State& state, World& world, std::string_view who) {
    const auto spheres = world.plan().tables().spheres.count;
    const auto wave = world.recording().wave_size;
    state.counters["spheres"] = spheres;
    state.counters["wave"] = wave;
    state.SetLabel(fmt::format("{} float wave={} spheres={}", who, wave, spheres));
}

void register_peers(const Options& options, Worlds& worlds) {
    const auto add = [&](World& world, const PeerQueue& queue) {
        for (const Isa isa : options.isas) {
            benchmark::RegisterBenchmark(
                fmt::format("peer/{}/{}/{}", world.name(), queue.name, isa_name(isa)).c_str(),
                [&world, &queue, isa](benchmark::State& state) { run_ours(state, world, queue, isa); })
                ->UseManualTime();
        }
        register_embree(world, queue);
    };
    for (World& world : worlds.random())
        for (const PeerQueue& queue : peer_queues) add(world, queue);
    for (World& world : worlds.files())
        for (const PeerQueue& queue : peer_queues)
            if (!world.recording().of(queue.stage, queue.bounce).empty()) add(world, queue);
}

#if !ORRERY_EMBREE
void register_embree(World&, const PeerQueue&) {}
#endif

}  // namespace orrery::bench
