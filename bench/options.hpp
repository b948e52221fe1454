// What `orrery_bench` was asked for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernels/isa.hpp"

namespace orrery::bench {

struct Options {
    std::vector<Isa> isas;         ///< those to measure, supported ones
    std::filesystem::path scenes;  ///< the repository's scene folder
    bool smoke = false;            ///< everything once, as small as it goes: does it still run, is it still right?
    /// Scenes of that folder, without ".json".
    std::vector<std::string> scene_names = {"assignment_01",     "assignment_04", "assignment_08", "showcase",
                                            "bench/point_light", "bench/like_46", "bench/like_484"};
    /// Spheres of the random scenes.
    std::vector<std::uint32_t> random_counts = {8, 64, 1024, 65536, 1048576};
    std::uint32_t waves = 8;  ///< recorded per scene; more rays than branch predictors remember
};

}  // namespace orrery::bench
