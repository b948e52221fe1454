#pragma once

#include <string>

#include "wavefront/render.hpp"

namespace orrery {

/// The profile as lines of text: a row per stage and bounce that ran, sums per stage, "others" last, so that the
/// seconds add up to threads times wall time.
std::string profile_table(const RenderStats& stats);

}  // namespace orrery
