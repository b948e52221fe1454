// The temporaries that exist at this moment, in a form a signal handler may read.
#pragma once

#include <string_view>

namespace orrery {

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
