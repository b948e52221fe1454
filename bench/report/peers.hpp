// Ours beside the best of Embree's ways, queue by queue.
#pragma once

#include <vector>

#include "bench/report/rows.hpp"

namespace orrery::bench {

struct PeerMatch {
    std::string scene, queue;
    double spheres = 0;
    const Row* ours = nullptr;    ///< with the last instruction set measured: they come worst first
    const Row* embree = nullptr;  ///< the best of its ways; nullptr where Embree was not there
};

/// In the order of the run. The rows are the results'.
std::vector<PeerMatch> peer_matches(const Results& results);

}  // namespace orrery::bench
