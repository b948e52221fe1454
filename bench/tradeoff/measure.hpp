// Many short independent renders, and what they were wrong by.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/tradeoff/reference.hpp"
#include "bench/tradeoff/variants.hpp"

namespace orrery::tradeoff {

/// Reads a scene. Throws std::runtime_error with all its faults.
Scene scene_of(const std::filesystem::path& file);

/// One render.
struct Shot {
    Image image;
    double seconds = 0;  ///< of processor time, all threads together: other processes' turns do not count
    double samples = 0;  ///< per pixel, really taken
};

/// Renders with strata x strata samples per pixel on all threads; of Sobol's sequences with the next power of two.
Shot take(const Scene& scene, const Setup& setup, std::uint32_t strata, std::uint32_t seed);

/// How many strata, >= 1, take about so many seconds of processor time.
std::uint32_t strata_for(const Scene& scene, const Setup& setup, double processor_seconds);

/// All renders of one variant with one number of samples.
struct Level {
    std::uint32_t strata = 1;       ///< strata^2 samples are asked for, or the power of two that is nearest
    double samples = 0;             ///< taken, per pixel
    std::vector<double> mrse = {};  ///< by render, against the reference; its own error not yet subtracted
    std::vector<double> seconds = {};
    /// Sums of the images' relative differences to the reference, and of their squares: [3 * pixel + channel].
    std::vector<double> differences = {}, squares = {};
};

/// One variant of one scene.
struct Cell {
    std::size_t scene = 0;  ///< index into the subjects
    Variant variant;
    Setup setup;
    std::vector<Level> levels;  ///< fewest samples first
};

struct Subject {
    std::string name;
    Scene scene;
    RenderSettings usual;
    Reference reference;
};

/// The cells of a subject: variants whose image is, byte for byte, that of one before them are left out, because the
/// option has no effect there. Levels end at about `processor_seconds` per render and have four times the samples each.
std::vector<Cell> cells_of(const Subject& subject, std::size_t index, double processor_seconds);

/// Levels with up to `last` strata, halved from one to the next.
std::vector<Level> levels_up_to(std::uint32_t last);

/// One render of each level. Every round and level has a seed of its own, the same for all variants.
void measure_round(const Subject& subject, Cell& cell, std::uint32_t round);

}  // namespace orrery::tradeoff
