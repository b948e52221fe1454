#include "probe/instantiate.hpp"

namespace orrery::kernel_tests {
extern const LaneProbe<float> sse2_probe;
extern const LaneProbe<double> sse2_probe_double;
constinit const LaneProbe<float> sse2_probe = make_probe<kernels::SimdLanes<xsimd::sse2, float>>();
constinit const LaneProbe<double> sse2_probe_double = make_probe<kernels::SimdLanes<xsimd::sse2, double>>();
}  // namespace orrery::kernel_tests
