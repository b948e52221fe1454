// How much memory a reader asks for: the largest single allocation through operator new.
#pragma once

#include <cstddef>

namespace orrery::test {

/// Forgets what was asked for until now.
void restart_allocation_watch();

/// The largest request since then, in bytes, granted or not.
std::size_t largest_allocation();

}  // namespace orrery::test
