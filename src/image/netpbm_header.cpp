#include "image/netpbm_header.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <system_error>

namespace orrery {
namespace {

constexpr std::string_view white_space = " \t\n\v\f\r";
// Far above any number in a header: garbage is not echoed at full length.
constexpr std::size_t longest_word = 32;

}  // namespace

bool NetpbmHeader::at_blank() const {
    if (at_ == text_.size()) return false;
    return white_space.find(text_[at_]) != white_space.npos || (text_[at_] == '#' && comments_ == Comments::allowed);
}

void NetpbmHeader::skip_blank() {
    const std::size_t end = text_[at_] == '#' ? text_.find('\n', at_) : at_;
    at_ = end == text_.npos ? text_.size() : end + 1;
}

std::string_view NetpbmHeader::word() {
    while (at_blank()) skip_blank();
    const std::size_t start = at_;
    while (at_ < text_.size() && !at_blank()) ++at_;
    if (at_ == text_.size()) throw std::runtime_error("truncated in the header");
    const std::string_view found = text_.substr(start, at_ - start);
    if (found.size() > longest_word) throw std::runtime_error("a word in the header is too long");
    skip_blank();
    return found;
}

std::uint32_t NetpbmHeader::number(const char* what, std::uint32_t least, std::uint32_t most) {
    const std::string_view digits = word();
    std::uint32_t value = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (fault != std::errc{} || end != digits.data() + digits.size() || value < least || value > most)
        throw std::runtime_error(fmt::format("{} is not a whole number from {} to {}", what, least, most));
    return value;
}

ByteView NetpbmHeader::samples(std::uint64_t pixels, std::size_t bytes_per_pixel) const {
    const ByteView rest = std::as_bytes(std::span(text_)).subspan(at_);
    // Divided, not multiplied: the header may claim more than 64 bits can count.
    if (pixels > rest.size() / bytes_per_pixel)
        throw std::runtime_error(fmt::format("truncated: {} pixels of {} bytes are announced, {} bytes are there",
                                             pixels, bytes_per_pixel, rest.size()));
    return rest.first(static_cast<std::size_t>(pixels) * bytes_per_pixel);
}

}  // namespace orrery
