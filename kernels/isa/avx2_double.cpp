#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<double> avx2_stages_double;
using Lanes = SimdLanes<xsimd::fma3<xsimd::avx2>, double>;
constinit const Stages<double> avx2_stages_double = make_stages<Lanes, Lanes>(Isa::avx2);
}  // namespace orrery::kernels
