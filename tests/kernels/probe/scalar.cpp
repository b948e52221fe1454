#include "probe/instantiate.hpp"

namespace orrery::kernel_tests {
extern const LaneProbe<float> scalar_probe;
extern const LaneProbe<double> scalar_probe_double;
constinit const LaneProbe<float> scalar_probe = make_probe<kernels::ScalarLanes<float>>();
constinit const LaneProbe<double> scalar_probe_double = make_probe<kernels::ScalarLanes<double>>();
}  // namespace orrery::kernel_tests
