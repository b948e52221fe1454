#include "image/metadata_text.hpp"

#include <algorithm>

namespace orrery {
namespace {

constexpr std::size_t longest_key = 79;

// Not std::isprint and friends: what an image file holds must not depend on the locale.
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }
bool is_beyond_ascii(char c) { return static_cast<unsigned char>(c) >= 0x80; }

}  // namespace

std::string metadata_key(std::string_view key) {
    std::string result(key.substr(0, longest_key));
    std::replace_if(
        result.begin(), result.end(), [](char c) { return is_control(c) || is_beyond_ascii(c); }, '_');
    result.erase(result.find_last_not_of(' ') + 1);
    result.erase(0, result.find_first_not_of(' '));
    return result.empty() ? "Comment" : result;
}

std::string metadata_value(std::string_view value) {
    std::string result(value);
    std::replace_if(result.begin(), result.end(), is_control, ' ');
    return result;
}

bool is_ascii(std::string_view text) { return std::none_of(text.begin(), text.end(), is_beyond_ascii); }

}  // namespace orrery
