// What made an image, for the image file to say.
#pragma once

#include <string>
#include <string_view>

#include "image/image_file.hpp"
#include "plan/plan.hpp"

namespace orrery {

/// The options that, given to `orrery render`, make this image whatever the scene's renderer says and whatever the
/// defaults become. Only those that matter to it: a tone mapper to files that are tone mapped, light transport to path
/// tracing. In a fixed order, so that equal images carry equal text.
std::string canonical_options(const RenderSettings& settings, ImageFormat format);

/// Scene (the file's name, not the folders of somebody's machine), seed, samples, options and version. Nothing that
/// threads, waves, the machine or the clock decide: the same seed gives the same bytes.
/// `content` is what the pixels are, "radiance" where it goes without saying.
Metadata image_metadata(const Plan& plan, ImageFormat format, std::string_view content = "radiance");

}  // namespace orrery
