// `orrery_bench`: Google Benchmark's options and a few of its own. Exit status 1 when any result was wrong, 2 where the
// command line asks for nothing there is.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "bench/benchmarks.hpp"
#include "bench/embree_scene.hpp"
#include "bench/results.hpp"
#include "bench/timing.hpp"
#include "scene/counted.hpp"

using namespace orrery;

int main(int argc, char** argv) {
    bench::Options options;
    std::vector<std::string> isas;
    benchmark::Initialize(&argc, argv);
    CLI::App app("Benchmarks of orrery. Takes Google Benchmark's --benchmark_... options as well.");
    app.add_option("--isa", isas, "scalar, sse2, avx2, avx512; all vector ones this machine has if left out")
        ->delimiter(',');
    app.add_option("--scenes", options.scenes, "the folder of scenes")->capture_default_str();
    app.add_option("--spheres", options.random_counts, "of the random scenes")->delimiter(',')->capture_default_str();
    app.add_flag("--smoke", options.smoke, "everything once, as small as it goes");
    options.scenes = ORRERY_SCENES;
    CLI11_PARSE(app, argc, argv);

    for (const std::string& name : isas) {
        const auto isa = isa_from_name(name);
        if (!isa || !isa_supported(*isa)) {
            fmt::print(stderr, "orrery_bench: this machine has no instruction set '{}'\n", name);
            return 2;
        }
        options.isas.push_back(*isa);
    }
    std::sort(options.isas.begin(), options.isas.end());
    // Scalar code is what the others are checked against; nobody runs it who has a choice.
    std::vector<Isa> all;
    for (const Isa isa : all_isas)
        if (isa_supported(isa) && (isa != Isa::scalar || best_isa() == isa)) all.push_back(isa);
    if (isas.empty()) options.isas = all;
    const std::string filter = benchmark::GetBenchmarkFilter();
    const bool whole = (filter.empty() || filter == "all") && options.isas == all && !options.smoke &&
                       app.count("--scenes") == 0 && app.count("--spheres") == 0;
    if (options.smoke) {
        options.waves = 1;
        options.random_counts = {8, 1024};
    }

    benchmark::AddCustomContext("processor", bench::processor_name());
    benchmark::AddCustomContext("embree", bench::embree_version());
    // The page of figures is made of such results alone.
    benchmark::AddCustomContext("whole", whole ? "yes" : "no");
    try {
        bench::Worlds worlds(options);
        bench::register_machine(options);
        bench::register_linear(options, worlds);
        bench::register_stages(options, worlds);
        bench::register_renders(options, worlds);
        bench::register_peers(options, worlds);
        bench::register_builds(options, worlds);
        if (benchmark::RunSpecifiedBenchmarks() == 0) {
            fmt::print(stderr, "orrery_bench: no benchmark's name matches '{}'; --benchmark_list_tests lists them\n",
                       filter);
            return 2;
        }
    } catch (const std::exception& fault) {
        fmt::print(stderr, "orrery_bench: {}\n", fault.what());
        return 1;
    }
    if (bench::failures() == 0) return 0;
    fmt::print(stderr, "orrery_bench: {} computed something wrong\n",
               counted(static_cast<unsigned>(bench::failures()), "benchmark"));
    return 1;
}
