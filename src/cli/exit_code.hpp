// What the program tells the shell when it ends.
#pragma once

#include <stdexcept>

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

}  // namespace orrery
