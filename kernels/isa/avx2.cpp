#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<float> avx2_stages;
using Avx2 = SimdLanes<xsimd::fma3<xsimd::avx2>, float>;
constinit const Stages<float> avx2_stages = make_stages<Avx2, TwinLanes<Avx2>, Avx2>(Isa::avx2);
}  // namespace orrery::kernels
