// The truth, as far as it is known: an image of many more samples than any that is measured against it.
#pragma once

#include <filesystem>

#include "image/image.hpp"
#include "scene/scene.hpp"

namespace orrery::tradeoff {

struct Reference {
    Image image;
    double mrse = 0;          ///< its own, from the scatter of the renders it is the mean of
    double mrse_error = 0;    ///< how far the squared error really made may be from that
    double samples = 0;       ///< per pixel, over all of these renders
    double seconds = 0;       ///< of processor time
    bool from_cache = false;  ///< `seconds` are then those of the run that made it
};

/// Four renders with these settings in double and strata x strata samples each, with seeds that nothing else uses.
Reference make_reference(const Scene& scene, const RenderSettings& settings, std::uint32_t strata);

/// As above in about so many seconds of processor time, kept in `folder` under a name that depends on the scene's text
/// and the settings: what an earlier run made there in half as many seconds or more is taken.
Reference cached_reference(const Scene& scene, const RenderSettings& settings, double processor_seconds,
                           const std::filesystem::path& folder);

}  // namespace orrery::tradeoff
