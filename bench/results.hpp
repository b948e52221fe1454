// How results were measured: what stands before their columns, for the scripts of bench/pages.
#pragma once

#include <string>

namespace orrery::bench {

/// As the system gives it; "unknown processor" where it does not.
std::string processor_name();

/// Prints the processor, its threads, the instruction set in use and how long the run took; `whole` where everything
/// was measured, as the page in the repository wants it.
void print_facts(bool whole, double seconds);

}  // namespace orrery::bench
