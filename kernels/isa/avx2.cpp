#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<float> avx2_stages;
constinit const Stages<float> avx2_stages = make_stages<SimdLanes<xsimd::fma3<xsimd::avx2>, float>>(Isa::avx2);
}  // namespace orrery::kernels
