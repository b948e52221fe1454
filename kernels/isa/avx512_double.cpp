#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<double> avx512_stages_double;
using Lanes = SimdLanes<xsimd::avx512dq, double>;
constinit const Stages<double> avx512_stages_double = make_stages<Lanes, Lanes>(Isa::avx512);
}  // namespace orrery::kernels
