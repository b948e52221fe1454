#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/embree_scene.hpp"
#include "bench/peers.hpp"
#include "bench/timing.hpp"

namespace orrery::bench {

namespace {

/// At most this share of a queue's rays may have another answer. Both sides compute in float, each in its way: a line
/// that grazes a sphere within rounding is a hit to one and a miss to the other. And what a ray meets within own_margin
/// radii of the sphere it left, Embree is kept from: on a ground of radius 500 that is where a pebble touches it.
constexpr double tolerated_share = 2e-3;

bool same(const PeerHit& a, const PeerHit& b) {
    if (a.id == kernels::no_sphere || b.id == kernels::no_sphere) return a.id == b.id;
    // Spheres overlap: where two are met at one distance either is right.
    return std::abs(a.t - b.t) <= 1e-3f * std::max(a.t, b.t) + 1e-6f;
}

template <int width>
struct ClosestHit {
    using Query = typename Packet<width>::Hits;
    static std::vector<Query> packets(const std::vector<PeerRay>& rays) { return hit_packets<width>(rays); }
    static void ask(const int* valid, RTCScene scene, RTCIntersectContext* context, Query* packet) {
        Packet<width>::intersect(valid, scene, context, packet);
    }
    static PeerHit answer(Query& packet, std::size_t lane) {
        if (lane_of(packet.hit.geomID, lane) == RTC_INVALID_GEOMETRY_ID) return {kernels::no_sphere, INFINITY};
        return {lane_of(packet.hit.primID, lane), lane_of(packet.ray.tfar, lane)};
    }
};

template <int width>
struct AnyHit {
    using Query = typename Packet<width>::Rays;
    static std::vector<Query> packets(const std::vector<PeerRay>& rays) { return occlusion_packets<width>(rays); }
    static void ask(const int* valid, RTCScene scene, RTCIntersectContext* context, Query* packet) {
        Packet<width>::occluded(valid, scene, context, packet);
    }
    static PeerHit answer(Query& packet, std::size_t lane) {
        return {lane_of(packet.tfar, lane) < 0 ? 0u : kernels::no_sphere, 0};  // occluded: tfar = -inf
    }
};

/// All queries of one recorded call.
template <class Way, int width>
struct Queries {
    using Query = typename Way::Query;
    std::vector<Query> fresh, work;

    explicit Queries(const std::vector<PeerRay>& rays) : fresh(Way::packets(rays)), work(fresh) {}
    void refresh() { std::copy(fresh.begin(), fresh.end(), work.begin()); }
    void ask(RTCScene scene, RTCIntersectContext& context) {
        alignas(64) static constexpr int all[16] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
        for (Query& packet : work) Way::ask(all, scene, &context, &packet);
    }
    std::size_t different(const std::vector<PeerHit>& ours) {
        std::size_t sum = 0;
        for (std::size_t i = 0; i < ours.size(); ++i)
            sum += same(ours[i], Way::answer(work[i / width], i % width)) ? 0 : 1;
        return sum;
    }
};

template <class Way, int width>
void run_embree(benchmark::State& state, World& world, const PeerQueue& queue, bool coherent, const std::string& who) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    const RTCScene scene = world.embree(queue.stage == std::string_view("shadow")).scene();
    const auto& spheres = world.plan().tables().spheres;
    const FlushDenormals as_its_manual_asks;

    // Google Benchmark calls this several times; answers are compared once.
    static std::map<std::string, std::size_t> compared;
    const auto [different, is_new] = compared.try_emplace(fmt::format("{}/{}/{}", world.name(), queue.name, who));
    std::vector<Queries<Way, width>> queries;
    std::size_t rays = 0;
    for (const StageCall* call : world.recording().of(queue.stage, queue.bounce)) {
        call->before.restore(world.workspace().work);
        const WaveStorage<float>& wave = world.workspace().work;
        queries.emplace_back(call->stage == "shadow" ? peer_rays(spheres, wave.shadows, call->rays, call->target)
                                                     : peer_rays(spheres, wave.rays, call->rays));
        rays += call->rays;
        if (!is_new) continue;
        queries.back().ask(scene, context);
        different->second += queries.back().different(our_answers(*call, world.workspace()));
    }
    if (static_cast<double>(different->second) > tolerated_share * static_cast<double>(rays))
        return fail(state, fmt::format("{} of {} answers are not ours", different->second, rays));
    std::vector<Piece> pieces;
    for (auto& call : queries)
        pieces.push_back({[&call] { call.refresh(); }, [&call, scene, &context] { call.ask(scene, context); }});
    time_passes(state, pieces, static_cast<double>(rays));
    describe_peer(state, world, fmt::format("{} (of {} answers {} differ)", who, rays, different->second));
}

template <template <int> class Way, int width>
void register_way(World& world, const PeerQueue& queue) {
    for (const bool coherent : {false, true}) {
        // Diffuse rays are not coherent, and a single ray has nothing to be coherent with. Packets of 4 do not care.
        if (coherent && (queue.name == std::string_view("diffuse") || width < 8)) continue;
        const std::string who = fmt::format("embree-{}{}", width, coherent ? "-coherent" : "");
        benchmark::RegisterBenchmark(fmt::format("peer/{}/{}/{}", world.name(), queue.name, who).c_str(),
                                     [&world, &queue, coherent, who](benchmark::State& state) {
                                         run_embree<Way<width>, width>(state, world, queue, coherent, who);
                                     })
            ->UseManualTime();
    }
}

template <template <int> class Way, int... width>
void register_widths(World& world, const PeerQueue& queue, std::integer_sequence<int, width...>) {
    (register_way<Way, width>(world, queue), ...);
}

}  // namespace

void register_embree(World& world, const PeerQueue& queue) {
    constexpr std::integer_sequence<int, 1, 4, 8, 16> widths;
    if (queue.stage == std::string_view("shadow"))
        register_widths<AnyHit>(world, queue, widths);
    else
        register_widths<ClosestHit>(world, queue, widths);
}

}  // namespace orrery::bench
