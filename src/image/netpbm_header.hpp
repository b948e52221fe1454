// The text in front of the samples that PPM and PFM share: words between white space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "image/bytes.hpp"

namespace orrery {

/// Reads header words from the front of a file. Every fault is a std::runtime_error.
class NetpbmHeader {
public:
    enum class Comments { allowed, unknown };  ///< PPM has comments, PFM has none

    NetpbmHeader(ByteView file, Comments comments)
        : text_(reinterpret_cast<const char*>(file.data()), file.size()), comments_(comments) {}

    /// The next word; the one white-space character (or comment) that ends it is consumed, so that after the last word
    /// `samples` starts at the first sample even when that looks like white space.
    std::string_view word();

    /// The next word as a whole number in [least, most].
    std::uint32_t number(const char* what, std::uint32_t least, std::uint32_t most);

    /// What follows the header; faults unless it holds `pixels` of `bytes_per_pixel`.
    ByteView samples(std::uint64_t pixels, std::size_t bytes_per_pixel) const;

private:
    bool at_blank() const;
    /// Passes over one white-space character, or over a comment with the newline that ends it.
    void skip_blank();

    std::string_view text_;
    Comments comments_;
    std::size_t at_ = 0;
};

}  // namespace orrery
