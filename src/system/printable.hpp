// Text from a scene file, a file name or a command line, made safe to print: one line of valid UTF-8 in the order in
// which it is written, whatever it holds.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace orrery {

/// `text` with control characters, characters that break lines or reorder what is shown, and bytes that are no UTF-8
/// written as \xNN. Text longer than `limit` bytes keeps its first two thirds and its last third around "...": the end
/// of a parser's message says what it expected.
std::string printable(std::string_view text, std::size_t limit = 80);

/// All of it, however long: a file's name, a message.
inline std::string printable_whole(std::string_view text) {
    return printable(text, std::numeric_limits<std::size_t>::max());
}

/// Whether printable() would leave it as it is.
bool is_printable(std::string_view text);

/// printable() between double quotes.
std::string in_quotes(std::string_view text);

}  // namespace orrery
