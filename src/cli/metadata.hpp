// What made an image, for the image file to say.
#pragma once

#include <string>
#include <string_view>

#include "image/image_file.hpp"
#include "plan/plan.hpp"
#include "wavefront/goal.hpp"

namespace orrery {

/// The options that, given to `orrery render`, make this image whatever the scene's renderer says and whatever the
/// defaults become. Only those that matter to it: a tone mapper to files that are tone mapped, light transport to path
/// tracing. In a fixed order, so that equal images carry equal text.
std::string canonical_options(const RenderSettings& settings, const Goal& goal, ImageFormat format);

/// What a plan does not say about an image.
struct Making {
    Goal goal = {};
    double samples = 0;                     ///< per pixel, the mean; 0: the plan's
    std::string_view content = "radiance";  ///< what the pixels are; said where it is not this
};

/// Scene (the file's name, not the folders of somebody's machine), seed, samples, options and version. Nothing that
/// threads, waves, the machine or the clock decide: the same seed gives the same bytes.
/// The exception is a goal of time.
Metadata image_metadata(const Plan& plan, ImageFormat format, const Making& making = {});

}  // namespace orrery
