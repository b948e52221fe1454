// A million spheres made ready for rays.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <chrono>

#include "bench/benchmarks.hpp"
#include "bench/embree_scene.hpp"
#include "bench/timing.hpp"

namespace orrery::bench {

namespace {

using Clock = std::chrono::steady_clock;

void describe(benchmark::State& state, std::uint32_t spheres, unsigned threads, double bytes, const std::string& who) {
    state.counters["spheres"] = spheres;
    state.counters["threads"] = threads;
    state.counters["bytes/sphere"] = bytes / spheres;
    state.SetLabel(fmt::format("{} float spheres={} threads={}", who, spheres, threads));
}

/// Makes the plan's tables, which is more than the acceleration structure.
void run_ours(benchmark::State& state, std::uint32_t count, unsigned threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Scene scene = random_scene(count);
    double bytes = 0;
    double best = INFINITY;
    for (auto _ : state) {
        Scene copy = scene;
        const auto start = Clock::now();
        const Plan plan(std::move(copy));
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        state.SetIterationTime(seconds);
        best = std::min(best, seconds);
        bytes = table_bytes(plan.spheres());
    }
    state.counters["seconds"] = best;
    describe(state, count, threads, bytes, "ours");
}

#if ORRERY_EMBREE
void run_embree(benchmark::State& state, const Plan& plan, unsigned threads, RTCBuildQuality quality,
                const std::string& who) {
    const std::string config = fmt::format("threads={},start_threads=1", threads);
    double bytes = 0;
    double best = INFINITY;
    for (auto _ : state) {
        const EmbreeScene scene(plan.spheres(), config.c_str(), quality);
        state.SetIterationTime(scene.build_seconds());
        best = std::min(best, scene.build_seconds());
        bytes = static_cast<double>(scene.bytes());
    }
    state.counters["seconds"] = best;
    describe(state, plan.spheres().count, threads, bytes, who);
}
#endif

}  // namespace

void register_builds(const Options& options, Worlds& worlds) {
    const std::uint32_t count = options.random_counts.back();
    for (const unsigned threads : {1u, 2u}) {
        const auto add = [&](const std::string& who, const std::function<void(benchmark::State&)>& run) {
            benchmark::RegisterBenchmark(fmt::format("build/{}/{}/{}", count, threads, who).c_str(), run)
                ->UseManualTime()
                ->Iterations(3);
        };
        add("ours", [count, threads](benchmark::State& state) { run_ours(state, count, threads); });
#if ORRERY_EMBREE
        World& world = worlds.random().back();
        add("embree-medium", [&world, threads](benchmark::State& state) {
            run_embree(state, world.plan(), threads, RTC_BUILD_QUALITY_MEDIUM, "embree-medium");
        });
        add("embree-high", [&world, threads](benchmark::State& state) {
            run_embree(state, world.plan(), threads, RTC_BUILD_QUALITY_HIGH, "embree-high");
        });
#else
        static_cast<void>(worlds);
#endif
    }
}

}  // namespace orrery::bench
