// The page, plots and table of a run.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/tradeoff/summary.hpp"

namespace orrery::tradeoff {

struct Outcome {
    std::vector<Subject> subjects = {};
    std::vector<CellSummary> cells = {};  ///< by subject, in the order of all_variants()
    double last_level_seconds = 0;        ///< of processor time, what the largest renders were to take
    double seconds = 0;                   ///< the whole run
    std::uint32_t rounds = 0;

    std::vector<const CellSummary*> cells_of(std::size_t subject) const;
    /// A subject's cell with the defaults.
    const CellSummary& defaults(std::size_t subject) const;
};

/// One choice against the default it replaces, all else being as usual, wherever it changes anything.
struct Effect {
    Choice choice;
    std::vector<std::size_t> subjects;
    std::vector<Figure> gains;  ///< efficiency over the defaults', by subject
    Figure mean;                ///< geometric
};
std::vector<Effect> effects_of(const Outcome& outcome);

/// The most efficient of the cells of a subject that change its sampling.
const CellSummary& best_of(const Outcome& outcome, std::size_t subject);

/// Markdown by the name of the block of TRADEOFF.md it belongs to.
std::map<std::string, std::string> blocks_of(const Outcome& outcome);

/// The processor, its threads and the instruction set that the program takes, as a sentence.
std::string machine_text();

/// What a user should choose, in sentences. Part of blocks_of.
std::string advice(const Outcome& outcome);

/// SVG by file name.
std::map<std::string, std::string> plots_of(const Outcome& outcome);

/// One line per level of each cell.
std::string csv_of(const Outcome& outcome);

/// FOLDER/TRADEOFF.md's blocks, FOLDER/plots and FOLDER/results/tradeoff.csv.
void write_all(const Outcome& outcome, const std::filesystem::path& folder);

}  // namespace orrery::tradeoff
