#include "image/pending_temporaries.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <stdexcept>

namespace orrery {
namespace {

enum class State { free, filling, live };

// Storage is static because a handler can neither lock nor touch the heap.
struct Slot {
    std::atomic<State> state = State::free;
    char path[PATH_MAX];
};

// A write lasts milliseconds and a render has one output or a few.
std::array<Slot, 16> slots;
std::atomic<bool> ending = false;
static_assert(std::atomic<State>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

std::size_t claim_slot(std::string_view path) {
    for (std::size_t i = 0; i < slots.size(); ++i) {
        State expected = State::free;
        if (slots[i].state.compare_exchange_strong(expected, State::filling)) return i;
    }
    throw std::runtime_error(fmt::format("{}: too many files are written at once", path));
}

}  // namespace

void remove_pending_temporaries() noexcept {
    const int interrupted_error = errno;
    // First close the door: a slot seen live below cannot be filled with another path while it is read, because who
    // claims it now looks at `ending` before writing.
    ending = true;
    for (Slot& slot : slots)
        if (slot.state == State::live) ::unlink(slot.path);
    errno = interrupted_error;
}

PendingTemporary::PendingTemporary(std::string_view path) {
    if (path.size() >= sizeof Slot::path) throw std::runtime_error(fmt::format("{}: the path is too long", path));
    slot_ = claim_slot(path);
    Slot& slot = slots[slot_];
    if (!ending) {
        std::memcpy(slot.path, path.data(), path.size());
        slot.path[path.size()] = '\0';
        slot.state = State::live;
    }
    // Asked again: a handler that ran while the slot was filling passed it by.
    if (ending) {
        slot.state = State::free;
        throw std::runtime_error(fmt::format("{}: not written, the program is being ended", path));
    }
}

PendingTemporary::~PendingTemporary() { slots[slot_].state = State::free; }

}  // namespace orrery
