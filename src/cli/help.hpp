// Help as a terminal shows it: lines broken between words, at the terminal's width.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace orrery {

/// What the user types to start the program, for hints and examples: "./run" where that script says so in the
/// environment variable ORRERY_COMMAND, else "orrery".
std::string typed_command();

/// Characters a line of help may take: COLUMNS where the environment says, else the width of standard output's
/// terminal, else 80. Between 20, below which hardly a word fits, and 100, beyond which lines are hard to read.
std::size_t help_columns();

/// Adds `text` to `out`, which ends in a line that has `used` characters. Lines get at most `columns`, a longer word
/// one of its own; those after the first begin with `indent` blanks. `line_end` marks lines that go on. Returns how
/// many characters the last line has.
std::size_t add_wrapped(std::string& out, std::string_view text, std::size_t used, std::size_t indent,
                        std::size_t columns, std::string_view line_end = "");

/// For CLI::App::formatter. Options stand in their groups in the order of declaration. In an app's footer each line is
/// a paragraph; those that begin with blanks are commands, whose lines go on behind a backslash.
std::shared_ptr<CLI::FormatterBase> help_formatter(std::size_t columns);

}  // namespace orrery
