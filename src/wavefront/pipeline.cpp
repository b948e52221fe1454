#include "wavefront/pipeline.hpp"

#include <chrono>
#include <limits>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace orrery {

std::uint64_t tick_count() {
#if defined(__x86_64__)
    return __rdtsc();
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

Profile profile_of(const TicksByBounce& ticks, double seconds_per_tick) {
    Profile profile;
    for (std::size_t b = 0; b < profile_bounces; ++b)
        for (std::size_t s = 0; s < stage_names.size(); ++s) {
            const StageTicks& from = ticks[b][s];
            profile.bounces[b][s] = {static_cast<double>(from.ticks) * seconds_per_tick, from.rays, from.lanes,
                                     from.filled, from.bytes};
        }
    return profile;
}

template <class Real>
Pipeline<Real>::Pipeline(const Plan& plan, const Table& stages) {
    const Needs& needs = plan.needs();
    const RenderSettings& settings = plan.settings();
    generate = needs.lens ? &Table::generate_lens : &Table::generate_pinhole;
    intersect = needs.tree ? &Table::intersect_tree : needs.packets ? &Table::intersect_coherent : &Table::intersect;
    shadow = needs.tree ? &Table::shadow_tree : needs.packets ? &Table::shadow_coherent : &Table::shadow;
    unblocked = needs.tree ? &Table::unblocked_tree : needs.packets ? &Table::unblocked_coherent : &Table::unblocked;
    strategy = static_cast<kernels::LightStrategy>(settings.light_sampling);  // the same words in the same order
    emission = needs.emitters || needs.background;
    sphere_step = needs.tree ? 0 : stages.sphere_step;
    for (std::uint32_t k = 0; k < kernels::scattering_count; ++k) {
        const auto kind = static_cast<kernels::Scattering>(k);
        if (needs.scatters(kind)) kinds.push_back(kind);
        if (((needs.connect_point | needs.connect_area) & kernels::bit_of(kind)) != 0) lit.push_back(kind);
    }
    roulette_from = needs.roulette ? settings.roulette_from : std::numeric_limits<std::uint32_t>::max();
}
template struct Pipeline<float>;
template struct Pipeline<double>;

}  // namespace orrery
