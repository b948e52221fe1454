// What the machine allows: its clock under scalar and under vector load, and its fused multiply-adds per second.
//
// A chain of dependent operations of known latency is a clock: one cycle per addition of integers, four per fused
// multiply-add of 512 or 256 bits on Skylake and its descendants (Fog, "Instruction tables").
#include <fmt/format.h>

#include "bench/machine.hpp"

#include "bench/benchmarks.hpp"
#include "bench/timing.hpp"

#if defined(__x86_64__)
#include <immintrin.h>

namespace orrery::bench {

namespace {

/// Rounds per run: ten microseconds or so, so that an interruption spoils few runs.
constexpr int rounds = 8000;

void dependent_additions() {
    std::uint64_t n = 0;
    for (int i = 0; i < rounds; ++i) asm volatile("add $1, %0\n\tadd $1, %0\n\tadd $1, %0\n\tadd $1, %0" : "+r"(n));
}

static_assert(10 * rounds == independent_operations);

// A macro, as the instruction set is an attribute of the function that holds the instructions: clang takes vectors for
// operands of assembly nowhere else. Independent are ten chains, more than latency times ports.
#define ORRERY_MULTIPLY_ADDS(bits, isa)                                                                    \
    __attribute__((target(isa))) void dependent_##bits() {                                                 \
        __m##bits sum{}, factor{};                                                                         \
        for (int i = 0; i < rounds; ++i) asm volatile("vfmadd213ps %1, %1, %0" : "+v"(sum) : "v"(factor)); \
    }                                                                                                      \
    __attribute__((target(isa))) void ten_chains_##bits() {                                                \
        __m##bits a{}, b{}, c{}, d{}, e{}, f{}, g{}, h{}, j{}, k{}, factor{};                              \
        for (int i = 0; i < rounds; ++i)                                                                   \
            asm volatile(                                                                                  \
                "vfmadd213ps %10, %10, %0\n\tvfmadd213ps %10, %10, %1\n\tvfmadd213ps %10, %10, %2\n\t"     \
                "vfmadd213ps %10, %10, %3\n\tvfmadd213ps %10, %10, %4\n\tvfmadd213ps %10, %10, %5\n\t"     \
                "vfmadd213ps %10, %10, %6\n\tvfmadd213ps %10, %10, %7\n\tvfmadd213ps %10, %10, %8\n\t"     \
                "vfmadd213ps %10, %10, %9"                                                                 \
                : "+v"(a), "+v"(b), "+v"(c), "+v"(d), "+v"(e), "+v"(f), "+v"(g), "+v"(h), "+v"(j), "+v"(k) \
                : "v"(factor));                                                                            \
    }
ORRERY_MULTIPLY_ADDS(512, "avx512f")
ORRERY_MULTIPLY_ADDS(256, "avx2,fma")
#undef ORRERY_MULTIPLY_ADDS

void add(const std::string& name, void (*run)(), double operations) {
    benchmark::RegisterBenchmark(("machine/" + name).c_str(), [run, operations](benchmark::State& state) {
        time_passes(state, {{[] {}, run}}, operations);
        state.counters["Operations/s"] = state.counters["Rays/s"];
        state.counters.erase("Rays/s");
        state.counters.erase("cycles/ray");
    })->UseManualTime();
}

}  // namespace

void independent_512() { ten_chains_512(); }

void register_machine(const Options& options) {
    add("additions/dependent/x86-64", dependent_additions, 4 * rounds);
    for (const Isa isa : options.isas) {
        if (isa == Isa::avx2) {
            add("multiply-adds/dependent/avx2", dependent_256, rounds);
            add("multiply-adds/independent/avx2", ten_chains_256, independent_operations);
        }
        if (isa == Isa::avx512) {
            add("multiply-adds/dependent/avx512", dependent_512, rounds);
            add("multiply-adds/independent/avx512", ten_chains_512, independent_operations);
        }
    }
}

}  // namespace orrery::bench

#else

namespace orrery::bench {
void register_machine(const Options&) {}
}  // namespace orrery::bench

#endif
