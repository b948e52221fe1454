// Instruction sets the kernels exist for, and which of them this machine has.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace orrery {

/// In order of preference, worst first.
enum class Isa : std::uint8_t { scalar, sse2, avx2, avx512 };
inline constexpr std::array<Isa, 4> all_isas = {Isa::scalar, Isa::sse2, Isa::avx2, Isa::avx512};

/// "scalar", "sse2", "avx2", "avx512".
std::string_view isa_name(Isa isa);
/// The inverse of isa_name; empty for anything else.
std::optional<Isa> isa_from_name(std::string_view name);
/// Whether the kernels for `isa` are built in and this machine runs them.
bool isa_supported(Isa isa);
/// The best supported one.
Isa best_isa();

}  // namespace orrery
