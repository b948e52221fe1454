#include "wavefront/wave.hpp"

namespace orrery {

Profile profile_of(const WaveCounters& counters, double seconds_per_tick) {
    Profile profile;
    for (std::size_t b = 0; b < profile_bounces; ++b) {
        for (std::size_t s = 0; s < stage_names.size(); ++s) {
            const StageTicks& from = counters.bounces[b][s];
            profile.bounces[b][s] = {static_cast<double>(from.ticks) * seconds_per_tick, from.rays, from.lanes,
                                     from.filled, from.bytes};
        }
    }
    return profile;
}

}  // namespace orrery
