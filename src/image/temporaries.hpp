// The temporaries that files are made in: names, locks, and what becomes of them where a writer ends before its time.
//
// A writer holds a lock (flock) on its temporary until it is renamed; the system lets go of it when the process ends,
// however it ends. What nobody holds is left over. On a file system of many machines the lock may hold on each alone:
// what another one made, as the name says, must also be a day old.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace orrery {

/// A name for a temporary, ".orrery-MACHINE-PROCESS-N.tmp", another one at each call. It is short and does not repeat
/// the target's: that one may be as long as the file system allows.
std::string temporary_name();

/// Takes the lock of a temporary just made, for as long as the descriptor or a duplicate of it is open. False where
/// somebody who removes leftovers was quicker: the file is gone then, or will be.
bool lock_temporary(int descriptor);

/// Removes what is left over in the folder, as far as that is allowed.
void remove_leftovers(const std::filesystem::path& folder);

/// Removes the temporaries of writes under way and lets no new write begin. For a handler of SIGINT or SIGTERM that
/// ends the process afterwards; async-signal-safe.
void remove_pending_temporaries() noexcept;

/// Announces a temporary for as long as it lives. It comes before the file is made, so that a signal in between finds
/// a name too many rather than a file too many.
class PendingTemporary {
public:
    /// Throws std::runtime_error where the process is ending, where too many writes are under way at once, or where
    /// the path is longer than the system allows.
    explicit PendingTemporary(std::string_view path);
    ~PendingTemporary();
    PendingTemporary(const PendingTemporary&) = delete;
    PendingTemporary& operator=(const PendingTemporary&) = delete;

private:
    std::size_t slot_;
};

}  // namespace orrery
