#include "allocation_watch.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> largest = 0;

}  // namespace

namespace orrery::test {

void restart_allocation_watch() { largest = 0; }

std::size_t largest_allocation() { return largest; }

}  // namespace orrery::test

// The program's own operators serve the libraries it is linked with, too. The other forms of new call these.
void* operator new(std::size_t size) {
    largest = std::max<std::size_t>(largest, size);
    if (void* const memory = std::malloc(std::max<std::size_t>(size, 1))) return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
