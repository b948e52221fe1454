// `orrery_bench_report RESULTS.json FOLDER`: the tables of FOLDER/README.md, the plots beside it and the table of all
// figures, FOLDER/results/CPU.csv. They stay as they are where RESULTS.json is not of a whole run.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "bench/report/files.hpp"
#include "bench/report/page.hpp"

namespace fs = std::filesystem;
using namespace orrery;
using namespace orrery::bench;

int main(int argc, char** argv) {
    if (argc != 3) {
        fmt::print(stderr, "usage: orrery_bench_report RESULTS.json FOLDER\n");
        return 2;
    }
    try {
        const fs::path folder = argv[2];
        const Results results = read_results(text_of(argv[1]));
        if (!results.whole) {
            fmt::print(stderr, "Not a run of everything: {} and its plots stay as they are; the figures are in {}\n",
                       (folder / "README.md").string(), argv[1]);
            return EXIT_SUCCESS;
        }
        const std::string page = with_blocks(text_of(folder / "README.md"), blocks_of(results));
        for (const auto& [name, svg] : plots_of(results)) write_text(folder / "plots" / name, svg);
        write_text(folder / "results" / (file_name_of(results.cpu) + ".csv"), csv_of(results));
        write_text(folder / "README.md", page);
    } catch (const std::exception& fault) {
        fmt::print(stderr, "orrery_bench_report: {}\n", fault.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
