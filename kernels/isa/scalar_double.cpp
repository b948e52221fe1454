#include "kernels/instantiate.hpp"

namespace orrery::kernels {
extern const Stages<double> scalar_stages_double;
using Lanes = ScalarLanes<double>;
constinit const Stages<double> scalar_stages_double = make_stages<Lanes, Lanes>(Isa::scalar);
}  // namespace orrery::kernels
