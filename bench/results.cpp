#include "bench/results.hpp"

#include <fmt/format.h>

#include <fstream>
#include <thread>

#include "kernels/isa.hpp"

namespace orrery::bench {

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

void print_facts(bool whole, double seconds) {
    fmt::print("# processor: {}\n# threads: {}\n# isa: {}\n# seconds: {:.0f}\n# whole: {}\n", processor_name(),
               std::thread::hardware_concurrency(), isa_name(best_isa()), seconds, whole ? "yes" : "no");
}

}  // namespace orrery::bench
