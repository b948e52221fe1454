// Standard output carries what a script may read, standard error what a person may.
#pragma once

#include <string_view>

namespace orrery {

/// A descriptor 0, 1 or 2 that the caller closed would be given to the next file we open, and a message for the
/// terminal would land in an image. Takes those numbers first. To be called before any file is opened.
void occupy_standard_descriptors();

/// Writes all of it to standard output. Throws std::runtime_error where that fails: a full disk, a closed pipe.
void print_result(std::string_view text);

/// "orrery: error: ..." and "orrery: warning: ..." on standard error. Never fail: there is nowhere left to say so.
void print_error(std::string_view message);
void print_warning(std::string_view message);

/// Text as it is to standard error.
void print_message(std::string_view text);

}  // namespace orrery
