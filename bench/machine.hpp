// Loops that do nothing but keep the vector ports busy.
#pragma once

#if defined(__x86_64__)
namespace orrery::bench {

/// Independent fused multiply-adds of 512 bits, so many that every port that has one is always busy. Needs AVX-512.
void independent_512();
inline constexpr double independent_operations = 80000;

}  // namespace orrery::bench
#endif
