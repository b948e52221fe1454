#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<float> avx512_stages;
constinit const Stages<float> avx512_stages = make_stages<SimdLanes<xsimd::avx512dq, float>>(Isa::avx512);
}  // namespace orrery::kernels
