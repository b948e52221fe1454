// A million spheres made ready for rays.
#include <fmt/format.h>

#if ORRERY_EMBREE
#include <tbb/global_control.h>
#endif

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "bench/benchmarks.hpp"
#include "bench/embree_scene.hpp"
#include "bench/timing.hpp"

namespace orrery::bench {

namespace {

void describe(benchmark::State& state, std::uint32_t spheres, unsigned threads, double bytes, const std::string& who) {
    state.counters["spheres"] = spheres;
    state.counters["threads"] = threads;
    state.counters["bytes/sphere"] = bytes / spheres;
    state.SetLabel(fmt::format("{} float spheres={} threads={}", who, spheres, threads));
}

/// A plan's spheres in random order, as a structure is given them: the plan has put them into its tree's.
struct Shuffled {
    std::vector<float> x, y, z, radius;

    explicit Shuffled(const kernels::SphereTable<float>& spheres) {
        std::vector<std::uint32_t> order(spheres.count);
        std::iota(order.begin(), order.end(), 0u);
        std::shuffle(order.begin(), order.end(), std::mt19937(1));
        for (const std::uint32_t k : order) {
            x.push_back(spheres.cx[k]);
            y.push_back(spheres.cy[k]);
            z.push_back(spheres.cz[k]);
            radius.push_back(spheres.radius[k]);
        }
    }
    kernels::SphereTable<float> table() const {
        kernels::SphereTable<float> spheres;
        spheres.count = static_cast<std::uint32_t>(x.size());
        spheres.cx = x.data();
        spheres.cy = y.data();
        spheres.cz = z.data();
        spheres.radius = radius.data();
        return spheres;
    }
};

/// One thread is timed by the processor, which other tenants of the machine do not add to.
TimedBy clock_for(unsigned threads) { return threads == 1 ? TimedBy::processor : TimedBy::wall; }

void run_ours(benchmark::State& state, const Plan& plan, unsigned threads) {
    const Shuffled given(plan.tables().spheres);
    const std::uint32_t count = plan.tables().spheres.count;
    double best = INFINITY;
    for (auto _ : state) {
        std::vector<BuildSphere> spheres;
        for (std::uint32_t k = 0; k < count; ++k)
            spheres.push_back({given.x[k], given.y[k], given.z[k], given.radius[k], k});
        const Stopwatch watch(clock_for(threads));
        const Tree tree = build_tree(spheres, threads);
        const double seconds = watch.seconds();
        if (tree.nodes.size() != plan.tables().spheres.tree.count) fail(state, "the tree is not the plan's");
        state.SetIterationTime(seconds);
        best = std::min(best, seconds);
    }
    state.counters["seconds"] = best;
    describe(state, count, threads, table_bytes(plan.tables().spheres), "ours");
}

#if ORRERY_EMBREE
void run_embree(benchmark::State& state, const Plan& plan, unsigned threads, RTCBuildQuality quality,
                const std::string& who) {
    // By TBB's limit: the first device's threads=N would hold for the whole process.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Shuffled given(plan.tables().spheres);
    double bytes = 0;
    double best = INFINITY;
    for (auto _ : state) {
        const EmbreeScene scene(given.table(), "", quality, clock_for(threads));
        state.SetIterationTime(scene.build_seconds());
        best = std::min(best, scene.build_seconds());
        bytes = static_cast<double>(scene.bytes());
    }
    state.counters["seconds"] = best;
    describe(state, plan.tables().spheres.count, threads, bytes, who);
}
#endif

}  // namespace

void register_builds(const Options& options, Worlds& worlds) {
    const std::uint32_t count = options.random_counts.back();
    World& world = worlds.random().back();
    for (const unsigned threads : {1u, 2u}) {
        const auto add = [&](const std::string& who, const std::function<void(benchmark::State&)>& run) {
            benchmark::RegisterBenchmark(fmt::format("build/{}/{}/{}", count, threads, who).c_str(), run)
                ->UseManualTime()
                ->Iterations(1);
        };
        add("ours", [&world, threads](benchmark::State& state) { run_ours(state, world.plan(), threads); });
#if ORRERY_EMBREE
        add("embree-medium", [&world, threads](benchmark::State& state) {
            run_embree(state, world.plan(), threads, RTC_BUILD_QUALITY_MEDIUM, "embree-medium");
        });
        add("embree-high", [&world, threads](benchmark::State& state) {
            run_embree(state, world.plan(), threads, RTC_BUILD_QUALITY_HIGH, "embree-high");
        });
#endif
    }
}

}  // namespace orrery::bench
