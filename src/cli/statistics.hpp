// What a render took, as JSON: the place for all that an image must not carry.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "wavefront/render.hpp"

namespace orrery {

/// `--stats`: an object with a newline at its end. `images` are the files written.
std::string statistics_json(const Plan& plan, const Goal& goal, const RenderStats& stats,
                            const std::vector<std::filesystem::path>& images);

/// Closest and shadow rays together, over the wall time.
double rays_per_second(const RenderStats& stats);

}  // namespace orrery
