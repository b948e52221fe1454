// Which classes of paths make the error of an image.
#pragma once

#include <array>
#include <cstdint>

#include "scene/scene.hpp"

namespace orrery::tradeoff {

/// By the first vertex that is neither mirror nor glass, and by what brought the light there.
enum class PathClass : std::uint8_t {
    seen,            ///< lamps and background in sight, mirrored and through glass too
    direct,          ///< diffuse, then the light
    caustic,         ///< diffuse, mirrors or glass, then the light
    over_glossy,     ///< diffuse or several of them, a rough sphere, then the light
    later_caustic,   ///< diffuse, more of any kind, mirrors or glass, then the light
    indirect,        ///< diffuse, and all else
    rough_direct,    ///< glossy or translucent, then the light
    rough_indirect,  ///< glossy or translucent, and all else
};
inline constexpr std::array class_names = {"seen",          "direct",   "caustic",      "over glossy",
                                           "later caustic", "indirect", "rough direct", "rough indirect"};

/// Mean over pixels and channels of variance / (mean^2 + relative_floor), of one independent sample a pixel.
struct ClassErrors {
    double all = 0;
    std::array<double, class_names.size()> of{};  ///< their sum is not all: classes of one sample vary together
};

/// Renders the scene in float with `samples` independent samples a pixel, on one thread.
ClassErrors class_errors(const Scene& scene, const RenderSettings& settings, std::uint32_t samples);

}  // namespace orrery::tradeoff
