// How large an image a compressed file may claim to hold.
#pragma once

#include <cstddef>
#include <cstdint>

namespace orrery {

/// Deflate, the densest packing of these formats, makes at most 1032 bytes of one (RFC 1951: a match of 258 bytes in
/// two bits). Whatever announces more than that is a lie that would only cost memory.
inline constexpr std::uint64_t greatest_expansion = 1032;

/// Throws std::runtime_error where `rows` of `row_bytes` cannot come out of a file of `file_bytes`.
void check_unpacked_size(std::uint64_t row_bytes, std::uint64_t rows, std::size_t file_bytes);

/// Throws std::runtime_error with the figures where `rows` of `row_bytes`, all that decoding takes, exceed `memory`.
void check_memory(std::uint64_t row_bytes, std::uint64_t rows, std::uint64_t memory);

}  // namespace orrery
