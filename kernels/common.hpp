// What data and kernels alike are built of, without any vector type.
#pragma once

#include <cstdint>
#include <type_traits>

/// Inlining that must happen: a helper compiled once per instruction set must never become a function the linker could
/// share between them.
#define ORRERY_INLINE [[gnu::always_inline]] inline

/// The same for a lambda, between its parameters and its body.
#define ORRERY_INLINE_LAMBDA __attribute__((always_inline))

namespace orrery::kernels {

/// The storage word as wide as a number: ids, slots and random bits live in these.
template <class Real>
using WordOf = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

}  // namespace orrery::kernels
