#include "kernels/isa.hpp"

#include <stdexcept>

#include "kernels/stages.hpp"

namespace orrery {

namespace {
constexpr std::array<std::string_view, 4> names = {"scalar", "sse2", "avx2", "avx512"};
}

std::string_view isa_name(Isa isa) {
    const auto i = static_cast<std::size_t>(isa);
    return i < names.size() ? names[i] : "an instruction set that does not exist";
}

std::optional<Isa> isa_from_name(std::string_view name) {
    for (const Isa isa : all_isas)
        if (isa_name(isa) == name) return isa;
    return std::nullopt;
}

// The build names each file's features once, for the compiler's options and for this question; it asks whether the
// operating system saves the registers, too.
#define ORRERY_HAS(feature) __builtin_cpu_supports(#feature)

bool isa_supported(Isa isa) {
    switch (isa) {
        case Isa::scalar:
            return true;
#if ORRERY_X86
        case Isa::sse2:
            return true;
        case Isa::avx2:
            return ORRERY_AVX2_NEEDS;
        case Isa::avx512:
            return ORRERY_AVX512_NEEDS;
#endif
        default:
            return false;
    }
}

Isa best_isa() {
    Isa best = Isa::scalar;
    for (const Isa isa : all_isas)
        if (isa_supported(isa)) best = isa;
    return best;
}

namespace kernels {

extern const Stages<float> scalar_stages;
extern const Stages<double> scalar_stages_double;
#if ORRERY_X86
extern const Stages<float> sse2_stages, avx2_stages, avx512_stages;
extern const Stages<double> sse2_stages_double, avx2_stages_double, avx512_stages_double;
#endif

template <>
const Stages<float>& stages_for(Isa isa) {
    switch (isa) {
#if ORRERY_X86
        case Isa::sse2:
            return sse2_stages;
        case Isa::avx2:
            return avx2_stages;
        case Isa::avx512:
            return avx512_stages;
#endif
        default:
            return scalar_stages;
    }
}

template <>
const Stages<double>& stages_for(Isa isa) {
    switch (isa) {
#if ORRERY_X86
        case Isa::sse2:
            return sse2_stages_double;
        case Isa::avx2:
            return avx2_stages_double;
        case Isa::avx512:
            return avx512_stages_double;
#endif
        default:
            return scalar_stages_double;
    }
}

}  // namespace kernels
}  // namespace orrery
