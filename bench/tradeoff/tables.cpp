#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include "bench/tradeoff/output.hpp"
#include "scene/counted.hpp"

namespace orrery::tradeoff {

namespace {

std::string plus_minus(const Figure& figure) { return fmt::format("{:.2f} ± {:.2f}", figure.value, figure.error); }

std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

constexpr const char* few_rounds =
    "So few rounds leave the error bars themselves uncertain, by half where there are three: a longer `--time` has "
    "more.\n";

std::string setting(const Outcome& outcome) {
    return fmt::format(
               "{} {} rounds in {:.0f} s: {} combinations of scene and settings, each rendered at up "
               "to four "
               "numbers of samples, the largest of about {:.0f} ms of processor time; images of {} pixels or about.\n",
               machine_text(), outcome.rounds, outcome.seconds, outcome.cells.size(), 1e3 * outcome.last_level_seconds,
               outcome.subjects.front().usual.width * outcome.subjects.front().usual.height) +
           (outcome.rounds < 8 ? few_rounds : "");
}

std::string best(const Outcome& outcome) {
    std::string table =
        "| scene | samples | error with the defaults | most efficient settings | times the defaults' efficiency |\n"
        "|---|--:|--:|---|--:|\n";
    for (std::size_t i = 0; i < outcome.subjects.size(); ++i) {
        const CellSummary &usual = outcome.defaults(i), &winner = best_of(outcome, i);
        table += fmt::format("| [{0}](plots/tradeoff_{0}.svg) | {1:.0f} | {2:.2g} % | {3} | {4} |\n",
                             outcome.subjects[i].name, usual.levels.back().samples,
                             100 * std::sqrt(std::max(0.0, usual.levels.back().mrse.value)), winner.name,
                             &winner == &usual ? "1" : plus_minus(ratio(winner.efficiency(), usual.efficiency())));
    }
    return table;
}

std::string options(const Outcome& outcome) {
    std::string table = "| instead of the default | scenes | mean gain | worst | best |\n|---|--:|--:|---|---|\n";
    for (const Effect& effect : effects_of(outcome)) {
        const auto [low, high] = std::ranges::minmax_element(effect.gains, {}, &Figure::value);
        const auto at = [&](auto gain) {
            const std::size_t i = effect.subjects[static_cast<std::size_t>(gain - effect.gains.begin())];
            return fmt::format("{} ({})", plus_minus(*gain), outcome.subjects[i].name);
        };
        const std::string base =
            effect.choice.instead_of.empty() ? "" : fmt::format(" (against `{}`)", effect.choice.instead_of);
        table += fmt::format("| `{} {}`{} | {} | {} | {} | {} |\n", effect.choice.option, effect.choice.word, base,
                             effect.gains.size(), plus_minus(effect.mean), at(low), at(high));
    }
    return table;
}

constexpr const char* without_floor =
    "; no floor is found, which speaks for bright paths so rare that few renders with few samples meet one";

std::string slopes(const Outcome& outcome) {
    std::string table = "| scene | `--estimator uniform` | defaults |\n|---|--:|--:|\n";
    std::string faults;
    const auto slope = [](const CellSummary& cell) {
        return std::isfinite(cell.slope.error) ? plus_minus(cell.slope) : std::string("-");
    };
    for (std::size_t i = 0; i < outcome.subjects.size(); ++i) {
        std::string uniform = "-";
        for (const CellSummary* cell : outcome.cells_of(i)) {
            if (cell->name == "--estimator uniform") uniform = slope(*cell);
            if (cell->biased())
                faults += fmt::format("* {}, {}: **bias**, the error tends to {:.2g} % ({:.1f} standard errors)\n",
                                      outcome.subjects[i].name, cell->name, 100 * std::sqrt(cell->floor.value),
                                      cell->floor.value / cell->floor.error);
            if (cell->flattening())
                faults += fmt::format("* {}, {}: the error **flattens**, slope {}{}\n", outcome.subjects[i].name,
                                      cell->name, plus_minus(cell->slope), cell->biased() ? "" : without_floor);
        }
        table += fmt::format("| {} | {} | {} |\n", outcome.subjects[i].name, uniform, slope(outcome.defaults(i)));
    }
    return table + (faults.empty() ? "\nNo setting of any scene shows a bias or flattens.\n" : "\n" + faults);
}

std::string references(const Outcome& outcome) {
    std::string table =
        "| scene | samples per pixel | its own error | share of the defaults' MRSE |\n|---|--:|--:|--:|\n";
    for (std::size_t i = 0; i < outcome.subjects.size(); ++i) {
        const Reference& reference = outcome.subjects[i].reference;
        table += fmt::format("| {} | {:.0f} | {:.2g} % | {:.2g} % |\n", outcome.subjects[i].name, reference.samples,
                             100 * std::sqrt(reference.mrse),
                             100 * reference.mrse / (reference.mrse + outcome.defaults(i).levels.back().mrse.value));
    }
    return table;
}

}  // namespace

std::string machine_text() {
    return fmt::format("{}, {}, {}.", processor(), counted(std::thread::hardware_concurrency(), "thread"),
                       isa_name(best_isa()));
}

std::map<std::string, std::string> blocks_of(const Outcome& outcome) {
    return {{"setting", setting(outcome)}, {"advice", advice(outcome)}, {"best", best(outcome)},
            {"options", options(outcome)}, {"slopes", slopes(outcome)}, {"references", references(outcome)}};
}

}  // namespace orrery::tradeoff
