// What the command line says instead of the scene file.
#pragma once

#include <cstdint>
#include <optional>

#include "scene/scene.hpp"

namespace orrery {

struct ImageSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// What is empty, the scene decides.
struct Overrides {
    std::optional<Integrator> integrator;
    std::optional<ImageSize> size;  ///< the image's; the camera keeps the aspect the scene gives it
    std::optional<std::uint32_t> samples;
    std::optional<std::uint32_t> depth;
    std::optional<std::uint32_t> seed;
    std::optional<Estimator> estimator;
    std::optional<Transport> transport;
    std::optional<LightSampling> light_sampling;
    std::optional<LightChoice> light_choice;
    std::optional<bool> roulette;
    std::optional<std::uint32_t> roulette_from;
    std::optional<ToneMap> tonemap;
    std::optional<Precision> precision;
};

/// Throws UsageError where the settings together are none a scene file could hold: more pixels than there is memory
/// for, or a depth beyond what Whitted ray tracing takes.
void apply(const Overrides& overrides, RenderSettings& settings);

/// The settings' tone mapper; theirs to choose where neither scene nor command line did. A DEPTH image lies in [0, 1)
/// already and is left alone.
ToneMap tone_mapper(const RenderSettings& settings);

}  // namespace orrery
