// What a render says about itself when it is done, in a line for people.
#pragma once

#include <string>

#include "plan/plan.hpp"
#include "wavefront/render.hpp"

namespace orrery {

/// "x.json: 512 x 512, 64 samples per pixel in 3.21 s, 80.1 Mrays/s (avx512, 2 threads), error 2.1 % (2.0 to 2.2)", and
/// where there was a goal, whether it was reached.
std::string summary(const Plan& plan, const Goal& goal, const RenderStats& stats);

}  // namespace orrery
