// What a piece of work takes from the heap, through operator new: of programs that link orrery_test_heap_watch.
#pragma once

#include <cstddef>

namespace orrery::test {

struct HeapUse {
    std::size_t peak = 0;         ///< most bytes held at once, beyond those held at the start
    std::size_t allocations = 0;  ///< how many
    std::size_t largest = 0;      ///< bytes of the largest request, granted or not
};

/// Starts counting anew.
void restart_heap_watch();

/// Since then. Exact where one thread allocates.
HeapUse heap_use();

}  // namespace orrery::test
