// Text from a scene file, made safe to print: a message is valid UTF-8 of bounded length whatever the file holds.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace orrery {

/// `text` with control characters and bytes that are no UTF-8 written as \xNN. Text longer than `limit` bytes keeps
/// its first two thirds and its last third around "...": the end of a parser's message says what it expected.
std::string printable(std::string_view text, std::size_t limit = 80);

/// printable() between double quotes.
std::string in_quotes(std::string_view text);

}  // namespace orrery
