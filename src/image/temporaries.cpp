#include "image/temporaries.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string_view>

#include "system/file_descriptor.hpp"

namespace orrery {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".orrery-", suffix = ".tmp";

/// Eight digits that stand for this machine's name.
const std::string& machine() {
    static const std::string digits = [] {
        char name[HOST_NAME_MAX + 1] = {};
        ::gethostname(name, HOST_NAME_MAX);
        std::uint32_t hash = 2166136261;  // FNV-1a
        for (const char c : std::string_view(name)) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619;
        return fmt::format("{:08x}", hash);
    }();
    return digits;
}

/// Removes a temporary where nobody holds it.
void remove_if_left(const fs::path& file, bool ours) {
    // O_NONBLOCK: a pipe of that name would wait for a reader.
    const FileDescriptor found(::open(file.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat opened = {}, named = {};
    if (!found.is_open() || ::fstat(found.number(), &opened) != 0 || !S_ISREG(opened.st_mode)) return;
    constexpr std::time_t day = 24 * 3600;
    if (!ours && std::time(nullptr) - opened.st_mtime < day) return;
    if (::flock(found.number(), LOCK_EX | LOCK_NB) != 0) return;
    // Its writer may have renamed it while we looked: what bears the name now must be what we hold.
    const bool same =
        ::lstat(file.c_str(), &named) == 0 && named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
    if (same) ::unlink(file.c_str());
}

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

std::string temporary_name() {
    static std::atomic<unsigned> count = 0;
    return fmt::format("{}{}-{}-{}{}", prefix, machine(), ::getpid(), count++, suffix);
}

bool lock_temporary(int descriptor) {
    // Where there are no locks nobody can hold one, and nothing is ever taken for a leftover.
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    struct stat status = {};
    return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

void remove_leftovers(const fs::path& folder) {
    std::error_code error;
    const std::string our_prefix = std::string(prefix) + machine() + "-";
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with(prefix) && name.ends_with(suffix))
            remove_if_left(entry->path(), name.starts_with(our_prefix));
    }
}

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
