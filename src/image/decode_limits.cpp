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

void check_memory(std::uint64_t row_bytes, std::uint64_t rows, std::uint64_t memory) {
    if (rows == 0 || row_bytes <= memory / rows) return;
    const double gigabytes = static_cast<double>(row_bytes) * static_cast<double>(rows) / 1e9;
    throw std::runtime_error(fmt::format("its {} rows of pixels take {:.1f} GB, and {:.1f} GB of memory are left", rows,
                                         gigabytes, static_cast<double>(memory) / 1e9));
}

}  // namespace orrery
