// Where a render's time goes: what every stage did at every bounce.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace orrery {

/// The five stages, in the order a wave runs through them.
enum class Stage : std::uint8_t { generate, intersect, shade, shadow, roulette };
inline constexpr std::array<const char*, 5> stage_names = {"generate", "intersect", "shade", "shadow", "roulette"};

/// Bounces told apart; the last holds all further ones. Whitted: passes of a wave.
inline constexpr std::size_t profile_bounces = 16;

/// What one stage did at one bounce, summed over waves and threads.
struct StageCost {
    double seconds = 0;        ///< of the threads, not of the clock on the wall
    std::uint64_t rays = 0;    ///< that entered it; in `shade` those that met a surface, and unsorted waves' misses
    std::uint64_t lanes = 0;   ///< its vectors had, over all its steps; 0 where they hold spheres instead of rays
    std::uint64_t filled = 0;  ///< of those lanes: with a ray in them, be it one that missed
    std::uint64_t bytes = 0;   ///< of the queues' columns, read and written

    void add(const StageCost& other) {
        seconds += other.seconds;
        rays += other.rays;
        lanes += other.lanes;
        filled += other.filled;
        bytes += other.bytes;
    }
};

struct Profile {
    std::array<std::array<StageCost, stage_names.size()>, profile_bounces> bounces{};  ///< [bounce][Stage]
    /// The threads' time outside all stages: filling waves, adding to the film, waiting for the last tile.
    double others = 0;

    const StageCost& at(std::size_t bounce, Stage stage) const {
        return bounces[bounce][static_cast<std::size_t>(stage)];
    }
    StageCost total(Stage stage) const {
        StageCost sum;
        for (const auto& bounce : bounces) sum.add(bounce[static_cast<std::size_t>(stage)]);
        return sum;
    }
    void add(const Profile& other) {
        for (std::size_t b = 0; b < bounces.size(); ++b)
            for (std::size_t s = 0; s < stage_names.size(); ++s) bounces[b][s].add(other.bounces[b][s]);
        others += other.others;
    }
};

}  // namespace orrery
