#include "image/decode_limits.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace orrery {

void check_unpacked_size(std::uint64_t row_bytes, std::uint64_t rows, std::size_t file_bytes) {
    const std::uint64_t most = greatest_expansion * file_bytes;
    // Divided, not multiplied: the product may exceed 64 bits.
    if (rows > 0 && row_bytes > most / rows)
        throw std::runtime_error(
            fmt::format("{} rows of {} bytes cannot come out of {} bytes", rows, row_bytes, file_bytes));
}

}  // namespace orrery
