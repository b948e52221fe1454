// A test that runs once per instruction set this machine has.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kernels/stages.hpp"

namespace orrery::kernel_tests {

inline std::vector<Isa> supported_isas() {
    std::vector<Isa> isas;
    for (const Isa isa : all_isas)
        if (isa_supported(isa)) isas.push_back(isa);
    return isas;
}

/// Those whose numbers can differ: the best, which every fused instruction set equals byte for byte (each stage's test
/// says so), and SSE2. What is tested at length, such as a distribution, is tested on these.
inline std::vector<Isa> differing_isas() {
    std::vector<Isa> isas{best_isa()};
    if (best_isa() != Isa::sse2 && isa_supported(Isa::sse2)) isas.push_back(Isa::sse2);
    return isas;
}

inline std::string name_of_isa(const ::testing::TestParamInfo<Isa>& info) { return std::string(isa_name(info.param)); }

class KernelTest : public ::testing::TestWithParam<Isa> {
protected:
    const kernels::Stages<float>& stages = kernels::stages_for(GetParam());
    const kernels::Stages<float>& scalar = kernels::stages_for(Isa::scalar);
    /// Whether this instruction set must give the scalar kernel's bytes. SSE2 has no fused multiply-add.
    bool exact() const { return GetParam() != Isa::sse2; }
};

/// None but the first is a multiple of a lane count; 125 ends within the last vector of every instruction set.
inline const std::vector<std::uint32_t> awkward_counts{0, 1, 3, 15, 16, 17, 125};

}  // namespace orrery::kernel_tests
