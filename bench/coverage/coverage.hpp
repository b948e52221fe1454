// How often an image's stated interval holds the error it was made with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "wavefront/goal.hpp"

namespace orrery::coverage {

/// One way to render one scene.
struct Case {
    std::string scene;
    std::uint32_t side = 48;  ///< pixels along either side
    Estimator estimator = Estimator::stratified;
    std::uint32_t samples = 64;  ///< per pixel, where no goal is asked
    Goal goal = {};

    /// "64 samples", "--error 2% --adaptive off".
    std::string way() const;
};

/// Many renders of a case, each with a seed of its own.
struct Row {
    Case tried;
    std::uint32_t renders = 0;
    double samples = 0;                              ///< per pixel, the mean over renders
    double made = 0;                                 ///< relative error, root of the mean square over renders
    double stated = 0;                               ///< the same of the estimates
    double width = 0;                                ///< mean of high / value of those that have an upper end
    std::uint32_t inside = 0, above = 0, below = 0;  ///< where the error made lies; renders
    std::uint32_t open = 0;                          ///< of those inside, without an upper end: "at least"
};

/// The truth an image is measured against is the mean of all the others. It has an error of its own, about
/// 1 / sqrt(renders) of theirs, that is independent of the image: its expected square, estimated from the scatter of
/// the others, is subtracted. No image of many samples is needed, and none could be wrong.
Row measure(const Scene& scene, const Case& tried, std::uint32_t renders);

/// The scenes, samples, estimators, ways to stop and sizes of the page. `scenes`: those wanted.
std::vector<Case> all_cases(const std::vector<std::string>& scenes);

}  // namespace orrery::coverage
