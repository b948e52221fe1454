// Runs the suite and writes the table of what was measured: orrery_extremes PAGE [TIMES [PART]], TIMES as many times
// the trials of the page in the repository (default 1), PART what the name of a case must contain. Exit code 3: a limit
// is exceeded.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>

#include "cases.hpp"

namespace {

using namespace orrery::extremes;

constexpr const char* introduction = R"(# Where the numbers hold

Written by `./run extremes TIMES`, which runs the cases of [`tests/extremes`](../tests/extremes) with ten times the
trials the tests run, 170 times where rays leave a surface, and all that TIMES over; TIMES was {:g}. Errors are measured
by formulas that share nothing with the kernels, in quadruple precision (113 bits); those of rays that leave a surface in
double for float and in 64 bits for double, which blur a rounding by some 2^-28 and 2^-10 of itself. A test fails when a
limit is exceeded.

*float* is what scalar code, AVX2 and AVX-512 compute, to the same byte; SSE2 has no fused multiply-add and rounds more
often. u is the unit of rounding: 2^-24 in float, 2^-53 in double.

An answer about a ray and a sphere is wrong by k units of u (f + r), f the distance from its origin to the centre and r the
radius, when the sphere would have to grow or shrink by that much for the answer to be exact. Rounding C - O and r to
the number format moves the surface by up to one such unit before anything is computed: a verdict wrong by no more than
that is explained by the rounding of the inputs.

Where the numbers end: 100 nested shells are told apart down to 8 u of the radius, not at 4. Of float's hundred million
rays that leave a surface three, which graze another they begin on, miss its place by 10 to 16 units, all others by less
than 8. Ten thousand terms in one float sample drift by up to half a rounding each; double holds them. Where coordinates
leave a sphere less than a rounding, samples may come out as no numbers: they are dropped, counted and reported. The
density of a glossy sample loses the digits of (1 - beta)^2: at roughness 0.999999 float has none left for the one sample
in a million whose perturbation all but cancels the direction. A still life of balls of radius 1/4 to 1 moved by 1e6, where the
numbers of float are 1/16 apart, is another picture, by a fifth: there the planner warns, and `--precision auto`
takes double.
)";

std::string figure(double x) { return x == 0 ? "0" : fmt::format("{:.2g}", x); }

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: orrery_extremes PAGE [TIMES [PART]]\n";
        return 2;
    }
    const double times = argc > 2 ? std::atof(argv[2]) : 1;
    const std::string part = argc > 3 ? argv[3] : "";
    std::ofstream page(argv[1]);
    page << fmt::format(introduction, times);
    std::string group;
    bool kept = true;
    std::map<std::string, std::uint64_t> trials;  // of the group, by mode
    const auto end_group = [&] {
        for (const auto& [mode, count] : trials)
            page << fmt::format("{}{} ({})", mode == trials.begin()->first ? "\nTrials in all: " : ", ", count, mode);
        if (!trials.empty()) page << ".\n";
        trials.clear();
    };
    for (const Case& c : all_cases()) {
        const std::string name = fmt::format("{}, {}, {}", c.group, c.name, c.mode);
        if (name.find(part) == std::string::npos) continue;
        Errors errors;
        c.run(errors, static_cast<std::uint64_t>(times * static_cast<double>(c.trials * c.times_on_page)));
        if (c.group != group) {
            end_group();
            group = c.group;
            page << fmt::format(
                "\n## {}\n\n| case | mode | trials | worst | 99.9 % | limit | unit |\n"
                "|---|---|--:|--:|--:|--:|---|\n",
                group);
        }
        trials[c.mode] += errors.count();
        page << fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", c.name, c.mode, errors.count(),
                            figure(errors.worst()), figure(errors.quantile(0.999)), figure(c.limit), c.unit);
        if (errors.worst() <= c.limit) continue;
        kept = false;
        std::cerr << fmt::format("{}: {} {}, limit {}, by {}\n", name, errors.worst(), c.unit, c.limit,
                                 errors.culprit());
    }
    end_group();
    page.close();
    if (!page) {
        std::cerr << "cannot write " << argv[1] << '\n';
        return 1;
    }
    return kept ? 0 : 3;
}
