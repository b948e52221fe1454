#include "bench/tradeoff/output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/report/files.hpp"
#include "bench/report/page.hpp"

namespace fs = std::filesystem;

namespace orrery::tradeoff {

std::vector<const CellSummary*> Outcome::cells_of(std::size_t subject) const {
    std::vector<const CellSummary*> of_subject;
    for (const CellSummary& cell : cells)
        if (cell.scene == subject) of_subject.push_back(&cell);
    return of_subject;
}

const CellSummary& Outcome::defaults(std::size_t subject) const { return *cells_of(subject).front(); }

const CellSummary& best_of(const Outcome& outcome, std::size_t subject) {
    const std::vector<const CellSummary*> cells = outcome.cells_of(subject);
    const auto efficiency = [](const CellSummary* cell) {
        return cell->variant.is_about_time() ? 0 : cell->efficiency().value;
    };
    return **std::ranges::max_element(cells, {}, efficiency);
}

namespace {

/// What a choice is compared with on a subject; null where that was not measured.
const CellSummary* base_of(const Outcome& outcome, const Choice& choice, std::size_t subject) {
    if (choice.instead_of.empty()) return &outcome.defaults(subject);
    const std::string name = choice.option + " " + choice.instead_of;
    for (const CellSummary* cell : outcome.cells_of(subject))
        if (cell->name == name) return cell;
    return nullptr;
}

}  // namespace

std::vector<Effect> effects_of(const Outcome& outcome) {
    std::vector<Effect> effects;
    for (const Variant& variant : all_variants()) {
        if (variant.choices.size() != 1) continue;
        Effect effect{variant.choices.front(), {}, {}, {}};
        for (const CellSummary& cell : outcome.cells) {
            if (cell.name != variant.name()) continue;
            const CellSummary* const base = base_of(outcome, effect.choice, cell.scene);
            if (base == nullptr || !(cell.efficiency().value > 0) || !(base->efficiency().value > 0)) continue;
            effect.subjects.push_back(cell.scene);
            effect.gains.push_back(variant.is_about_time()
                                       ? ratio(base->levels.back().seconds, cell.levels.back().seconds)
                                       : ratio(cell.efficiency(), base->efficiency()));
        }
        if (effect.gains.empty()) continue;
        effect.mean = geometric_mean(effect.gains);
        effects.push_back(std::move(effect));
    }
    return effects;
}

std::string csv_of(const Outcome& outcome) {
    std::string csv =
        "scene,options,samples,renders,seconds,seconds_error,mrse,mrse_error,efficiency,efficiency_error,slope,"
        "slope_error,floor,floor_error\n";
    for (const CellSummary& cell : outcome.cells)
        for (const LevelSummary& l : cell.levels)
            csv +=
                fmt::format("{},{},{:.6g},{},{:.4g},{:.2g},{:.5g},{:.2g},{:.4g},{:.2g},{:.4f},{:.4f},{:.3g},{:.2g}\n",
                            outcome.subjects[cell.scene].name, cell.name, l.samples, l.renders, l.seconds.value,
                            l.seconds.error, l.mrse.value, l.mrse.error, l.efficiency.value, l.efficiency.error,
                            cell.slope.value, cell.slope.error, cell.floor.value, cell.floor.error);
    return csv;
}

void write_all(const Outcome& outcome, const fs::path& folder) {
    const std::string page = bench::with_blocks(bench::text_of(folder / "TRADEOFF.md"), blocks_of(outcome));
    for (const auto& [name, svg] : plots_of(outcome)) bench::write_text(folder / "plots" / name, svg);
    bench::write_text(folder / "results" / "tradeoff.csv", csv_of(outcome));
    bench::write_text(folder / "TRADEOFF.md", page);
}

}  // namespace orrery::tradeoff
