#include <utility>

#include "wavefront/wave_call.hpp"

namespace orrery {

using kernels::Range;
using kernels::Runs;
using kernels::Scattering;

namespace {

constexpr StageInfo generate_info{"generate", Stage::generate, slot_part, ray_part | radiance_part};
constexpr StageInfo intersect_info{"intersect", Stage::intersect, ray_part, hit_part};
constexpr StageInfo emission_info{"emission", Stage::shade, radiance_part | ray_part | hit_part | chain_part,
                                  radiance_part, true};
constexpr StageInfo sort_info{"sort", Stage::shade, ray_part | hit_part, sorted_part, true};
constexpr StageInfo scatter_info{"scatter", Stage::shade, slot_part | ray_part | hit_part | chain_part,
                                 ray_part | chain_part};
constexpr StageInfo rough_info{"scatter", Stage::shade, slot_part | ray_part | hit_part | chain_part,
                               ray_part | lobe_part | chain_part};
// What it puts aside is not compared: the slots are.
constexpr StageInfo exact_info{"exact", Stage::shade, slot_part | radiance_part | ray_part, radiance_part, true};
constexpr StageInfo aside_info{"connect", Stage::shade, slot_part | aside_part, shadow_part, true};
constexpr StageInfo connect_info{"connect", Stage::shade, slot_part | ray_part | lobe_part, shadow_part, true};
constexpr StageInfo shadow_info{"shadow", Stage::shadow, radiance_part | shadow_part, radiance_part};
constexpr StageInfo chance_info{"chance", Stage::shade, radiance_part | ray_part | hit_part | chain_part | pick_part,
                                radiance_part, true};
constexpr StageInfo weigh_info{"weigh", Stage::shade, shadow_part | chain_part, shadow_part, true};
constexpr StageInfo guide_info{"guide", Stage::shade, slot_part | ray_part, ray_part, true};
constexpr StageInfo roulette_info{"roulette", Stage::roulette, slot_part | ray_part, ray_part};
constexpr StageInfo branch_info{"branch", Stage::shade, 0, 0};
constexpr StageInfo resume_info{"resume", Stage::roulette, 0, 0};

/// What builds a scattering stage's context on some queues; it outlives the wave.
template <class Real>
auto scattering_on(const Wave<Real>& w, std::uint32_t bounce) {
    return [&tables = w.tables, seed = w.plan.settings().seed, bounce,
            competing = w.plan.needs().competing](const WaveStorage<Real>& q) {
        return kernels::ScatterContext<Real>{tables.spheres, tables.materials, q.slots, seed, bounce, competing};
    };
}

/// Whether light `which` is sampled over some glossy sphere.
template <class Real>
bool seen_over_glossy(const kernels::CausticTable<Real>& caustics, std::uint32_t which) {
    return std::any_of(caustics.entries, caustics.entries + caustics.count,
                       [=](const auto& c) { return c.light == which && c.roughness > 0; });
}

}  // namespace

template <class Real>
std::uint32_t Wave<Real>::generate() {
    const std::uint32_t bytes = words<Real>(4) + record_bytes(storage.rays) + words<Real>(4);
    call({generate_info, 0, {0, count}, bytes, stages.step},
         [from = camera, stage = pipeline.generate, rays = count, seed = plan.settings().seed](const auto& s, auto& q) {
             (s.*stage)(from, q.slots, rays, seed, q.rays);
             return only({0, rays});
         });
    return count;
}

template <class Real>
void Wave<Real>::intersect(std::uint32_t rays, std::uint32_t bounce) {
    const std::uint32_t bytes = words<Real>(3 + 3 + 1) + record_bytes(storage.hits);
    call({intersect_info, bounce, {0, rays}, bytes, pipeline.sphere_step},
         [&spheres = tables.spheres, stage = pipeline.intersect, rays](const auto& s, auto& q) {
             (s.*stage)(spheres, q.rays, rays, q.hits);
             return only({0, rays});
         });
    counters.closest_rays += rays;
}

template <class Real>
void Wave<Real>::gather_emission(std::uint32_t rays, std::uint32_t bounce) {
    if (!pipeline.emission) return;
    // The hits' ids; what few rays run into light load more.
    const Runs aside = call({emission_info, bounce, {0, rays}, words<Real>(1), stages.step},
                            [&t = tables, strategy = pipeline.strategy, rays](const auto& s, auto& q) {
                                return only({0, s.emission(t.spheres, t.lights(true), t.background, strategy, q.rays,
                                                           q.hits, rays, q.slots, q.picks)});
                            });
    const std::uint32_t by_chance = aside.run[0].count;
    if (by_chance == 0) return;
    call({chance_info, bounce, {0, by_chance}, words<Real>(1 + 10 + 3 + 1 + 8), stages.lanes},
         [context = caustics_on(*this, bounce), by_chance](const auto& s, auto& q) {
             s.caustic_emission(context(q), by_chance, q.rays, q.hits, q.picks);
             return only({0, by_chance});
         });
}

template <class Real>
Runs Wave<Real>::sort(std::uint32_t rays, std::uint32_t bounce) {
    Runs runs;
    if (!plan.needs().sort) {
        for (const Scattering kind : pipeline.kinds) runs.run[static_cast<std::size_t>(kind)] = {0, rays};
        return runs;
    }
    const std::uint32_t moved = 2 * (record_bytes(storage.rays) + record_bytes(storage.hits));
    runs = call({sort_info, bounce, {0, rays}, words<Real>(3 + 1), stages.lanes, "", moved},
                [&spheres = tables.spheres, kinds = plan.needs().scattering, rays](const auto& s, auto& q) {
                    return s.sort_by_scattering(spheres, kinds, q.rays, q.hits, rays, q.sorted_rays, q.sorted_hits);
                });
    if (runs.moved) {
        std::swap(storage.rays, storage.sorted_rays);
        std::swap(storage.hits, storage.sorted_hits);
    }
    return runs;
}

template <class Real>
void Wave<Real>::scatter(Scattering kind, const Runs& runs, std::uint32_t bounce) {
    const auto k = static_cast<std::size_t>(kind);
    const Range hits = runs.run[k];
    if (hits.count == 0) return;
    const kernels::ScatteringTraits& traits = kernels::traits_of(kind);
    const bool rough = traits.is_rough();
    // Read and written in place but for the slot, pixel and sample, which are only read.
    const std::uint32_t bytes = 2 * record_bytes(storage.rays) - words<Real>(3) + record_bytes(storage.hits) +
                                (rough ? record_bytes(storage.lobes) : 0);
    // Where no caustic is over a glossy sphere, chains need not know of them.
    const bool noted = kind != Scattering::glossy || plan.needs().glossy_caustics;
    call({rough ? rough_info : scatter_info, bounce, hits, bytes, stages.step, traits.name},
         [context = scattering_on(*this, bounce), k, hits, noted](const auto& s, auto& q) {
             auto on = context(q);
             if (!noted) on.slots.chains = {};
             s.scatter[k](on, hits, q.rays, q.hits, q.lobes);
             return only(hits);
         });
}

template <class Real>
void Wave<Real>::direct_lighting(const Runs& runs, std::uint32_t bounce) {
    for (const Scattering kind : pipeline.lit) {
        const Range vertices = runs.run[static_cast<std::size_t>(kind)];
        if (vertices.count == 0) continue;
        const auto& lights = tables.lights((plan.needs().connect_area & kernels::bit_of(kind)) != 0);
        if (lights.cells != 0) {
            light(kind, lights, vertices, kernels::chosen_light, bounce);
        } else {
            for (std::uint32_t l = 0; l < lights.count; ++l) light(kind, lights, vertices, l, bounce);
        }
    }
}

/// The vertices of a run towards one light, or each towards the one it chooses; and what of that arrives.
template <class Real>
void Wave<Real>::light(Scattering kind, const kernels::LightTable<Real>& lights, Range vertices, std::uint32_t which,
                       std::uint32_t bounce) {
    const kernels::Response response = kernels::traits_of(kind).response;
    const bool chosen = which == kernels::chosen_light;
    const std::uint32_t bytes = words<Real>(3 + 3 + 4) + record_bytes(storage.shadows) +
                                (response == kernels::Response::glossy ? record_bytes(storage.lobes) : 0);
    proceed(vertices.count);
    const auto context_on = [&t = tables, &lights, bounce, seed = plan.settings().seed, strategy = pipeline.strategy,
                             competing = plan.needs().competing](const WaveStorage<Real>& q) {
        return kernels::ConnectContext<Real>{t.spheres, t.materials, lights,   q.slots,
                                             seed,      bounce,      strategy, competing};
    };
    const bool exact =
        plan.needs().exact && response == kernels::Response::diffuse && !chosen && which >= lights.points;
    if (exact) {
        vertices = call({exact_info, bounce, vertices, words<Real>(3 + 3 + 2) + words<Real>(4), stages.sphere_step},
                        [context_on, vertices, which](const auto& s, auto& q) {
                            return only({0, s.exact(context_on(q), which, vertices, q.rays, q.aside)});
                        })
                       .run[0];
        if (vertices.count == 0) return;
    }
    const Runs aimed =
        call({exact ? aside_info : connect_info, bounce, vertices, bytes, stages.step,
              chosen                  ? "chosen"
              : which < lights.points ? "point"
                                      : "area"},
             [context_on, response, vertices, which, exact](const auto& s, auto& q) {
                 const auto stage = s.connect[static_cast<std::size_t>(response)];
                 return only({0, stage(context_on(q), which, vertices, exact ? q.aside : q.rays, q.lobes, q.shadows)});
             });
    const std::uint32_t rays = aimed.run[0].count;
    if (kind == Scattering::glossy && bounce > 0 && rays > 0 && seen_over_glossy(tables.caustics, which))
        call({weigh_info, bounce, {0, rays}, words<Real>(1 + 1 + 2 * 3 + 9), stages.lanes},
             [context = caustics_on(*this, bounce + 1), which, rays](const auto& s, auto& q) {
                 s.weigh_shadows(context(q), which, rays, q.shadows);
                 return only({0, rays});
             });
    shadow(rays, chosen ? kernels::no_sphere : static_cast<std::uint32_t>(lights.sphere[which]), bounce);
}

template <class Real>
void Wave<Real>::shadow(std::uint32_t rays, std::uint32_t target, std::uint32_t bounce) {
    if (rays == 0) return;
    // Only where vertices choose their lights do shadow rays differ in what they end on.
    const bool alike = target != kernels::no_sphere || !plan.needs().one_light;
    call({.stage = shadow_info,
          .bounce = bounce,
          .records = {0, rays},
          .bytes = record_bytes(storage.shadows) + 2 * words<Real>(4),
          .lanes = pipeline.sphere_step,
          .target = target},
         [&spheres = tables.spheres, stage = pipeline.shadow, rays, target, alike](const auto& s, auto& q) {
             auto queue = q.shadows;
             if (alike) queue.target = nullptr;
             (s.*stage)(spheres, queue, rays, target, q.slots);
             return only({0, rays});
         });
    counters.shadow_rays += rays;
}

template <class Real>
void Wave<Real>::guide(const Runs& runs, std::uint32_t bounce) {
    const Range vertices = runs.run[static_cast<std::size_t>(Scattering::diffuse)];
    // What rays from the last vertex find are lamps alone.
    if (!plan.needs().guide || vertices.count == 0 || bounce + 2 > plan.settings().depth) return;
    call({guide_info, bounce, vertices, words<Real>(3 + 2 * 3 + 2 * 3 + 1 + 2 + 1 + 2), stages.lanes},
         [&t = tables, seed = plan.settings().seed, competing = plan.needs().competing, bounce, vertices](const auto& s,
                                                                                                          auto& q) {
             s.guide({t.spheres, q.slots, t.guide, seed, bounce, competing}, vertices, q.rays);
             return only(vertices);
         });
}

template <class Real>
std::uint32_t Wave<Real>::roulette(const Runs& runs, std::uint32_t bounce) {
    std::uint32_t rays = 0, end = 0;
    for (const Range& run : runs.run) {
        rays += run.count;
        if (run.count != 0) end = run.begin + run.count;
    }
    const bool play = bounce >= pipeline.roulette_from;
    return call({roulette_info, bounce, {end - rays, rays}, 2 * record_bytes(storage.rays), stages.step},
                [seed = plan.settings().seed, bounce, play, runs](const auto& s, auto& q) {
                    return only({0, s.roulette(q.slots, seed, bounce, play, runs, q.rays)});
                })
        .run[0]
        .count;
}

template <class Real>
void Wave<Real>::expire(std::uint32_t rays) {
    stages.expire(plan.settings().depth, rays, storage.rays);
}

template <class Real>
void Wave<Real>::branch(const Runs& runs, std::uint32_t bounce) {
    const Range hits = runs.run[static_cast<std::size_t>(Scattering::dielectric)];
    if (hits.count == 0) return;
    call({branch_info, bounce, hits, 2 * record_bytes(storage.rays), stages.lanes},
         [context = scattering_on(*this, 0), hits](const auto& s, auto& q) {
             s.branch(context(q), hits, q.rays, q.hits, q.branches);
             return only(hits);
         });
}

template <class Real>
std::uint32_t Wave<Real>::resume(std::uint32_t rays, std::uint32_t bounce) {
    if (!plan.needs().branches) return rays;
    return call({resume_info, bounce, {}, 0, 0},
                [rays](const auto& s, auto& q) {
                    return only({0, s.resume(q.slots, q.branches, rays, q.rays, q.live)});
                })
        .run[0]
        .count;
}

template struct Wave<float>;
template struct Wave<double>;

}  // namespace orrery
