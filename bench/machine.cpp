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

template <class Vector>
void dependent_multiply_adds() {
    Vector sum{}, factor{};
    for (int i = 0; i < rounds; ++i) asm volatile("vfmadd213ps %1, %1, %0" : "+v"(sum) : "v"(factor));
}

static_assert(10 * rounds == independent_operations);

/// Ten chains: more than latency times ports.
template <class Vector>
void independent_multiply_adds() {
    Vector a{}, b{}, c{}, d{}, e{}, f{}, g{}, h{}, j{}, k{}, factor{};
    for (int i = 0; i < rounds; ++i)
        asm volatile(
            "vfmadd213ps %10, %10, %0\n\tvfmadd213ps %10, %10, %1\n\tvfmadd213ps %10, %10, %2\n\t"
            "vfmadd213ps %10, %10, %3\n\tvfmadd213ps %10, %10, %4\n\tvfmadd213ps %10, %10, %5\n\t"
            "vfmadd213ps %10, %10, %6\n\tvfmadd213ps %10, %10, %7\n\tvfmadd213ps %10, %10, %8\n\t"
            "vfmadd213ps %10, %10, %9"
            : "+v"(a), "+v"(b), "+v"(c), "+v"(d), "+v"(e), "+v"(f), "+v"(g), "+v"(h), "+v"(j), "+v"(k)
            : "v"(factor));
}

// Instantiated where the instruction set is known to the compiler.
__attribute__((target("avx512f"), flatten)) void dependent_512() { dependent_multiply_adds<__m512>(); }
__attribute__((target("avx2,fma"), flatten)) void dependent_256() { dependent_multiply_adds<__m256>(); }
__attribute__((target("avx2,fma"), flatten)) void independent_256() { independent_multiply_adds<__m256>(); }

void add(const std::string& name, void (*run)(), double operations) {
    benchmark::RegisterBenchmark(("machine/" + name).c_str(), [run, operations](benchmark::State& state) {
        time_passes(state, {{[] {}, run}}, operations);
        state.counters["Operations/s"] = state.counters["Rays/s"];
        state.counters.erase("Rays/s");
        state.counters.erase("cycles/ray");
    })->UseManualTime();
}

}  // namespace

__attribute__((target("avx512f"), flatten)) void independent_512() { independent_multiply_adds<__m512>(); }

void register_machine(const Options& options) {
    add("additions/dependent/x86-64", dependent_additions, 4 * rounds);
    for (const Isa isa : options.isas) {
        if (isa == Isa::avx2) {
            add("multiply-adds/dependent/avx2", dependent_256, rounds);
            add("multiply-adds/independent/avx2", independent_256, independent_operations);
        }
        if (isa == Isa::avx512) {
            add("multiply-adds/dependent/avx512", dependent_512, rounds);
            add("multiply-adds/independent/avx512", independent_512, independent_operations);
        }
    }
}

}  // namespace orrery::bench

#else

namespace orrery::bench {
void register_machine(const Options&) {}
}  // namespace orrery::bench

#endif
