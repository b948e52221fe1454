#include "support/heap_watch.hpp"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

// Atomic so that threads of the libraries do no harm.
std::atomic<std::size_t> held = 0, held_at_start = 0, most_held = 0, allocations = 0, largest = 0;

}  // namespace

namespace orrery::test {

void restart_heap_watch() {
    held_at_start = most_held = held.load();
    allocations = largest = 0;
}

HeapUse heap_use() { return {most_held - held_at_start, allocations, largest}; }

}  // namespace orrery::test

// The program's own operators serve the libraries it is linked with, too. The other forms of new call these.
void* operator new(std::size_t size) {
    largest = std::max<std::size_t>(largest, size);
    void* const memory = std::malloc(std::max<std::size_t>(size, 1));
    if (!memory) throw std::bad_alloc();
    held += ::malloc_usable_size(memory);
    most_held = std::max<std::size_t>(most_held, held);
    ++allocations;
    return memory;
}

void operator delete(void* memory) noexcept {
    held -= ::malloc_usable_size(memory);
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
