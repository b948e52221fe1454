// `orrery_coverage`: how often the interval that a render states holds the error it was made with; the results go to
// standard output, for bench/pages/coverage.py.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>

#include "bench/coverage/coverage.hpp"
#include "bench/results.hpp"
#include "bench/tradeoff/measure.hpp"
#include "scene/settings.hpp"

namespace fs = std::filesystem;
using namespace orrery;
using namespace orrery::coverage;

namespace {

struct Arguments {
    std::uint32_t renders = 100;
    fs::path scenes = "scenes";
    std::vector<std::string> names = {"assignment_01", "assignment_02", "assignment_03", "assignment_04",
                                      "assignment_05", "assignment_08", "showcase",      "bench/lamp_behind_glass"};
};

void run(const Arguments& arguments, bool whole) {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    std::vector<Row> rows;
    for (const Case& tried : all_cases(arguments.names)) {
        const Scene scene = tradeoff::scene_of(arguments.scenes / (tried.scene + ".json"));
        const Row& row = rows.emplace_back(measure(scene, tried, arguments.renders));
        fmt::print(stderr, "{:.0f} s: {} {} {} {}: {} of {} inside, made / stated {:.3f}\n", seconds(), tried.scene,
                   tried.side, static_cast<int>(tried.estimator), tried.way(), row.inside, row.renders,
                   row.made / row.stated);
    }
    bench::print_facts(whole, seconds());
    fmt::print("scene,side,estimator,way,renders,samples,made,stated,inside,above,below,at_least,width\n");
    for (const Row& row : rows) {
        RenderSettings settings;
        settings.estimator = row.tried.estimator;
        fmt::print("{},{},{},{},{},{:.4g},{:.5g},{:.5g},{},{},{},{},{:.4g}\n", row.tried.scene, row.tried.side,
                   text_of(setting("estimator"), settings), row.tried.way(), row.renders, row.samples, row.made,
                   row.stated, row.inside, row.above, row.below, row.open, row.width);
    }
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Measures how often the interval that a render states holds the error it was made with.");
    app.add_option("--renders", arguments.renders, "Of every row; 100 unless told")->check(CLI::Range(3, 100000));
    app.add_option("--only", arguments.names, "Scenes, without .json")->delimiter(',');
    app.add_option("--scenes", arguments.scenes, "Folder of the scenes");
    CLI11_PARSE(app, argc, argv);
    try {
        run(arguments, app.count("--only") == 0);
    } catch (const std::exception& fault) {
        fmt::print(stderr, "orrery_coverage: {}\n", fault.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
