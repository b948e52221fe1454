// The program among others: its standard streams, the signals that reach it, how it ends, and its version.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace orrery::exit_code {

inline constexpr int done = 0;     ///< images written, question answered
inline constexpr int failed = 1;   ///< the work failed: a file that cannot be written, out of memory
inline constexpr int misused = 2;  ///< bad usage or a bad scene
inline constexpr int differs = 3;  ///< orrery compare: the images differ by more than they may

/// As a shell reports a program that a signal ended: 130 for SIGINT, 143 for SIGTERM.
constexpr int ended_by(int signal) { return 128 + signal; }

}  // namespace orrery::exit_code

namespace orrery {

/// The command line asks for what cannot be: exit_code::misused.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The project's version, "1.2.3"; configured in a checkout also its revision, "1.2.3+0123abcde".
std::string_view version();

// Standard output carries what a script may read, standard error what a person may.

/// A descriptor 0, 1 or 2 that the caller closed would be given to the next file we open, and a message for the
/// terminal would land in an image. Takes those numbers first. To be called before any file is opened.
void occupy_standard_descriptors();

/// Writes all of it to standard output. Throws std::runtime_error where that fails: a full disk, a closed pipe.
void print_result(std::string_view text);

/// The name of a file on a line of standard output: as it is for a script, and printable for a terminal.
void print_name(const std::filesystem::path& file);

// To standard error. None fails: there is nowhere left to say so.

/// "orrery: error: ..." and "orrery: warning: ..." in a line, whatever the message quotes: what is not printable in it
/// is escaped.
void print_error(std::string_view message);
void print_warning(std::string_view message);
/// A line without such a beginning.
void print_line(std::string_view text);

/// As it is: of several lines, or one that moves on a terminal. What it quotes must have been made printable.
void print_message(std::string_view text);

// Ctrl-C and its relatives: no half file, and the exit code a shell expects.

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
/// then leaves nothing behind. Work that is slow to ask has 60 ms, unless what it does then is worth waiting for; then,
/// or at a second signal, the program ends all the same.
class DeferredSignals {
public:
    explicit DeferredSignals(bool wait);
    ~DeferredSignals();
    DeferredSignals(const DeferredSignals&) = delete;
    DeferredSignals& operator=(const DeferredSignals&) = delete;

    /// The signal that came, 0 for none.
    int caught() const;
};

}  // namespace orrery
