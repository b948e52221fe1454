#include "probe/instantiate.hpp"

namespace orrery::kernel_tests {
extern const LaneProbe avx2_probe;
constinit const LaneProbe avx2_probe = make_probe<kernels::SimdLanes<xsimd::fma3<xsimd::avx2>, float>>();
}  // namespace orrery::kernel_tests
