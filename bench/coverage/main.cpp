// `orrery_coverage`: how often the interval that a render states holds the error it was made with; bench/COVERAGE.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>

#include "bench/coverage/coverage.hpp"
#include "bench/report/files.hpp"
#include "bench/report/page.hpp"
#include "bench/tradeoff/measure.hpp"
#include "bench/tradeoff/output.hpp"

namespace fs = std::filesystem;
using namespace orrery;
using namespace orrery::coverage;

namespace {

struct Arguments {
    std::uint32_t renders = 100;
    fs::path scenes = "scenes", folder = "bench";
    std::vector<std::string> names = {"assignment_01", "assignment_02", "assignment_03", "assignment_04",
                                      "assignment_05", "assignment_08", "showcase",      "bench/lamp_behind_glass"};
};

void run(const Arguments& arguments) {
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
    const std::string setting = fmt::format("{} {} rows of {} renders in {:.0f} s.\n", tradeoff::machine_text(),
                                            rows.size(), arguments.renders, seconds());
    const fs::path page = arguments.folder / "COVERAGE.md";
    bench::write_text(
        page, bench::with_blocks(bench::text_of(page),
                                 {{"setting", setting}, {"groups", groups_of(rows)}, {"rows", table_of(rows)}}));
    bench::write_text(arguments.folder / "results" / "coverage.csv", csv_of(rows));
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Measures how often the interval that a render states holds the error it was made with.");
    app.add_option("--renders", arguments.renders, "Of every row; 100 unless told")->check(CLI::Range(3, 100000));
    app.add_option("--only", arguments.names, "Scenes, without .json")->delimiter(',');
    app.add_option("--scenes", arguments.scenes, "Folder of the scenes");
    app.add_option("--folder", arguments.folder, "Where COVERAGE.md is, and results go");
    CLI11_PARSE(app, argc, argv);
    try {
        run(arguments);
    } catch (const std::exception& fault) {
        fmt::print(stderr, "orrery_coverage: {}\n", fault.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
