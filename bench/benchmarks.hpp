// Every group of benchmarks registers itself with Google Benchmark by one of these.
//
// A benchmark's name is group/scene/what/variant; bench/pages/bench.py reads it so.
#pragma once

#include "bench/worlds.hpp"

namespace orrery::bench {

/// stage/SCENE/STAGE@BOUNCE/ISA: each stage alone, on recorded queues.
void register_stages(const Options& options, Worlds& worlds);
/// render/SCENE/THREADS/ISA: the whole renderer.
void register_renders(const Options& options, Worlds& worlds);
/// peer/SCENE/QUEUE/WHO: closest hits and occlusion on the same recorded rays, ours and (where built in) Embree's.
void register_peers(const Options& options, Worlds& worlds);
/// build/SPHERES/THREADS/WHO: making the acceleration structure.
void register_builds(const Options& options, Worlds& worlds);
/// machine/OPERATION/dependent or independent/ISA: what bounds the rest.
void register_machine(const Options& options);
/// linear/random-8/QUEUE/avx512: the linear intersect kernel against its bound.
void register_linear(const Options& options, Worlds& worlds);

}  // namespace orrery::bench
