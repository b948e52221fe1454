// Standard output carries what a script may read, standard error what a person may.
#pragma once

#include <filesystem>
#include <string_view>

namespace orrery {

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

}  // namespace orrery
