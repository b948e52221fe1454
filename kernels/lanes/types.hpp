// Which vector types a kernel works on.
//
// A kernel is a template on a `Lanes` type V and says V::F, V::U, V::M for a vector of numbers, of unsigned words of
// the same width, and of truth values. With `ScalarLanes` the same source is ordinary scalar code.
#pragma once

#include <xsimd/xsimd.hpp>

#include "kernels/common.hpp"

namespace orrery::kernels {

template <class ArchT, class RealT>
struct SimdLanes {
    using Arch = ArchT;
    using Real = RealT;
    using Word = WordOf<Real>;
    using F = xsimd::batch<Real, Arch>;
    using U = xsimd::batch<Word, Arch>;
    using M = xsimd::batch_bool<Real, Arch>;
    static constexpr std::uint32_t count = static_cast<std::uint32_t>(F::size);
};

template <class RealT>
struct ScalarLanes {
    using Real = RealT;
    using Word = WordOf<Real>;
    using F = Real;
    using U = Word;
    using M = bool;
    static constexpr std::uint32_t count = 1;
};

// What kernels say for short.
template <class V>
using RealOf = typename V::Real;
template <class V>
using Floats = typename V::F;
template <class V>
using Words = typename V::U;
template <class V>
using Mask = typename V::M;

}  // namespace orrery::kernels
