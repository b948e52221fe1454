// Ctrl-C and its relatives: no half file, and the exit code a shell expects.
#pragma once

namespace orrery {

/// SIGINT, SIGTERM and SIGHUP end the program with exit_code::ended_by, temporaries removed. A broken pipe and a file
/// beyond the size limit become errors of the call that meets them. Once, at the start.
void install_signal_handlers();

/// While it lives, the first of those signals only raises a flag, for work that asks between two steps whether to go
/// on and then leaves nothing behind. A second one ends the program as before: the work may be slow to ask.
class DeferredSignals {
public:
    DeferredSignals();
    ~DeferredSignals();
    DeferredSignals(const DeferredSignals&) = delete;
    DeferredSignals& operator=(const DeferredSignals&) = delete;

    /// The signal that came, 0 for none.
    int caught() const;
};

}  // namespace orrery
