#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<float> sse2_stages;
constinit const Stages<float> sse2_stages = make_stages<SimdLanes<xsimd::sse2, float>>(Isa::sse2);
}  // namespace orrery::kernels
