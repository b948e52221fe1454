#include "probe/instantiate.hpp"

namespace orrery::kernel_tests {
extern const LaneProbe sse2_probe;
constinit const LaneProbe sse2_probe = make_probe<kernels::SimdLanes<xsimd::sse2, float>>();
}  // namespace orrery::kernel_tests
