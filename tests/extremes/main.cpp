// Runs the suite and writes the table of what was measured: orrery_extremes PAGE [TIMES [PART]], TIMES the tests'
// number of trials (default 5), PART what the name of a case must contain. Exit code 3: a limit is exceeded.
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "cases.hpp"

namespace {

using namespace orrery::extremes;

constexpr const char* introduction = R"(# Where the numbers hold

Written by `./run extremes`, which runs the cases of [`tests/extremes`](../tests/extremes) with {:g} times the trials the
tests run. Every error is measured against quadruple precision (113 bits) by formulas that share nothing with the
kernels. A test fails when a limit is exceeded.

*float* is what scalar code, AVX2 and AVX-512 compute, to the same byte; SSE2 has no fused multiply-add and rounds more
often. u is the unit of rounding: 2^-24 in float, 2^-53 in double.

An answer about a ray and a sphere is wrong by k units of u (f + r), f the distance from its origin to the centre and r the
radius, when the sphere would have to grow or shrink by that much for the answer to be exact. Rounding C - O and r to
the number format moves the surface by up to one such unit before anything is computed: a verdict wrong by no more than
that is explained by the rounding of the inputs.

Where the numbers end: 100 nested shells are told apart down to 8 u of the radius, not at 4. Ten thousand terms in one
float sample drift by up to half a rounding each; double holds them. Where coordinates leave a sphere less than a
rounding, samples may come out as no numbers: they are dropped, counted and reported.
)";

std::string figure(double x) { return x == 0 ? "0" : fmt::format("{:.2g}", x); }

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "usage: orrery_extremes PAGE [TIMES [PART]]\n";
        return 2;
    }
    const double times = argc > 2 ? std::atof(argv[2]) : 5;
    const std::string part = argc > 3 ? argv[3] : "";
    std::ofstream page(argv[1]);
    page << fmt::format(introduction, times);
    std::string group;
    bool kept = true;
    for (const Case& c : all_cases()) {
        const std::string name = fmt::format("{}, {}, {}", c.group, c.name, c.mode);
        if (name.find(part) == std::string::npos) continue;
        Errors errors;
        c.run(errors, static_cast<std::uint64_t>(times * static_cast<double>(c.trials)));
        if (c.group != group) {
            group = c.group;
            page << fmt::format(
                "\n## {}\n\n| case | mode | trials | worst | 99.9 % | limit | unit |\n"
                "|---|---|--:|--:|--:|--:|---|\n",
                group);
        }
        page << fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", c.name, c.mode, errors.count(),
                            figure(errors.worst()), figure(errors.quantile(0.999)), figure(c.limit), c.unit);
        if (errors.worst() <= c.limit) continue;
        kept = false;
        std::cerr << fmt::format("{}: {} {}, limit {}, by {}\n", name, errors.worst(), c.unit, c.limit,
                                 errors.culprit());
    }
    page.close();
    if (!page) {
        std::cerr << "cannot write " << argv[1] << '\n';
        return 1;
    }
    return kept ? 0 : 3;
}
