#include "system/printable.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace orrery {
namespace {

std::size_t sequence_length(unsigned char lead) {
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead <= 0xDF) return 2;
    if (lead >= 0xE0 && lead <= 0xEF) return 3;
    if (lead >= 0xF0 && lead <= 0xF4) return 4;
    return 0;
}

/// The second byte of a sequence carries the limits that exclude overlong forms, surrogates and values past U+10FFFF.
bool second_byte_fits(unsigned char lead, unsigned char second) {
    const unsigned char low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    const unsigned char high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    return second >= low && second <= high;
}

/// Characters beyond ASCII that break lines, or change the order in which others are shown: a C1 control, Arabic letter
/// mark, left-to-right and right-to-left marks, line and paragraph separators, embeddings and overrides, isolates.
bool stirs_lines(std::uint32_t c) {
    return (c >= 0x80 && c < 0xA0) || c == 0x61C || c == 0x200E || c == 0x200F || (c >= 0x2028 && c <= 0x202E) ||
           (c >= 0x2066 && c <= 0x2069);
}

/// Length of the printable character that `text` starts with; 0 where it starts with none.
std::size_t printable_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x20 || byte(0) == 0x7F) return 0;
    const std::size_t length = sequence_length(byte(0));
    if (length < 2) return length;
    if (length > text.size() || !second_byte_fits(byte(0), byte(1))) return 0;
    for (std::size_t i = 2; i < length; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
    }
    std::uint32_t character = byte(0) & (0x7Fu >> length);
    for (std::size_t i = 1; i < length; ++i) character = character << 6 | (byte(i) & 0x3Fu);
    return stirs_lines(character) ? 0 : length;
}

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

std::string escaped(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = printable_length(text);
        if (length > 0) {
            out.append(text.substr(0, length));
        } else {
            out += fmt::format("\\x{:02X}", static_cast<unsigned char>(text[0]));
        }
        text.remove_prefix(length > 0 ? length : 1);
    }
    return out;
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
    if (text.size() <= limit) return escaped(text);
    std::size_t head = limit * 2 / 3;
    std::size_t tail = text.size() - (limit - head);
    // Cut between characters. No character has more than three continuation bytes, so neither loop runs far in UTF-8.
    for (int i = 0; i < 3 && head > 0 && is_continuation(text[head]); ++i) --head;
    for (int i = 0; i < 3 && tail < text.size() && is_continuation(text[tail]); ++i) ++tail;
    return escaped(text.substr(0, head)) + "..." + escaped(text.substr(tail));
}

bool is_printable(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = printable_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string in_quotes(std::string_view text) { return '"' + printable(text) + '"'; }

}  // namespace orrery
