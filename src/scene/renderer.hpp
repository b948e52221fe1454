// The `renderer` object: what to compute and where the image goes.
#pragma once

#include <filesystem>

#include "scene/fields.hpp"
#include "scene/scene.hpp"

namespace orrery {

/// Reads the settings. `folder` anchors a relative `output`.
RenderSettings read_renderer(const Node& renderer, const std::filesystem::path& folder, Report& report);

}  // namespace orrery
