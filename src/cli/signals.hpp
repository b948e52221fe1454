// Ctrl-C and its relatives: no half file, and the exit code a shell expects.
#pragma once

namespace orrery {

/// SIGINT, SIGTERM and SIGHUP end the program with exit_code::ended_by, temporaries removed; those that were ignored
/// when the program started stay so. A broken pipe and a file beyond the size limit become errors of the call that
/// meets them. Once, at the start.
void install_signal_handlers();

/// What is lost if one of those signals ends the program while this lives: said on standard error then.
class Loss {
public:
    /// `text` is a line with its newline, of static lifetime.
    explicit Loss(const char* text);
    ~Loss();
    Loss(const Loss&) = delete;
    Loss& operator=(const Loss&) = delete;

    /// Says it now, and not again.
    static void say();
};

/// While it lives, the first of those signals only raises a flag, for work that asks now and then whether to go on and
/// then leaves nothing behind. Work that is slow to ask has 60 ms; then, or at a second signal, the program ends all
/// the same.
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
