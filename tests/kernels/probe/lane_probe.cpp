#include "probe/lane_probe.hpp"

namespace orrery::kernel_tests {

extern const LaneProbe<float> scalar_probe;
extern const LaneProbe<double> scalar_probe_double;
#if ORRERY_X86
extern const LaneProbe<float> sse2_probe, avx2_probe, avx512_probe;
extern const LaneProbe<double> sse2_probe_double, avx2_probe_double, avx512_probe_double;
#endif

template <>
const LaneProbe<float>& lane_probe(Isa isa) {
    switch (isa) {
#if ORRERY_X86
        case Isa::sse2:
            return sse2_probe;
        case Isa::avx2:
            return avx2_probe;
        case Isa::avx512:
            return avx512_probe;
#endif
        default:
            return scalar_probe;
    }
}

template <>
const LaneProbe<double>& lane_probe(Isa isa) {
    switch (isa) {
#if ORRERY_X86
        case Isa::sse2:
            return sse2_probe_double;
        case Isa::avx2:
            return avx2_probe_double;
        case Isa::avx512:
            return avx512_probe_double;
#endif
        default:
            return scalar_probe_double;
    }
}

}  // namespace orrery::kernel_tests
