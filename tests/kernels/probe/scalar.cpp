#include "probe/instantiate.hpp"

namespace orrery::kernel_tests {
extern const LaneProbe scalar_probe;
constinit const LaneProbe scalar_probe = make_probe<kernels::ScalarLanes<float>>();
}  // namespace orrery::kernel_tests
