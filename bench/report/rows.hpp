// The results of a run: what Google Benchmark wrote, one row per benchmark.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orrery::bench {

/// A benchmark's name is group/subject/what/variant.
struct Row {
    std::string group, subject, what, variant;
    std::map<std::string, double> counters;  ///< "Rays/s", "cycles/ray", ...

    /// A counter, or 0 where the benchmark has none of that name.
    double operator[](const std::string& counter) const;
};

struct Results {
    std::string cpu;
    std::string embree;  ///< version, "none" where it was not there
    bool whole = false;  ///< of a run of everything there is to measure, not of a choice
    std::vector<Row> rows;

    /// The row of that name, nullptr if there is none.
    const Row* find(std::string_view group, std::string_view subject, std::string_view what,
                    std::string_view variant) const;
    /// The subjects of a group, or what is measured of one, or its variants, each in the order of the run.
    std::vector<std::string> subjects(std::string_view group) const;
    std::vector<std::string> whats(std::string_view group, std::string_view subject) const;
};

/// Reads Google Benchmark's JSON. Of a benchmark's repetitions the fastest one counts: what slows a run on a shared
/// machine is never its own. Throws std::runtime_error on anything that is no such file, and where a benchmark reports
/// an error: a page of wrong results is not made.
Results read_results(std::string_view json);

/// One line per row, one column per counter. The same rows give the same bytes.
std::string csv_of(const Results& results);

/// "Intel(R) Xeon(R) Processor @ 2.50GHz" -> "intel-xeon-2.50ghz": a file's name.
std::string file_name_of(std::string_view cpu);

}  // namespace orrery::bench
