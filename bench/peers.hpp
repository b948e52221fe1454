// Ours and Embree on the same spheres and the same recorded rays, one thread.
//
// Both sides get their rays in the layout they like best, refreshed before each timed run: Embree overwrites tfar and
// the hits in its packets of rays, we write a queue of hits. What is timed is one wave's queries, nothing else.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

#include "bench/worlds.hpp"

namespace orrery::bench {

/// One of the ray kinds: the stage that traces it, and when.
struct PeerQueue {
    const char* name;
    const char* stage;
    std::uint32_t bounce;
};

/// One ray's answer. Occlusion: id 0 and t 0 where occluded.
struct PeerHit {
    std::uint32_t id;  ///< no_sphere where nothing was hit
    float t;
};

/// What our stages answer to a recorded call.
std::vector<PeerHit> our_answers(const StageCall& call, Workspace& space);

void describe_peer(benchmark::State& state, World& world, std::string_view who);

/// peer/WORLD/QUEUE/embree-...: Embree's ways to answer a queue. Only where it is built in.
void register_embree(World& world, const PeerQueue& queue);

}  // namespace orrery::bench
