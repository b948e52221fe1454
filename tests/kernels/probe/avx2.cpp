#include "probe/instantiate.hpp"

namespace orrery::kernel_tests {
extern const LaneProbe<float> avx2_probe;
extern const LaneProbe<double> avx2_probe_double;
constinit const LaneProbe<float> avx2_probe = make_probe<kernels::SimdLanes<xsimd::fma3<xsimd::avx2>, float>>();
constinit const LaneProbe<double> avx2_probe_double =
    make_probe<kernels::SimdLanes<xsimd::fma3<xsimd::avx2>, double>>();
}  // namespace orrery::kernel_tests
