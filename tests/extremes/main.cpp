// Runs the suite and prints what was measured, for bench/pages/extremes.py: orrery_extremes [TIMES [PART]], TIMES as
// many times the trials of the page in the repository (default 1), PART what the name of a case must contain. Exit code
// 3: a limit is exceeded.
#include <fmt/format.h>

#include <cstdlib>
#include <iostream>

#include "cases.hpp"

using namespace orrery::extremes;

int main(int argc, char** argv) {
    const double times = argc > 1 ? std::atof(argv[1]) : 1;
    const std::string part = argc > 2 ? argv[2] : "";
    std::cout << fmt::format("# times: {:g}\n# whole: {}\ngroup,case,mode,trials,worst,quantile,limit,unit\n", times,
                             part.empty() && times >= 1 ? "yes" : "no");
    bool kept = true;
    for (const Case& c : all_cases()) {
        const std::string name = full_name(c);
        if (name.find(part) == std::string::npos) continue;
        const auto trials = static_cast<std::uint64_t>(times * static_cast<double>(c.trials * c.times_on_page));
        const Errors errors = errors_of(c, trials);
        std::cout << fmt::format("\"{}\",\"{}\",\"{}\",{},{:.6g},{:.6g},{:g},\"{}\"\n", c.group, c.name, c.mode,
                                 errors.count(), errors.worst(), errors.quantile(0.999), c.limit, c.unit);
        if (errors.worst() <= c.limit) continue;
        kept = false;
        std::cerr << fmt::format("{}: {} {}, limit {}, by {}\n", name, errors.worst(), c.unit, c.limit,
                                 errors.culprit());
    }
    return kept ? 0 : 3;
}
