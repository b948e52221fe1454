// Raw bytes: what an encoder makes, a file holds and a decoder reads.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace orrery {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

inline void append(Bytes& bytes, ByteView more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

inline void append(Bytes& bytes, std::string_view text) { append(bytes, std::as_bytes(std::span(text))); }

inline bool starts_with(ByteView bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::string_view(reinterpret_cast<const char*>(bytes.data()), magic.size()) == magic;
}

}  // namespace orrery
