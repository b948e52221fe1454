// The steps of a wave that find lights over smooth and glossy spheres.
#include "wavefront/wave_call.hpp"

namespace orrery {

using kernels::Range;
using kernels::Runs;
using kernels::Scattering;

namespace {

constexpr StageInfo pick_info{"pick", Stage::shade, slot_part | ray_part, pick_part, true};
constexpr StageInfo caustic_info{"caustic", Stage::shade, slot_part | ray_part | lobe_part | pick_part, shadow_part,
                                 true};
constexpr StageInfo unblocked_info{"unblocked", Stage::shadow, shadow_part, shadow_part};
constexpr StageInfo follow_info{"follow", Stage::shade, slot_part | shadow_part, shadow_part, true};

}  // namespace

template <class Real>
void Wave<Real>::caustics(const Runs& runs, std::uint32_t bounce) {
    if (!plan.needs().caustics || bounce + 2 > plan.settings().depth) return;
    for (const Scattering kind : pipeline.lit) {
        const Range vertices = runs.run[static_cast<std::size_t>(kind)];
        if (vertices.count == 0) continue;
        const kernels::ScatteringTraits& traits = kernels::traits_of(kind);
        proceed(vertices.count);
        const std::uint32_t picked =
            call({pick_info, bounce, vertices, words<Real>(3 + 1), stages.lanes, traits.name},
                 [context = caustics_on(*this, bounce), response = static_cast<std::size_t>(traits.response), vertices](
                     const auto& s, auto& q) {
                     return only({0, s.pick_caustics[response](context(q), vertices, q.rays, q.picks)});
                 })
                .run[0]
                .count;
        if (picked == 0) continue;
        for (std::uint32_t c = 0; c < tables.caustics.count; ++c)
            if (bounce + tables.caustics.entries[c].chords + 2 <= plan.settings().depth)
                caustic(traits.response, c, picked, bounce);
    }
}

/// The vertices that picked one caustic; and what of that arrives.
template <class Real>
void Wave<Real>::caustic(kernels::Response response, std::uint32_t which, std::uint32_t picked, std::uint32_t bounce) {
    const auto& way = tables.caustics.entries[which];
    std::uint32_t rays =
        call({caustic_info, bounce, {0, picked}, words<Real>(3), stages.lanes, way.roughness > 0 ? "glossy" : ""},
             [context = caustics_on(*this, bounce), response, which, picked](const auto& s, auto& q) {
                 const auto stage = s.connect_caustic[static_cast<std::size_t>(response)];
                 return only({0, stage(context(q), which, picked, q.rays, q.lobes, q.picks, q.shadows)});
             })
            .run[0]
            .count;
    const auto without_targets = [](const WaveStorage<Real>& q) {
        auto queue = q.shadows;
        queue.target = nullptr;
        return queue;
    };
    for (std::uint32_t event = 0; event <= way.chords && rays > 0; ++event) {
        if (event == 0 || way.obstructed) {
            counters.shadow_rays += rays;
            rays = call({unblocked_info, bounce, {0, rays}, record_bytes(storage.shadows), pipeline.sphere_step},
                        [&spheres = tables.spheres, stage = pipeline.unblocked, rays, ball = way.ball, without_targets](
                            const auto& s, auto& q) {
                            return only({0, (s.*stage)(spheres, without_targets(q), rays, ball)});
                        })
                       .run[0]
                       .count;
        }
        if (rays == 0) break;
        rays = call({follow_info, bounce, {0, rays}, 2 * words<Real>(7 + 1 + 3), stages.step},
                    [&spheres = tables.spheres, context = caustics_on(*this, bounce), &way, event, rays,
                     without_targets](const auto& s, auto& q) {
                        if (way.roughness > 0)
                            return only({0, s.follow_lobe(context(q), way, rays, without_targets(q))});
                        s.follow_caustic(spheres, way, event, q.shadows, rays);
                        return only({0, rays});
                    })
                   .run[0]
                   .count;
    }
    shadow(rays, way.lamp, bounce);
}

template <class Real>
void Wave<Real>::point_caustics(const Runs& runs, std::uint32_t bounce) {
    if (!plan.needs().point_caustics || bounce + 2 > plan.settings().depth) return;
    // So many vertices have shadow rays for all paths there may be.
    const std::uint32_t paths = 2 * kernels::most_point_chords + 1;
    const std::uint32_t at_once =
        (kernels::ray_capacity(storage.slot_count) - kernels::widest) / paths / kernels::widest * kernels::widest;
    for (const Scattering kind : pipeline.lit) {
        const Range vertices = runs.run[static_cast<std::size_t>(kind)];
        if (vertices.count == 0) continue;
        const auto response = static_cast<std::size_t>(kernels::traits_of(kind).response);
        const auto& lights = tables.lights((plan.needs().connect_area & kernels::bit_of(kind)) != 0);
        proceed(vertices.count);
        const std::uint32_t picked =
            call({pick_info, bounce, vertices, words<Real>(3 + 1 + 3 + 2), stages.step, "points"},
                 [context = caustics_on(*this, bounce, lights), response, vertices](const auto& s, auto& q) {
                     return only({0, s.pick_point_caustics[response](context(q), vertices, q.rays, q.picks)});
                 })
                .run[0]
                .count;
        for (std::uint32_t first = 0; first < picked; first += at_once) {
            const Range some{first, std::min(at_once, picked - first)};
            if (lights.cells != 0) {
                point_caustic(response, lights, some, kernels::chosen_light, bounce);
            } else {
                for (std::uint32_t l = 0; l < lights.points; ++l) point_caustic(response, lights, some, l, bounce);
            }
        }
    }
}

/// Picked vertices towards one point light, or each towards its choice.
template <class Real>
void Wave<Real>::point_caustic(std::size_t response, const kernels::LightTable<Real>& lights, Range picked,
                               std::uint32_t light, std::uint32_t bounce) {
    const auto context = caustics_on(*this, bounce, lights);
    for (std::uint32_t chords = 0; chords <= kernels::most_point_chords; ++chords) {
        if (bounce + chords + 2 > plan.settings().depth) break;
        proceed(picked.count);
        std::uint32_t rays =
            call({caustic_info, bounce, picked, words<Real>(3 + 3 + 3 + 1 + 3), stages.step, "points"},
                 [context, response, chords, light, picked](const auto& s, auto& q) {
                     return only({0, s.connect_point_caustic[response](context(q), chords, light, picked, q.rays,
                                                                       q.lobes, q.picks, q.shadows)});
                 })
                .run[0]
                .count;
        for (std::uint32_t event = 0; event <= chords && rays > 0; ++event) {
            if (event == 0 || tables.caustics.over_points.obstructed) {
                counters.shadow_rays += rays;
                rays = call({unblocked_info, bounce, {0, rays}, record_bytes(storage.shadows), pipeline.sphere_step},
                            [&spheres = tables.spheres, stage = pipeline.unblocked, rays](const auto& s, auto& q) {
                                return only({0, (s.*stage)(spheres, q.shadows, rays, kernels::no_sphere)});
                            })
                           .run[0]
                           .count;
            }
            call({follow_info, bounce, {0, rays}, 2 * words<Real>(7 + 1), stages.step, "points"},
                 [context, chords, light, event, rays](const auto& s, auto& q) {
                     s.follow_point_caustic(context(q), chords, light, event, q.shadows, rays);
                     return only({0, rays});
                 });
        }
        shadow(rays, kernels::no_sphere, bounce);
    }
}

template void Wave<float>::caustics(const Runs&, std::uint32_t);
template void Wave<double>::caustics(const Runs&, std::uint32_t);
template void Wave<float>::point_caustics(const kernels::Runs&, std::uint32_t);
template void Wave<double>::point_caustics(const kernels::Runs&, std::uint32_t);

}  // namespace orrery
