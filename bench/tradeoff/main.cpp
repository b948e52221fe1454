// `orrery_tradeoff`: what each option costs and buys, measured; the results go to standard output, for
// bench/pages/tradeoff.py.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <random>
#include <thread>
#include <tuple>

#include "bench/results.hpp"
#include "bench/tradeoff/classes.hpp"
#include "bench/tradeoff/summary.hpp"

namespace fs = std::filesystem;
using namespace orrery;
using namespace orrery::tradeoff;

namespace {

struct Arguments {
    double seconds = 540;
    bool quick = false, classes = false;
    double pixels = 64 * 64;
    fs::path scenes = "scenes", cache = "build/tradeoff";
    std::vector<std::string> names = {"assignment_01", "assignment_02",           "assignment_03",    "assignment_04",
                                      "assignment_05", "assignment_06",           "assignment_07",    "assignment_08",
                                      "showcase",      "bench/lamp_behind_glass", "bench/many_lights"};
};

/// Of the time: what the references get, and what goes by for finding out how fast everything is.
constexpr double reference_share = 0.2, pilot_share = 0.1;
constexpr double planned_rounds = 12;
constexpr std::uint32_t least_rounds = 3;

class Clock {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Subject read_subject(const std::string& name, const Arguments& arguments, double processor_seconds) {
    Subject subject{fs::path(name).filename().string(), scene_of(arguments.scenes / (name + ".json")), {}, {}};
    subject.usual = usual_settings(subject.scene.settings, arguments.pixels);
    subject.reference = cached_reference(subject.scene, subject.usual, processor_seconds, arguments.cache);
    fmt::print(stderr, "{}: reference of {:.0f} samples, {:.1f} s{}, its own error {:.2g} %\n", subject.name,
               subject.reference.samples, subject.reference.seconds, subject.reference.from_cache ? " (cached)" : "",
               100 * std::sqrt(subject.reference.mrse));
    return subject;
}

/// Rounds over all cells in random order, so that a busy minute of the machine is shared by all, until time is up.
void measure(const std::vector<Subject>& subjects, std::vector<Cell>& cells, const Clock& clock, double end) {
    std::vector<std::size_t> order(cells.size());
    std::iota(order.begin(), order.end(), 0);
    std::mt19937 shuffle(1);
    std::uint32_t round = 0;
    for (double last = 0; round < least_rounds || clock.seconds() + last < end; ++round) {
        const double start = clock.seconds();
        std::ranges::shuffle(order, shuffle);
        for (const std::size_t i : order) measure_round(subjects[cells[i].scene], cells[i], round);
        last = clock.seconds() - start;
        fmt::print(stderr, "round {} took {:.1f} s, {:.0f} of {:.0f} s are over\n", round + 1, last, clock.seconds(),
                   end);
    }
}

/// One line per level of each cell.
void print(const std::vector<Subject>& subjects, const std::vector<Cell>& cells) {
    fmt::print(
        "scene,options,samples,renders,seconds,seconds_error,mrse,mrse_error,slope,slope_error,floor,floor_error,"
        "reference_samples,reference_mrse\n");
    for (const Cell& cell : cells) {
        const Reference& reference = subjects[cell.scene].reference;
        const CellSummary summary = summarise(cell, reference);
        for (const LevelSummary& l : summary.levels)
            fmt::print("{},{},{:.6g},{},{:.4g},{:.2g},{:.5g},{:.2g},{:.4f},{:.4f},{:.3g},{:.2g},{:.0f},{:.3g}\n",
                       subjects[cell.scene].name, cell.variant.name(), l.samples, l.renders, l.seconds.value,
                       l.seconds.error, l.mrse.value, l.mrse.error, summary.slope.value, summary.slope.error,
                       summary.floor.value, summary.floor.error, reference.samples, reference.mrse);
    }
}

void run(const Arguments& arguments, bool whole) {
    const Clock clock;
    const double threads = std::max(1u, std::thread::hardware_concurrency());
    const double processor_seconds = arguments.seconds * threads;
    const double scenes = static_cast<double>(arguments.names.size());

    std::vector<Subject> subjects;
    for (const std::string& name : arguments.names)
        subjects.push_back(read_subject(name, arguments, processor_seconds * reference_share / scenes));
    // Levels have four times the samples each: all of them take 4/3 of the last.
    const double variants = static_cast<double>(all_variants().size());
    const double last_level_seconds =
        processor_seconds * (1 - reference_share - pilot_share) * 3 / 4 / (planned_rounds * scenes * variants);
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < subjects.size(); ++i)
        for (Cell& cell : cells_of(subjects[i], i, last_level_seconds)) cells.push_back(std::move(cell));
    fmt::print(stderr, "{} cells after {:.0f} s\n", cells.size(), clock.seconds());
    measure(subjects, cells, clock, arguments.seconds);
    bench::print_facts(whole, clock.seconds());
    fmt::print("# milliseconds: {:.0f}\n# pixels: {}\n", 1e3 * last_level_seconds,
               subjects.front().usual.width * subjects.front().usual.height);
    print(subjects, cells);
}

/// One line per class of path of each scene, as each technique against it joins in.
void run_classes(const Arguments& arguments, bool whole) {
    const Clock clock;
    const std::uint32_t samples = arguments.quick ? 256 : 1024;
    fmt::memory_buffer lines;
    for (const std::string& name : arguments.names) {
        const Scene scene = scene_of(arguments.scenes / (name + ".json"));
        RenderSettings settings = usual_settings(scene.settings, arguments.pixels);
        for (const auto& [options, sampling, caustics, guide] :
             {std::tuple("--light-sampling cone --caustics off --guide off", LightSampling::cone, false, Guide::off),
              std::tuple("--caustics off --guide off", LightSampling::exact, false, Guide::off),
              std::tuple("--guide off", LightSampling::exact, true, Guide::off),
              std::tuple("defaults", LightSampling::exact, true, Guide::automatic)}) {
            settings.light_sampling = sampling, settings.caustics = caustics, settings.guide = guide;
            const ClassErrors errors = class_errors(scene, settings, samples);
            const std::string start = fmt::format("{},{}", fs::path(name).filename().string(), options);
            fmt::format_to(std::back_inserter(lines), "{},all,{:.4g}\n", start, errors.all);
            for (std::size_t k = 0; k < class_names.size(); ++k)
                fmt::format_to(std::back_inserter(lines), "{},{},{:.4g}\n", start, class_names[k], errors.of[k]);
        }
        fmt::print(stderr, "{} after {:.0f} s\n", name, clock.seconds());
    }
    bench::print_facts(whole, clock.seconds());
    fmt::print("# samples: {}\nscene,options,class,mrse\n{}", samples, fmt::to_string(lines));
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Measures error against time for the options that trade one for the other.");
    app.add_option("--time", arguments.seconds, "Seconds to take, about; 540 unless told")->check(CLI::Range(5, 86400));
    app.add_flag("--quick", arguments.quick, "A tenth of the time, for trying it out");
    app.add_flag("--classes", arguments.classes, "Instead: which classes of paths make the error");
    app.add_option("--pixels", arguments.pixels, "Of an image, about; 4096 unless told")
        ->check(CLI::Range(16, 1 << 20));
    app.add_option("--only", arguments.names, "Scenes, without .json")->delimiter(',');
    app.add_option("--scenes", arguments.scenes, "Folder of the scenes");
    app.add_option("--cache", arguments.cache, "Folder that keeps references from one run to the next");
    CLI11_PARSE(app, argc, argv);
    if (arguments.quick) arguments.seconds /= 10;
    const bool whole = !arguments.quick && app.count("--only") == 0;
    try {
        (arguments.classes ? run_classes : run)(arguments, whole);
    } catch (const std::exception& fault) {
        fmt::print(stderr, "orrery_tradeoff: {}\n", fault.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
