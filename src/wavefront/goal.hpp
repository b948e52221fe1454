// When a render that has no fixed number of samples may stop.
#pragma once

#include <cstdint>

namespace orrery {

/// Work goes on until the first of what is asked is there.
struct Goal {
    double error = 0;           ///< relative error of the image, as estimated; 0: not asked
    double seconds = 0;         ///< what fits into this; 0: not asked
    std::uint64_t samples = 0;  ///< per pixel on average; 0: no ceiling
    bool adaptive = true;       ///< samples go where the error is, tile by tile; else all pixels get as many

    bool asked() const { return error > 0 || seconds > 0; }
};

enum class StopReason : std::uint8_t { samples, error, time };

}  // namespace orrery
