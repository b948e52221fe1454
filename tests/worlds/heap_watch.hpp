// What a piece of work takes from the heap, through operator new.
#pragma once

#include <cstddef>

namespace orrery::test {

struct HeapUse {
    std::size_t peak = 0;         ///< most bytes held at once, beyond those held at the start
    std::size_t allocations = 0;  ///< how many
};

/// Starts counting anew.
void restart_heap_watch();

/// Since then.
HeapUse heap_use();

}  // namespace orrery::test
