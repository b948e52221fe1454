#include "image/leftovers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <ctime>
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

}  // namespace orrery
