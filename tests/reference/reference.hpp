// The truth the program is tested against: a scalar renderer in double precision, written from the specification alone.
//
// It shares no mathematics with the kernels and prefers the definition to the clever form: paths find area lights by
// running into them, rough lobes are sampled by rejection, nothing is stratified, nothing is killed by roulette.
// Settings that change no expectation (estimator, transport, light sampling, roulette, tone map, seed) are ignored.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"
#include "statistics/blocks.hpp"

namespace orrery::reference {

struct Options {
    std::uint64_t seed = 1;
    std::uint32_t samples = 0;     ///< per pixel, >= 2 (a standard error needs them); 0: what the scene says
    std::uint32_t block_size = 1;  ///< pixels per side of a block; the image need not divide into whole blocks
    /// PT: at diffuse vertices find area lights by a uniform point of their surface (equation (1) of the assignment)
    /// instead of by running into them. Same expectation, small lights converge; near a light the variance grows.
    bool next_event = false;
    /// PT: diffuse, glossy and translucent vertices receive the light of point lights over one smooth sphere.
    bool caustics = true;
    bool caustics_alone = false;  ///< and nothing else counts
    /// Such light is found by chance: so many directions per smooth sphere at every vertex, towards point lights that
    /// shine as spheres of this radius, in units of their distance from that smooth sphere. The mean is off by its
    /// fourth power (and where a sphere is nearer to the light than that), the variance grows with the inverse square.
    std::uint32_t caustic_directions = 1;
    double lamp_radius = 0.1;
    /// DEPTH: false leaves the mean distance I itself. 1 - I/(1+I) of a noisy mean is biased where distances within a
    /// pixel differ much; I never is.
    bool post_process = true;
    unsigned threads = 0;  ///< 0: all cores; changes nothing but the time
};

/// Linear radiance, or distance, of each block: mean, variance of the mean, degrees of freedom.
/// The variance at a point light seen by a glossy surface is an underestimate: its density is not square integrable.
/// Throws std::invalid_argument on fewer than two samples, std::domain_error on a sample that is not finite.
statistics::BlockImage render(const Scene& scene, const Options& options = {});

}  // namespace orrery::reference
