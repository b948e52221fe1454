#include "probe/lane_probe.hpp"

namespace orrery::kernel_tests {

extern const LaneProbe scalar_probe;
#if ORRERY_X86
extern const LaneProbe sse2_probe, avx2_probe, avx512_probe;
#endif

const LaneProbe& lane_probe(Isa isa) {
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

}  // namespace orrery::kernel_tests
