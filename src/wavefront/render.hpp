// A scene to an image: the library's front door.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "film/error.hpp"
#include "film/film_state.hpp"
#include "kernels/isa.hpp"
#include "plan/plan.hpp"
#include "wavefront/goal.hpp"
#include "wavefront/profile.hpp"

namespace orrery {

class Ledger;

/// Of a larger wave one stage would take tenths of a second, and hear nothing meanwhile.
inline constexpr std::uint32_t largest_wave = 1u << 16;

/// How the film of a render is kept while it lasts.
struct KeepFilm {
    /// Saves it, with Ledger::write. Called by one thread at a time while others work, and once when all is done or an
    /// exception ends the render. Empty: never.
    std::function<void(const Ledger&)> save = {};
    double every = 60;      ///< seconds
    double most_share = 0;  ///< of the time that saving may take: longer than that apart; 0: no matter how long
};

struct RenderOptions {
    unsigned threads = 0;         ///< 0: all cores this process may use
    Isa isa = best_isa();         ///< must be supported by this machine, else std::invalid_argument
    std::uint32_t wave_size = 0;  ///< (pixel, sample) pairs per wave, 0: the measured default, or at most largest_wave;
                                  ///< changes no image
    /// Called now and then with the fraction done, in [0, 1]; from one thread at a time. May be empty.
    std::function<void(double fraction, std::uint64_t rays)> progress;
    /// Asked every few milliseconds, by several threads at once; true abandons the render, which then throws
    /// Interrupted. May be empty.
    std::function<bool()> interrupted;
    Goal goal = {};  ///< where it asks for something, samples are taken until that is there and not as the plan says
    /// Called between passes with the error so far, where there is a goal. May be empty.
    std::function<void(const ImageError&)> pass_done = {};
    bool standard_error = false;  ///< also the error of every pixel, as an image
    KeepFilm keep = {};
};

struct Interrupted {};

/// A goal of time that is too short for any image.
struct NothingInTime : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct RenderStats {
    Isa isa = Isa::sse2;  ///< the one that ran
    unsigned threads = 0;
    unsigned refused_threads = 0;  ///< by the system: so many more were wanted
    std::uint32_t wave_size = 0;
    double samples_per_pixel = 0;  ///< really taken (stratified rounds down to a square), the mean over pixels
    std::uint32_t least_samples = 0, most_samples = 0;  ///< of any pixel
    std::uint32_t passes = 1;
    StopReason stopped_by = StopReason::samples;
    double seconds = 0;              ///< wall time of the rendering proper
    std::uint64_t closest_rays = 0;  ///< counted where they are cast
    std::uint64_t shadow_rays = 0;
    Profile profile;
    std::uint64_t bytes_per_ray = 0;    ///< all queue storage per (pixel, sample) pair of a wave
    std::uint64_t queue_bytes = 0;      ///< all queue storage per thread
    std::uint64_t dropped_samples = 0;  ///< not finite, kept out of the film
    ImageError error;                   ///< of the image, as its samples tell; of a shard it is not known
};

struct RenderResult {
    Image image;           ///< linear radiance; for DEPTH the post-processed distance in [0, 1)
    Image standard_error;  ///< of `image`, where asked for, else empty; infinite where nothing tells
    RenderStats stats;
};

/// Renders with the settings of the scene the plan was made from. Deterministic: the same plan and goal give the same
/// bytes for any thread count and wave size, unless the goal is a time. A pass that has not ended when the time is up
/// is dropped as a whole: its slow tiles alone would be the bright ones. Throws std::invalid_argument on an unsupported
/// ISA or too large a wave, Interrupted as asked, NothingInTime where not even the first pass ends in time.
RenderResult render(const Plan& plan, const RenderOptions& options);

/// A film of which nothing is there, and for a number of samples, not a goal, all is asked of the shard.
std::unique_ptr<Ledger> begin_film(const Plan& plan, const Goal& goal, Shard shard = {});

/// The same on a film that was begun or read from a file: what it has is not done again, and the bytes are those of a
/// render that was never stopped. A pass that was under way is done whatever the goal now is. Of one of several shards
/// there is no image.
RenderResult render(const Plan& plan, const RenderOptions& options, Ledger& ledger);

}  // namespace orrery
