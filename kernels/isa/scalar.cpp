#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<float> scalar_stages;
constinit const Stages<float> scalar_stages = make_stages<ScalarLanes<float>, ScalarLanes<float>>(Isa::scalar);
}  // namespace orrery::kernels
