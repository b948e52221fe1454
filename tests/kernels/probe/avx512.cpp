#include "probe/instantiate.hpp"

namespace orrery::kernel_tests {
extern const LaneProbe avx512_probe;
constinit const LaneProbe avx512_probe = make_probe<kernels::SimdLanes<xsimd::avx512dq, float>>();
}  // namespace orrery::kernel_tests
