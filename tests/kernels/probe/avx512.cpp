#include "probe/instantiate.hpp"

namespace orrery::kernel_tests {
extern const LaneProbe<float> avx512_probe;
extern const LaneProbe<double> avx512_probe_double;
constinit const LaneProbe<float> avx512_probe = make_probe<kernels::SimdLanes<xsimd::avx512dq, float>>();
constinit const LaneProbe<double> avx512_probe_double = make_probe<kernels::SimdLanes<xsimd::avx512dq, double>>();
}  // namespace orrery::kernel_tests
