// One rule for metadata in all formats, so that the same keys and values are found in each.
#pragma once

#include <string>
#include <string_view>

namespace orrery {

/// A key every format can hold: printable ASCII, 1 to 79 characters (the limit of a PNG keyword), without spaces at
/// its ends. An empty key becomes PNG's keyword for everything else, "Comment".
std::string metadata_key(std::string_view key);

/// A value that fits one line of a PPM header: control characters, newlines first of all, become spaces. Bytes beyond
/// ASCII pass, so UTF-8 survives.
std::string metadata_value(std::string_view value);

/// Whether PNG's tEXt, which is Latin-1, would show this UTF-8 text as it was meant.
bool is_ascii(std::string_view text);

}  // namespace orrery
