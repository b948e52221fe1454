#include "bench/recorder.hpp"

#include <algorithm>
#include <functional>

#include "wavefront/tile.hpp"

namespace orrery::bench {

using namespace kernels;

namespace {

using Table = Stages<float>;
using Rays = RayQueue<float>;
using Hits = HitQueue<float>;
using Slots = SlotTable<float>;
using Lobes = LobeQueue<float>;
using Shadows = ShadowQueue<float>;
using Spheres = SphereTable<float>;

/// The table's entries are plain functions: what they work on is here while a wave is recorded.
struct Session {
    const Table& forward;
    Recording& recording;
    const Wave<float>* wave = nullptr;
    std::uint32_t passes = 0;  ///< of intersect, in this wave
};
Session* session = nullptr;

Runs whole(std::uint32_t count) {
    Runs runs;
    runs.run[0] = {0, count};
    return runs;
}

std::uint32_t end_of(const Runs& runs) {
    std::uint32_t end = 0;
    for (const Range& run : runs.run) end = std::max(end, run.count == 0 ? 0 : run.begin + run.count);
    return end;
}

std::uint32_t total(const Runs& runs) {
    std::uint32_t sum = 0;
    for (const Range& run : runs.run) sum += run.count;
    return sum;
}

/// Bytes of a record, absent fields left out.
template <class Queue>
std::uint32_t bytes_of(const Queue& queue) {
    std::uint32_t sum = 0;
    Queue::each_field([&](const char*, auto member) { sum += queue.*member != nullptr ? 4u : 0u; });
    return sum;
}

constexpr std::uint32_t vector3 = 12, word = 4;

void note(std::string stage, std::uint32_t rays, std::uint32_t bytes, std::uint32_t inputs, std::uint32_t records,
          std::uint32_t results, std::function<Runs(const Table&, WaveStorage<float>&)> run,
          std::uint32_t skip = no_sphere) {
    const std::uint32_t bounce = session->passes == 0 ? 0 : session->passes - 1;
    if (rays == 0 || (bounce != 0 && bounce != 1 && bounce != 3)) return;
    const Wave<float>& wave = *session->wave;
    session->recording.calls.push_back({std::move(stage), bounce, rays, bytes, results, wave.count, skip,
                                        Snapshot(wave.storage, inputs, wave.count, records), std::move(run)});
}

template <bool lens>
void generate_noted(const CameraTable<float>& camera, const Slots& slots, std::uint32_t count, std::uint32_t seed,
                    const Rays& rays) {
    session->passes = 0;
    note("generate", count, 4 * word + bytes_of(rays) + 4 * word, slot_part, 0, ray_part | radiance_part,
         [camera, count, seed](const Table& s, WaveStorage<float>& w) {
             (lens ? s.generate_lens : s.generate_pinhole)(camera, w.slots, count, seed, w.rays);
             return whole(count);
         });
    (lens ? session->forward.generate_lens : session->forward.generate_pinhole)(camera, slots, count, seed, rays);
}

/// `stage` is the table's entry that was called, so that it is the one called again.
template <Table::Intersect Table::*stage>
void intersect_noted(const Spheres& spheres, const Rays& rays, std::uint32_t count, const Hits& hits) {
    ++session->passes;
    note("intersect", count, 2 * vector3 + word + 2 * word, ray_part, count, hit_part,
         [spheres, count](const Table& s, WaveStorage<float>& w) {
             (s.*stage)(spheres, w.rays, count, w.hits);
             return whole(count);
         });
    (session->forward.*stage)(spheres, rays, count, hits);
}

void emission_noted(const Spheres& spheres, const LightTable<float>& lights, const Background<float>& background,
                    LightStrategy strategy, const Rays& rays, const Hits& hits, std::uint32_t count,
                    const Slots& slots) {
    note("emission", count, bytes_of(hits) + 3 * vector3 + 2 * word, radiance_part | ray_part | hit_part, count,
         radiance_part, [spheres, lights, background, strategy, count](const Table& s, WaveStorage<float>& w) {
             s.emission(spheres, lights, background, strategy, w.rays, w.hits, count, w.slots);
             return whole(count);
         });
    session->forward.emission(spheres, lights, background, strategy, rays, hits, count, slots);
}

bool sort_noted(const Spheres& spheres, std::uint32_t kinds, const Rays& rays, const Hits& hits, std::uint32_t count,
                const Rays& sorted_rays, const Hits& sorted_hits, Runs& runs) {
    note("sort", count, 2 * (bytes_of(rays) + bytes_of(hits)) + vector3 + word, ray_part | hit_part, count, sorted_part,
         [spheres, kinds, count](const Table& s, WaveStorage<float>& w) {
             Runs found;
             const bool moved =
                 s.sort_by_scattering(spheres, kinds, w.rays, w.hits, count, w.sorted_rays, w.sorted_hits, found);
             return moved ? found : Runs{};
         });
    return session->forward.sort_by_scattering(spheres, kinds, rays, hits, count, sorted_rays, sorted_hits, runs);
}

template <std::uint32_t kind>
void scatter_noted(const ScatterContext<float>& context, Range run, const Rays& rays, const Hits& hits,
                   const Lobes& lobes) {
    constexpr bool rough = scattering_traits[kind].is_rough();
    note(std::string("scatter ") + scattering_traits[kind].name, run.count,
         2 * bytes_of(rays) + bytes_of(hits) + (rough ? bytes_of(lobes) : 0), slot_part | ray_part | hit_part,
         run.begin + run.count, ray_part | (rough ? lobe_part : 0u),
         [context, run](const Table& s, WaveStorage<float>& w) {
             ScatterContext<float> here = context;
             here.slots = w.slots;
             s.scatter[kind](here, run, w.rays, w.hits, w.lobes);
             Runs runs;
             runs.run[0] = run;
             return runs;
         });
    session->forward.scatter[kind](context, run, rays, hits, lobes);
}

template <std::size_t response>
std::uint32_t connect_noted(const ConnectContext<float>& context, std::uint32_t light, Range run, const Rays& rays,
                            const Lobes& lobes, const Shadows& queue) {
    note(light == chosen_light           ? "connect chosen"
         : light < context.lights.points ? "connect point"
                                         : "connect area",
         run.count, 2 * vector3 + 4 * word + bytes_of(lobes) + bytes_of(queue), slot_part | ray_part | lobe_part,
         run.begin + run.count, shadow_part, [context, light, run](const Table& s, WaveStorage<float>& w) {
             ConnectContext<float> here = context;
             here.slots = w.slots;
             return whole(s.connect[response](here, light, run, w.rays, w.lobes, w.shadows));
         });
    return session->forward.connect[response](context, light, run, rays, lobes, queue);
}

template <Table::Shadow Table::*stage>
void shadow_noted(const Spheres& spheres, const Shadows& queue, std::uint32_t count, std::uint32_t skip,
                  const Slots& slots) {
    note(
        "shadow", count, bytes_of(queue) + 2 * vector3, radiance_part | shadow_part, count, radiance_part,
        [spheres, count, skip](const Table& s, WaveStorage<float>& w) {
            (s.*stage)(spheres, w.shadows, count, skip, w.slots);
            return whole(count);
        },
        skip);
    (session->forward.*stage)(spheres, queue, count, skip, slots);
}

std::uint32_t roulette_noted(const Slots& slots, std::uint32_t seed, std::uint32_t bounce, bool play, const Runs& runs,
                             const Rays& rays) {
    note("roulette", total(runs), 2 * bytes_of(rays), slot_part | ray_part, end_of(runs), ray_part,
         [seed, bounce, play, runs](const Table& s, WaveStorage<float>& w) {
             return whole(s.roulette(w.slots, seed, bounce, play, runs, w.rays));
         });
    return session->forward.roulette(slots, seed, bounce, play, runs, rays);
}

/// Entries that are not noted pass straight on.
Table noting(const Table& forward) {
    Table table = forward;
    table.generate_pinhole = generate_noted<false>;
    table.generate_lens = generate_noted<true>;
    table.intersect = intersect_noted<&Table::intersect>;
    table.intersect_coherent = intersect_noted<&Table::intersect_coherent>;
    table.intersect_tree = intersect_noted<&Table::intersect_tree>;
    table.emission = emission_noted;
    table.sort_by_scattering = sort_noted;
    [&]<std::uint32_t... kind>(std::integer_sequence<std::uint32_t, kind...>) {
        ((table.scatter[kind] = scatter_noted<kind>), ...);
    }
    (std::make_integer_sequence<std::uint32_t, scattering_count>{});
    table.connect[0] = connect_noted<0>;
    table.connect[1] = connect_noted<1>;
    table.shadow = shadow_noted<&Table::shadow>;
    table.shadow_coherent = shadow_noted<&Table::shadow_coherent>;
    table.shadow_tree = shadow_noted<&Table::shadow_tree>;
    table.roulette = roulette_noted;
    return table;
}

}  // namespace

std::vector<const StageCall*> Recording::of(const std::string& stage, std::uint32_t bounce) const {
    std::vector<const StageCall*> found;
    for (const StageCall& call : calls)
        if (call.stage == stage && call.bounce == bounce) found.push_back(&call);
    return found;
}

std::vector<std::pair<std::string, std::uint32_t>> Recording::kinds() const {
    std::vector<std::pair<std::string, std::uint32_t>> found;
    for (const StageCall& call : calls) {
        const std::pair kind(call.stage, call.bounce);
        if (std::find(found.begin(), found.end(), kind) == found.end()) found.push_back(kind);
    }
    return found;
}

Recording record(const Plan& plan, std::uint32_t waves) {
    Recording recording;
    recording.wave_size = choose_wave_size(plan, 0);
    recording.queue_bytes_per_ray = queue_bytes(plan, recording.wave_size) / recording.wave_size;
    const Table& forward = stages_for(best_isa());
    const Table table = noting(forward);
    Film film(plan.settings().width, plan.settings().height);
    const std::function<bool()> never;
    const Cancellation cancellation(never);
    Wave<float> wave(plan, table, film, cancellation, recording.wave_size);
    Session here{forward, recording, &wave};
    session = &here;
    const Tiling tiles(plan.settings().width, plan.settings().height, tile_side(plan.samples()));
    // Steps of the golden section visit the image evenly, whatever the number of tiles in a row.
    const auto step = static_cast<std::size_t>(0.618 * static_cast<double>(tiles.size())) | 1;
    for (std::size_t i = 0; i < waves; ++i) {
        Tile tile = tiles[(i + 1) * step % tiles.size()];
        const std::uint32_t pixels = std::max(1u, recording.wave_size / plan.samples());  // one wave of it is enough
        tile.x1 = std::min(tile.x1, tile.x0 + pixels);
        tile.y1 = std::min(tile.y1, tile.y0 + std::max(1u, pixels / (tile.x1 - tile.x0)));
        render_tile(wave, {tile, whole_pattern(plan)});
    }
    session = nullptr;
    return recording;
}

}  // namespace orrery::bench
