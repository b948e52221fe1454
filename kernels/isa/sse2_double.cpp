#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<double> sse2_stages_double;
using Lanes = SimdLanes<xsimd::sse2, double>;
constinit const Stages<double> sse2_stages_double = make_stages<Lanes, Lanes>(Isa::sse2);
}  // namespace orrery::kernels
